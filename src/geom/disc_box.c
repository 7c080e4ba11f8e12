/* SPDX-License-Identifier: MIT */
#include "geom/disc_box.h"
#include <math.h>

struct disc_box disc_box_none(void)
{
	return (struct disc_box){screen_box_none(), {INFINITY, -INFINITY}};
}

struct disc_box disc_box_all(void)
{
	return (struct disc_box){screen_box_all(), {0.0f, 0.0f}};
}

void disc_box_add(struct disc_box *box, const struct disc_box *other)
{
	screen_box_add(&box->box, &other->box);
	box->shear[0] = fminf(box->shear[0], other->shear[0]);
	box->shear[1] = fmaxf(box->shear[1], other->shear[1]);
}

struct screen_box disc_box_from(const struct disc_box *box, const float point[2])
{
	struct screen_box seen = box->box;
	if (screen_box_is_none(&seen))
		return seen;
	for (int axis = 0; axis < 2; axis++) {
		float a = point[axis] * box->shear[0], b = point[axis] * box->shear[1];
		seen.min[axis] -= fmaxf(a, b);
		seen.max[axis] -= fminf(a, b);
	}
	return seen;
}
