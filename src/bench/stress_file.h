/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_FILE_H
#define BENCH_STRESS_FILE_H

#include "bench/stress_scene.h"

/** Writes FOLDER/NAME.ini, a scene file that draws the scene as it is, and its models beside it
 *  (NAME-1.obj and so on). The folder must exist, path hold that file's name. Numbers beyond the
 *  scene file's ranges are written all the same. Fails (MACHINE) when writing fails. */
bool stress_file_write(const struct stress_scene *scene, const char *folder, const char *name,
	char *path, size_t path_size, struct sm_error *error);

#endif
