/* SPDX-License-Identifier: MIT */
#ifndef BENCH_PARETO_H
#define BENCH_PARETO_H

#include <stdbool.h>
#include <stddef.h>

/** Whether a is as good as b or better in both x and y, less being better, and better in one. */
bool pareto_dominates(const double a[2], const double b[2]);

/** Finds the points that no other is as good as or better than in both x and y, less being
 *  better, and better in one. Of equal points the first is taken. Writes their numbers by rising x
 *  to front[count]; returns how many. */
size_t pareto_front(const double (*points)[2], size_t count, size_t *front);

#endif
