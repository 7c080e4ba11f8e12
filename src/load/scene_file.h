/* SPDX-License-Identifier: MIT */
#ifndef LOAD_SCENE_FILE_H
#define LOAD_SCENE_FILE_H

#include "load/plan.h"

/** Whether a source is a scene file by its name, which ends in .ini. */
bool scene_file_is(const char *source);

/**
 * Adds what a scene file (docs/scene-file.md) says to a fresh plan. Models' paths become relative
 * to where the program runs instead of to the file. Fails (INPUT) with "FILE:LINE: cause".
 */
bool scene_file_read(const char *path, struct plan *plan, struct sm_error *error);

/** The same of its text, as if it stood in that file. */
bool scene_file_parse(
	const char *path, const char *text, struct plan *plan, struct sm_error *error);

#endif
