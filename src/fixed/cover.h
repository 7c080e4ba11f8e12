/* SPDX-License-Identifier: MIT */
#ifndef FIXED_COVER_H
#define FIXED_COVER_H

#include "fixed/polygon.h"
#include "fixed/primitive.h"

/** Pixels a side of the grid that large polygons are cut by: so far, planes stay within half a step
 *  a pixel of what they round. */
#define FIXED_TILE 64

/** What is drawn over: width x height pixels, up to SM_EXACT_SIZE_MAX, of which the outermost
 *  `border` stay clear. */
struct fixed_screen {
	int32_t width, height, border;
};

/** A polygon on the screen's grid of subpixels. */
struct outline {
	int32_t corners[POLYGON_CORNERS_MAX][2];
	int count;
};

/** Twice the area of the triangle of three corners, above 0 when it is counter-clockwise. */
int64_t outline_turn(const struct outline *outline, int a, int b, int c);

/** Whether the box around it has the centre of a pixel that is drawn. */
bool outline_has_pixels(const struct outline *outline, const struct fixed_screen *screen);

/** Cuts an outline into covers: pieces of up to four corners, over the same ones, and these by the
 *  grid of tiles where they are larger than one. Each pixel is in one cover at most, and polygons
 *  that share an edge share none and leave none out (but where an outline that is no wider than a
 *  subpixel is not convex). */
struct cover_cutter {
	const struct outline *outline; /* not owned */
	const struct fixed_screen *screen;
	int next; /* corner that the next piece goes on with */
	struct fixed_cover piece;
	int32_t tile[2]; /* left and bottom of the next tile of the piece */
};

void cover_cutter_init(struct cover_cutter *cutter, const struct outline *outline,
	const struct fixed_screen *screen);
/** False: there are no more. */
bool cover_cutter_next(struct cover_cutter *cutter, struct fixed_cover *cover);

#endif
