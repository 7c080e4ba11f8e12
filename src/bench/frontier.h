/* SPDX-License-Identifier: MIT */
#ifndef BENCH_FRONTIER_H
#define BENCH_FRONTIER_H

#include "bench/contents.h"
#include <stdio.h>

/** RMSE in penumbrae from which on no time makes up for the error. */
#define FRONTIER_RMSE 0.05

/** Whether the result's error is below FRONTIER_RMSE and no other of its scene and setting has both
 *  as small an error and as short a time. Of equal ones the first counts. */
bool frontier_has(const struct result_list *list, const struct result *result);

/** Writes which of the rows frontier_has(), as a sentence, names by `escape`; nothing where no row
 *  has both a time and an error. */
void frontier_write(
	const struct rows *rows, void (*escape)(const char *text, FILE *file), FILE *file);

/** Writes which techniques it has alone, and in how many scenes and settings of those that have
 *  times and errors; nothing where there are none of these. */
void frontier_write_alone(
	const struct contents *contents, void (*escape)(const char *text, FILE *file), FILE *file);

#endif
