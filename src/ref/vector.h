/* SPDX-License-Identifier: MIT */
#ifndef REF_VECTOR_H
#define REF_VECTOR_H

#include <math.h>
#include <stdbool.h>

/* cglm has no doubles. */

static inline double vector_dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double vector_length(const double v[3])
{
	return sqrt(vector_dot(v, v));
}

static inline void vector_subtract(const double a[3], const double b[3], double out[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = a[i] - b[i];
}

/** a + share b */
static inline void vector_add(const double a[3], double share, const double b[3], double out[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = a[i] + share * b[i];
}

static inline void vector_scale(double v[3], double factor)
{
	for (int i = 0; i < 3; i++)
		v[i] *= factor;
}

/** out is neither a nor b. */
static inline void vector_cross(const double a[3], const double b[3], double out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

/** False, and v unchanged, where it has no direction. */
static inline bool vector_normalise(double v[3])
{
	double length = vector_length(v);
	if (!(length > 0.0) || !isfinite(length))
		return false;
	vector_scale(v, 1.0 / length);
	return true;
}

/** Largest component, without its sign. */
static inline double vector_largest(const double v[3])
{
	double largest = 0.0;
	for (int i = 0; i < 3; i++)
		largest = fabs(v[i]) > largest ? fabs(v[i]) : largest;
	return largest;
}

#endif
