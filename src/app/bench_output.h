/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_OUTPUT_H
#define APP_BENCH_OUTPUT_H

#include "bench/result.h"
#include <stdio.h>

/** Makes the folders for a report and difference pictures if they are not there, and checks that
 *  files can be written. Fails (INPUT). */
bool bench_output_prepare(const char *folder, struct sm_error *error);

/** Writes a file of the folder, whole or not at all, with what `print` makes of the data. Fails as
 *  output_write(). */
bool bench_output_file(const char *folder, const char *name,
	void (*print)(FILE *file, const void *data), const void *data, struct sm_error *error);

/** Reads a results.csv into an empty list. Fails (INPUT), also where there is none. */
bool bench_output_read(struct result_list *results, const char *path, struct sm_error *error);

/** Prints the head of a table for people, and results from the one at `first` on as its rows.
 *  Fails (MACHINE) when they cannot be written. */
void bench_output_head(FILE *file);
bool bench_output_rows(
	FILE *file, const struct result_list *results, size_t first, struct sm_error *error);

#endif
