/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SCREEN_COVER_H
#define GEOM_SCREEN_COVER_H

#include "geom/screen_hull.h"

/** Cells a side. */
#define SCREEN_COVER_SIZE 256

/** Which cells of a screen shapes are over, NDC [-1, 1]: a bit a cell, from the lower left. Finer
 *  than struct screen_grid, and as conservative: what has been added is in no other cell. */
struct screen_cover {
	uint64_t rows[SCREEN_COVER_SIZE][SCREEN_COVER_SIZE / 64];
};

void screen_cover_clear(struct screen_cover *cover);
void screen_cover_fill(struct screen_cover *cover);

/** Adds a shape, as screen_hull_init() takes it. */
void screen_cover_add(struct screen_cover *cover, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack);

/** Adds a rectangle. Not of NaN. */
void screen_cover_add_rectangle(struct screen_cover *cover, const float min[2], const float max[2]);

/** Whether something of what has been added is on a cell that touches the rectangle. */
bool screen_cover_touches(const struct screen_cover *cover, const float min[2], const float max[2]);

#endif
