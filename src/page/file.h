/* SPDX-License-Identifier: MIT */
#ifndef PAGE_FILE_H
#define PAGE_FILE_H

#include "base/error.h"
#include <stdio.h>

/** Writes a whole file or nothing: output_write() of app/output.h. */
typedef bool (*file_writer)(
	const char *path, const void *bytes, size_t size, struct sm_error *error);

/** Writes what `print` prints of data, once it is whole. Fails as `write` does, (MACHINE) when out
 *  of memory. */
bool file_print(const char *path, void (*print)(FILE *file, const void *data), const void *data,
	file_writer write, struct sm_error *error);

#endif
