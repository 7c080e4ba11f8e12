/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STATISTICS_H
#define BENCH_STATISTICS_H

#include <stddef.h>

/** Sorts numbers, none of them NaN, in ascending order. */
void statistics_sort(double *values, size_t count);

/** The value below which `share`, in [0, 1], of the sorted ones lie: linear between neighbours, the
 *  first at 0 and the last at 1 (Hyndman & Fan 1996, type 7). 0 without values. */
double statistics_percentile(const double *sorted, size_t count, double share);

/** The percentile at one half; sorts. */
double statistics_median(double *values, size_t count);

#endif
