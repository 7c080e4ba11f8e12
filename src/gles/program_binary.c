/* SPDX-License-Identifier: MIT */
#include "gles/program_binary.h"
#include "base/array.h"
#include "base/log.h"
#include <stdlib.h>

void program_binaries_init(struct program_binaries *binaries, const struct sm_program_store *store,
	const struct caps *caps, const char *version)
{
	*binaries = (struct program_binaries){0};
	if (store == NULL || caps->program_binary_formats == 0)
		return;
	binaries->store = *store;
	binaries->driver = program_id_start();
	program_id_add(&binaries->driver, caps->vendor);
	program_id_add(&binaries->driver, caps->renderer);
	program_id_add(&binaries->driver, caps->version);
	program_id_add(&binaries->driver, version);
}

static struct program_id id_of(const struct program_binaries *binaries, struct program_key key)
{
	struct program_id id = binaries->driver;
	for (enum shader_stage stage = STAGE_VERTEX; stage <= STAGE_FRAGMENT; stage++) {
		const char *parts[SHADER_PARTS_MAX];
		size_t count = shader_parts(key, stage, parts);
		for (size_t i = 0; i < count; i++)
			program_id_add(&id, parts[i]);
	}
	return id;
}

/* The whole entry, to be freed, or NULL. */
static struct program_entry *load_entry(
	const struct sm_program_store *store, const struct program_id *id)
{
	char name[PROGRAM_ID_NAME_SIZE];
	program_id_name(id, name);
	size_t size = store->load(store->data, name, NULL, 0);
	struct program_entry *entry = size > 0 ? array_alloc(size, 1) : NULL;
	if (entry == NULL)
		return NULL;
	if (store->load(store->data, name, entry, size) == size &&
		program_entry_is_whole(entry, size, id))
		return entry;
	log_debug("program %s is kept, but not whole", name);
	free(entry);
	return NULL;
}

bool program_binary_load(
	const struct program_binaries *binaries, struct gl *gl, GLuint name, struct program_key key)
{
	if (binaries->store.load == NULL)
		return false;
	struct program_id id = id_of(binaries, key);
	struct program_entry *entry = load_entry(&binaries->store, &id);
	if (entry == NULL)
		return false;
	GLint linked = GL_FALSE;
	gl->ProgramBinary(name, entry->format, entry->binary, (GLsizei)entry->length);
	gl->GetProgramiv(name, GL_LINK_STATUS, &linked);
	free(entry);
	if (!linked) {
		gl_take_error(gl);
		log_debug("the driver refuses a program that was kept");
	}
	return linked;
}

void program_binary_announce(const struct program_binaries *binaries, struct gl *gl, GLuint name)
{
	if (binaries->store.save != NULL)
		gl->ProgramParameteri(name, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
}

/* The driver's binary in an entry that is not sealed yet, to be freed, or NULL. */
static struct program_entry *get_entry(struct gl *gl, GLuint name)
{
	GLint length = 0;
	GLsizei written = 0;
	gl->GetProgramiv(name, GL_PROGRAM_BINARY_LENGTH, &length);
	struct program_entry *entry =
		length > 0 ? array_zalloc(sizeof(*entry) + (size_t)length, 1) : NULL;
	if (entry == NULL)
		return NULL;
	gl->GetProgramBinary(name, length, &written, &entry->format, entry->binary);
	if (written > 0 && written <= length) {
		entry->length = (uint32_t)written;
		return entry;
	}
	gl_take_error(gl);
	free(entry);
	return NULL;
}

static void save_entry(
	const struct sm_program_store *store, struct program_id id, struct program_entry *entry)
{
	char name[PROGRAM_ID_NAME_SIZE];
	program_id_name(&id, name);
	program_entry_seal(entry, &id);
	store->save(store->data, name, entry, sizeof(*entry) + entry->length);
}

void program_binary_save(
	const struct program_binaries *binaries, struct gl *gl, GLuint name, struct program_key key)
{
	const struct sm_program_store *store = &binaries->store;
	if (store->save == NULL)
		return;
	struct program_entry *entry = get_entry(gl, name);
	if (entry == NULL) {
		log_debug("the driver gives no binary of a program");
		return;
	}
	save_entry(store, id_of(binaries, key), entry);
	free(entry);
}

/* An entry without a binary, whose format is the number. */
static struct program_id fact_id(const struct program_binaries *binaries, const char *fact)
{
	struct program_id id = binaries->driver;
	program_id_add(&id, fact);
	return id;
}

bool program_fact_load(const struct program_binaries *binaries, const char *fact, uint32_t *value)
{
	if (binaries->store.load == NULL)
		return false;
	struct program_id id = fact_id(binaries, fact);
	struct program_entry *entry = load_entry(&binaries->store, &id);
	if (entry == NULL)
		return false;
	*value = entry->format;
	free(entry);
	return true;
}

void program_fact_save(const struct program_binaries *binaries, const char *fact, uint32_t value)
{
	struct program_entry entry = {.format = value};
	if (binaries->store.save != NULL)
		save_entry(&binaries->store, fact_id(binaries, fact), &entry);
}
