/* SPDX-License-Identifier: MIT */
#ifndef APP_CHECK_PRESET_H
#define APP_CHECK_PRESET_H

#include "app/command.h"
#include "base/error.h"

/** Flags of a conformance run that a file holds: in a section [check], by their long names. */
struct check_preset {
	char **values; /**< owned, [count]: what flags were given */
	size_t count, capacity;
};

/** Takes a flag of a file; the value is the preset's. Fails (INPUT). */
typedef bool (*check_preset_take)(void *data, int id, const char *value, struct sm_error *error);

/**
 * Reads a file and hands its flags over, in order. Only flags with values can be in one; baselines
 * (flag "expect") are looked for beside the file.
 * preset: zero, or what another file left; add to it. It must live as long as the values are used.
 * Fails (INPUT) with file and line.
 */
bool check_preset_read(struct check_preset *preset, const struct command *command, const char *path,
	check_preset_take take, void *data, struct sm_error *error);
void check_preset_finish(struct check_preset *preset);

#endif
