/* SPDX-License-Identifier: MIT */
#include "gles/program_entry.h"
#include <assert.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char magic[8] = "SMPROG01";

/* FNV-1a of 64 bits: draft-eastlake-fnv. */
#define FNV_START UINT64_C(0xcbf29ce484222325)
#define FNV_PRIME UINT64_C(0x100000001b3)

static uint64_t hash(uint64_t value, const void *bytes, size_t size)
{
	const uint8_t *byte = bytes;
	for (size_t i = 0; i < size; i++)
		value = (value ^ byte[i]) * FNV_PRIME;
	return value;
}

struct program_id program_id_start(void)
{
	/* From two starts: what collides from one does not from the other. */
	return (struct program_id){{FNV_START, ~FNV_START}};
}

void program_id_add(struct program_id *id, const char *text)
{
	if (text == NULL)
		text = "";
	for (int i = 0; i < 2; i++)
		id->words[i] = hash(id->words[i], text, strlen(text) + 1);
}

void program_id_name(const struct program_id *id, char name[PROGRAM_ID_NAME_SIZE])
{
	snprintf(name, PROGRAM_ID_NAME_SIZE, "%016" PRIx64 "%016" PRIx64, id->words[0],
		id->words[1]);
}

static uint64_t checksum_of(const struct program_entry *entry)
{
	size_t head = offsetof(struct program_entry, binary) - offsetof(struct program_entry, id);
	return hash(FNV_START, &entry->id, head + entry->length);
}

void program_entry_seal(struct program_entry *entry, const struct program_id *id)
{
	memcpy(entry->magic, magic, sizeof(magic));
	entry->id = *id;
	entry->checksum = checksum_of(entry);
}

bool program_entry_is_whole(const void *bytes, size_t size, const struct program_id *id)
{
	static_assert(offsetof(struct program_entry, binary) == 40, "padding would be hashed");
	const struct program_entry *entry = bytes;
	return size >= sizeof(*entry) && memcmp(entry->magic, magic, sizeof(magic)) == 0 &&
	       memcmp(&entry->id, id, sizeof(*id)) == 0 && entry->length == size - sizeof(*entry) &&
	       entry->checksum == checksum_of(entry);
}
