/* SPDX-License-Identifier: MIT */
#include "ref/disc.h"
#include "base/array.h"
#include <math.h>
#include <stdlib.h>

#define RIM 28
#define INSIDE 6 /* squared */

/* Enough that pixels with the same set, which is turned for each of them, are far apart. */
#define SETS 64

uint64_t scramble(uint64_t bits)
{
	bits += UINT64_C(0x9e3779b97f4a7c15);
	bits = (bits ^ bits >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
	bits = (bits ^ bits >> 27) * UINT64_C(0x94d049bb133111eb);
	return bits ^ bits >> 31;
}

static bool allocate(struct disc *disc, uint32_t sets, uint32_t count)
{
	*disc = (struct disc){.count = count, .sets = sets};
	disc->x = array_alloc((size_t)sets * count, 2 * sizeof(*disc->x));
	if (disc->x == NULL)
		return false;
	disc->y = disc->x + (size_t)sets * count;
	return true;
}

/* From a point of the unit square. */
static void set_point(struct disc *disc, size_t index, double u, double v)
{
	double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0, radius = a, angle;
	if (a == 0.0 && b == 0.0) {
		angle = 0.0;
	} else if (fabs(a) > fabs(b)) {
		angle = M_PI / 4.0 * (b / a);
	} else {
		radius = b;
		angle = M_PI / 2.0 - M_PI / 4.0 * (a / b);
	}
	disc->x[index] = (float)(radius * cos(angle));
	disc->y[index] = (float)(radius * sin(angle));
}

bool disc_init_coarse(struct disc *disc)
{
	if (!allocate(disc, 1, RIM + INSIDE * INSIDE))
		return false;
	for (size_t i = 0; i < RIM; i++) {
		double angle = 2.0 * M_PI * (double)i / RIM;
		disc->x[i] = (float)cos(angle);
		disc->y[i] = (float)sin(angle);
	}
	for (size_t i = 0; i < INSIDE * INSIDE; i++)
		set_point(disc, RIM + i, ((double)(i % INSIDE) + 0.5) / INSIDE,
			((double)(i / INSIDE) + 0.5) / INSIDE);
	return true;
}

/* In [0, 1). */
static double random_share(uint64_t bits)
{
	return (double)(scramble(bits) >> 11) * 0x1p-53;
}

bool disc_init_fine(struct disc *disc, uint32_t samples)
{
	uint32_t side = (uint32_t)ceil(sqrt(samples));
	uint32_t count = side * side;
	if (!allocate(disc, SETS, count))
		return false;
	for (size_t i = 0; i < (size_t)SETS * count; i++) {
		uint32_t cell = (uint32_t)(i % count);
		set_point(disc, i, (cell % side + random_share(2 * i)) / side,
			(cell / side + random_share(2 * i + 1)) / side);
	}
	return true;
}

void disc_finish(struct disc *disc)
{
	free(disc->x);
	*disc = (struct disc){0};
}
