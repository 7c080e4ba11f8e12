/* SPDX-License-Identifier: MIT */
#ifndef BENCH_PAPER_FIT_H
#define BENCH_PAPER_FIT_H

#include <stdbool.h>
#include <stddef.h>

/** Pearson's correlation of pairs that are finite; NAN for fewer than three of them, or where
 *  either does not change. */
double fit_correlation(const double *x, const double *y, size_t count);

/** The exponent k of y = a x^k that fits pairs best in the logarithm, of those above 0; NAN for
 *  fewer than three of them, or where x does not change. */
double fit_exponent(const double *x, const double *y, size_t count);

/** y = *p x1 + *q x2 with the least sum of squared relative errors, of rows whose values are above
 *  0. False where they do not tell p from q. */
bool fit_two(
	const double *x1, const double *x2, const double *y, size_t count, double *p, double *q);

#endif
