/* SPDX-License-Identifier: MIT */
#include "geom/screen_box.h"
#include <math.h>

struct screen_box screen_box_none(void)
{
	return (struct screen_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
}

struct screen_box screen_box_all(void)
{
	return (struct screen_box){{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
}

bool screen_box_is_none(const struct screen_box *box)
{
	return box->min[0] > box->max[0] || box->min[1] > box->max[1];
}

bool screen_box_is_all(const struct screen_box *box)
{
	return box->min[0] == -INFINITY && box->min[1] == -INFINITY && box->max[0] == INFINITY &&
	       box->max[1] == INFINITY;
}

void screen_box_add(struct screen_box *box, const struct screen_box *other)
{
	for (int axis = 0; axis < 2; axis++) {
		box->min[axis] = fminf(box->min[axis], other->min[axis]);
		box->max[axis] = fmaxf(box->max[axis], other->max[axis]);
	}
}

void screen_box_add_point(struct screen_box *box, float x, float y)
{
	struct screen_box point =
		isfinite(x) && isfinite(y) ? (struct screen_box){{x, y}, {x, y}} : screen_box_all();
	screen_box_add(box, &point);
}

void screen_box_cut(struct screen_box *box, const struct screen_box *other)
{
	for (int axis = 0; axis < 2; axis++) {
		box->min[axis] = fmaxf(box->min[axis], other->min[axis]);
		box->max[axis] = fminf(box->max[axis], other->max[axis]);
	}
}

struct screen_box screen_box_widened(const struct screen_box *box, float by)
{
	return (struct screen_box){
		{box->min[0] - by, box->min[1] - by}, {box->max[0] + by, box->max[1] + by}};
}

bool screen_box_touches(const struct screen_box *a, const struct screen_box *b)
{
	for (int axis = 0; axis < 2; axis++)
		if (a->min[axis] > b->max[axis] || b->min[axis] > a->max[axis])
			return false;
	return true;
}
