/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SCREEN_PARTS_H
#define GEOM_SCREEN_PARTS_H

#include "geom/screen_grid.h"

/** Pixels left <= x < right, bottom <= y < top. */
struct pixel_box {
	int left, bottom, right, top;
};

/** Cells first <= x < end of the rows bottom <= y < top, and the pixels in them. Zero comes before
 *  the first part. */
struct screen_part {
	int first, end, bottom, top;
	struct pixel_box box;
};

/**
 * Goes on to the next rectangle of marked cells; false: there is none. They are disjoint, and few:
 * rows that are alike go together. A pixel is in the cell that its centre is in. width, height: of
 * the picture, pixels.
 */
bool screen_part_next(
	struct screen_part *part, const struct screen_grid *cells, uint32_t width, uint32_t height);

#endif
