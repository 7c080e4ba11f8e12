/* SPDX-License-Identifier: MIT */
#ifndef GLES_PROGRAM_ENTRY_H
#define GLES_PROGRAM_ENTRY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** What a program is known by between runs: a hash over everything that it was made from. */
struct program_id {
	uint64_t words[2];
};

struct program_id program_id_start(void);
/** Adds a string and its end. NULL counts as "". */
void program_id_add(struct program_id *id, const char *text);

#define PROGRAM_ID_NAME_SIZE 33
/** 32 hexadecimal digits. */
void program_id_name(const struct program_id *id, char name[PROGRAM_ID_NAME_SIZE]);

/** A program as it is kept: the driver's binary, and what tells whether it is whole. In the byte
 *  order of the machine, as the binary is of that machine. */
struct program_entry {
	char magic[8];
	uint64_t checksum; /* of all that follows */
	struct program_id id;
	uint32_t format; /* of the binary, a GL enum */
	uint32_t length; /* of the binary, bytes */
	uint8_t binary[];
};

/** Completes an entry whose binary, format and length are filled in. */
void program_entry_seal(struct program_entry *entry, const struct program_id *id);

/** Whether `size` bytes, aligned as any object, are the entry of that program, undamaged. */
bool program_entry_is_whole(const void *bytes, size_t size, const struct program_id *id);

#endif
