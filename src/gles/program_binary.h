/* SPDX-License-Identifier: MIT */
#ifndef GLES_PROGRAM_BINARY_H
#define GLES_PROGRAM_BINARY_H

#include "gles/caps.h"
#include "gles/program_entry.h"
#include "gles/shader_source.h"

/** Compiled programs in the caller's store; zero: none are kept. */
struct program_binaries {
	struct sm_program_store store; /* either function may be NULL */
	struct program_id driver;      /* the start of every program's id */
};

/** store: copied; NULL for none. version: of this library, for what the sources do not tell.
 * Nothing is kept with a driver that has no binaries. */
void program_binaries_init(struct program_binaries *binaries, const struct sm_program_store *store,
	const struct caps *caps, const char *version);

/** Links a program from the store. False: it is not there, damaged or refused by the driver, and is
 *  to be compiled. */
bool program_binary_load(const struct program_binaries *binaries, struct gl *gl, GLuint name,
	struct program_key key);

/** Before the program is linked from sources: that it will be saved. */
void program_binary_announce(const struct program_binaries *binaries, struct gl *gl, GLuint name);

/** Saves a linked program. What fails is noted in the log only. */
void program_binary_save(const struct program_binaries *binaries, struct gl *gl, GLuint name,
	struct program_key key);

/** A number that was found out about the driver, by name, from the store. False: it is not there,
 * or damaged. */
bool program_fact_load(const struct program_binaries *binaries, const char *fact, uint32_t *value);

/** Keeps it there. */
void program_fact_save(const struct program_binaries *binaries, const char *fact, uint32_t value);

#endif
