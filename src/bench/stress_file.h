/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_FILE_H
#define BENCH_STRESS_FILE_H

#include "bench/stress_check.h"

/** Writes FOLDER/NAME.ini, a scene file that draws the scene as it is, and its models beside it
 *  (NAME-1.obj and so on). The folder must exist, path hold that file's name. Numbers beyond the
 *  scene file's ranges are written all the same, and do not load. Fails (MACHINE) when writing
 * does. */
bool stress_file_write(const struct stress_scene *scene, const char *folder, const char *name,
	char *path, size_t path_size, struct sm_error *error);

/** Whether a scene file can say the scene: it has objects, each of a triangle or more, and lights,
 *  and its numbers are in range. */
bool stress_file_can_say(const struct stress_scene *scene);

/** Loads a scene file and checks it; *seen (may be NULL) and *fault are as of stress_check(). Fails
 *  (INPUT, MACHINE) when it does not load. */
bool stress_file_check(const char *path, struct stress_probe *probe, struct stress_picture *seen,
	struct stress_fault *fault, struct sm_error *error);

#endif
