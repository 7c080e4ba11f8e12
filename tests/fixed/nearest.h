/* SPDX-License-Identifier: MIT */
#ifndef FIXED_NEAREST_H
#define FIXED_NEAREST_H

#include <stdbool.h>
#include <stdint.h>

/** Whether `steps` is n / d to the nearest, halves up, or the end of [least, greatest] that n / d
 *  is beyond; d > 0. No division is made: n / d is in [steps - 1/2, steps + 1/2). */
static inline bool is_nearest(int64_t steps, int64_t n, int64_t d, int64_t least, int64_t greatest)
{
	return steps >= least && steps <= greatest &&
	       (steps == least || 2 * n >= (2 * steps - 1) * d) &&
	       (steps == greatest || 2 * n < (2 * steps + 1) * d);
}

/** The binary16 number nearest to x, ties to even, saturating; by the rounding of doubles. */
double nearest_half(double x);

/** Of bits of a finite one, as IEEE 754 defines it. */
double value_of_half(uint16_t bits);

/** The same double, and the same zero. */
bool is_same(double a, double b);

#endif
