/* SPDX-License-Identifier: MIT */
#ifndef BASE_FLOAT4_H
#define BASE_FLOAT4_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Four numbers at a time, as the vectors of gcc and clang: neither makes them of a loop with a
 * choice in it. */
typedef float float4 __attribute__((vector_size(16)));
typedef int32_t int4 __attribute__((vector_size(16))); /* of comparisons: 0 or -1 */

static inline float4 load4(const float *values)
{
	float4 loaded;
	memcpy(&loaded, values, sizeof(loaded));
	return loaded;
}

static inline void store4(float *values, float4 stored)
{
	memcpy(values, &stored, sizeof(stored));
}

/* a where which is -1, b where it is 0. */
static inline float4 choose4(int4 which, float4 a, float4 b)
{
	return (float4)((which & (int4)a) | (~which & (int4)b));
}

static inline float4 absolute4(float4 a)
{
	return (float4)((int4)a & INT32_MAX);
}

static inline float4 root4(float4 a)
{
	for (int i = 0; i < 4; i++)
		a[i] = sqrtf(a[i]);
	return a;
}

/* As larger() and smaller(): b is taken where either is no number. */

static inline float4 larger4(float4 a, float4 b)
{
	return choose4(a > b, a, b);
}

static inline float4 smaller4(float4 a, float4 b)
{
	return choose4(a < b, a, b);
}

#endif
