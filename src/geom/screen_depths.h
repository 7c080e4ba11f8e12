/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SCREEN_DEPTHS_H
#define GEOM_SCREEN_DEPTHS_H

#include "geom/screen_box.h"
#include "geom/screen_hull.h"

/** Cells a side. */
#define SCREEN_DEPTHS_SIZE 256

/** What is in no cell is behind nothing: a depth that no surface on the screen has. */
#define SCREEN_DEPTH_NONE 2.0f

/** The least depth of the shapes on each cell of a screen, NDC [-1, 1], from the lower left.
 *  Conservative: what has been added is in no other cell, and in none at less depth. */
struct screen_depths {
	float least[SCREEN_DEPTHS_SIZE][SCREEN_DEPTHS_SIZE];
};

/** Empties the cells that a box touches. */
void screen_depths_clear(struct screen_depths *depths, const struct screen_box *box);

/** Adds a shape, as screen_hull_init() takes it, that lies at `depth` or beyond. */
void screen_depths_add(struct screen_depths *depths, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack, float depth);

/** Whether something of what has been added is on a cell that touches the rectangle, at less than
 *  `depth`. */
bool screen_depths_before(
	const struct screen_depths *depths, const float min[2], const float max[2], float depth);

#endif
