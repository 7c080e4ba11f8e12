/* SPDX-License-Identifier: MIT */
#ifndef BENCH_COLUMN_H
#define BENCH_COLUMN_H

#include "bench/result.h"

enum column_type {
	COLUMN_TEXT,
	COLUMN_REAL,    /* double */
	COLUMN_COUNT32, /* uint32_t */
	COLUMN_COUNT64, /* uint64_t */
	COLUMN_PASSES,  /* struct pass_time[PASSES_MAX], as "NAME=MS;NAME=MS" */
};

/** A field of struct result, as files name and explain it. */
struct column {
	const char *name;
	enum column_type type;
	size_t offset, size; /* in struct result, bytes */
	const char *help;    /* with its unit */
};

/** Columns in the order of files, by number from 0; NULL behind the last. */
const struct column *column_at(size_t i);

/** The number of the column of that name, or SIZE_MAX. */
size_t column_find(const char *name);

/** The longest text of a column, with its end. */
#define COLUMN_TEXT_MAX 2048

/** Writes a result's value as text that column_parse() makes the same value of. NAN is empty. */
void column_format(
	const struct column *column, const struct result *result, char text[COLUMN_TEXT_MAX]);

/** Reads such a text into *result. Returns what is wrong with it, or NULL. */
const char *column_parse(const struct column *column, struct result *result, const char *text);

/** The value of a column of numbers. */
double column_value(const struct column *column, const struct result *result);

/** Writes the shortest text that reads back as the same number, 32 bytes at most. */
void column_format_real(double value, char text[32]);

#endif
