/* SPDX-License-Identifier: MIT */
#ifndef FIXED_POLYGON_H
#define FIXED_POLYGON_H

#include <stdbool.h>

/** What a corner may carry, beside its place. */
#define POLYGON_VALUES 5

/** Of a quad cut by the six sides of clip space. Each adds one, but where corners lie in a side
 *  rounding may put every second one outside: 6, 9, 13, 19, 28, 42. */
#define POLYGON_CORNERS_MAX 42

struct polygon_corner {
	double clip[4];
	double values[POLYGON_VALUES]; /* linear in clip space, as clip itself is */
};

struct polygon {
	int count;
	struct polygon_corner corners[POLYGON_CORNERS_MAX]; /* the first `count` alone are set */
};

/** What a polygon has, and no more: most have few corners. */
void polygon_copy(struct polygon *copy, const struct polygon *polygon);

/** Keeps what of a convex polygon of up to four corners is in |x|, |y|, |z| <= w. Polygons that
 *  share an edge share what is kept of it, to the last bit. False when nothing is left, or a corner
 *  is not finite. */
bool polygon_clip(struct polygon *polygon);

#endif
