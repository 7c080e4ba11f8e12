/* SPDX-License-Identifier: MIT */
#ifndef BENCH_CSV_H
#define BENCH_CSV_H

#include "bench/result.h"
#include <stdio.h>

/** Writes results.csv (RFC 4180, lines end with a newline alone): a line of the names of columns,
 *  which column.c explains, and one line a result. The caller checks the file for errors. */
void csv_write(const struct result_list *list, FILE *file);

/**
 * Adds the rows of a results.csv to the list. Columns are found by name: those that are not known
 * are skipped, numbers of those that are missing are NAN or 0; scene and technique must be there.
 * Fails (INPUT) on text that is no such file, naming it and the line, (MACHINE) when it cannot be
 * read; the rows before stay in the list.
 */
bool csv_read(struct result_list *list, FILE *file, const char *file_name, struct sm_error *error);

#endif
