/* SPDX-License-Identifier: MIT */
#ifndef BENCH_MEAN_H
#define BENCH_MEAN_H

#include "bench/distinct.h"
#include <stdio.h>

/** A technique over scenes. Means are arithmetic, but those of times geometric; those of errors are
 *  over the scenes that have pixels to err in. NAN: not measured in one of them, or in none. */
struct mean {
	size_t scenes;
	double rmse, bias, p99; /* of penumbra pixels */
	double all_rmse;        /* of pixels that face the light */
	double outside_wrong;   /* pixels, as struct result has it */
	double flicker;
	double ratio, ratio_pcss, ms;
};

/** Of a technique in a setting, in one scene or with NULL in all. */
struct mean mean_of(const struct result_list *list, const struct result *setting,
	const struct result *technique, const struct result *scene);

/** Whether time and error are both above 0, as logarithmic axes want them. */
bool mean_is_complete(const struct mean *mean);

/** A column of a table of means. */
struct mean_column {
	const char *heading;
	const char *format; /* of one double */
	size_t offset;      /* in struct mean, bytes */
};

/** Columns in the order of tables, by number from 0; NULL behind the last. */
const struct mean_column *mean_column_at(size_t i);

/** Writes a mean's value, or "-" for NAN. */
void mean_write(const struct mean_column *column, const struct mean *mean, FILE *file);

#endif
