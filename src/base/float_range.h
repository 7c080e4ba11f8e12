/* SPDX-License-Identifier: MIT */
#ifndef BASE_FLOAT_RANGE_H
#define BASE_FLOAT_RANGE_H

/* fmaxf() and the like are calls, as a number that is none must not win there. Here b is taken
 * where either is none. */

static inline float larger(float a, float b)
{
	return a > b ? a : b;
}

static inline float smaller(float a, float b)
{
	return a < b ? a : b;
}

static inline double larger_double(double a, double b)
{
	return a > b ? a : b;
}

static inline double smaller_double(double a, double b)
{
	return a < b ? a : b;
}

#endif
