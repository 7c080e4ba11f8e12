/* SPDX-License-Identifier: MIT */
#ifndef FIXED_FIELD_H
#define FIXED_FIELD_H

#include "fixed/cover.h"

/** A polygon on a screen with what its corners carry, as functions that are affine there: value i
 *  over w. Pixel (x, y) is at (x + 1/2, y + 1/2). */
struct field {
	struct outline outline;
	int count; /* of values */
	double center[2];
	double at[POLYGON_VALUES]; /* in the center */
	double slope[POLYGON_VALUES][2];
	double most[POLYGON_VALUES]; /* magnitude in the outline */
	bool ccw;                    /* as seen */
};

/** Clips the polygon, snaps its corners, and finds the first `count` values of it. False: nothing
 * of it is on the screen. */
bool field_init(struct field *field, const struct polygon *polygon, int count,
	const struct fixed_screen *screen);

/** Power of two by which values first .. first + count - 1 stay below 2^bits in a cover of it. */
double field_scale(
	const struct field *field, int first, int count, int bits, const struct fixed_cover *cover);

/** scale times a value, rounded for a cover: within half a step a pixel from the cover's middle. */
struct fixed_plane field_plane(
	const struct field *field, int value, double scale, const struct fixed_cover *cover);

/** A value at the middle of a cover. */
double field_middle(const struct field *field, int value, const struct fixed_cover *cover);

/** How the value q / w grows along x / w and y / w on the plane through three corners, w = clip[3].
 *  Returns 1 where the corners are counter-clockwise as seen, -1 where they are clockwise, and 0,
 *  without a slope, where the plane is seen edge on. */
int field_slope(const double *const clip[3], const double q[3], double slope[2]);

#endif
