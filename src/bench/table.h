/* SPDX-License-Identifier: MIT */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "bench/distinct.h"

/** A column of the tables that people read: a column of results.csv, rounded. */
struct table_column;

/** The column after another one, or with NULL the first, in which something was measured; NULL
 *  behind the last. */
const struct table_column *table_next_column(
	const struct table_column *after, const struct result_list *list);

const char *table_heading(const struct table_column *column);
/** As in results.csv, with its unit. */
const char *table_help(const struct table_column *column);

/** The longest text of a cell, with its end. */
#define TABLE_CELL_MAX 32

/** Writes a value, or a dash where it was not measured. */
void table_cell(
	const struct table_column *column, const struct result *result, char text[TABLE_CELL_MAX]);

/** Whether no technique of the scene and setting of the result has a better value. False in columns
 *  that have no best one. */
bool table_is_best(const struct table_column *column, const struct result_list *list,
	const struct result *result);

#endif
