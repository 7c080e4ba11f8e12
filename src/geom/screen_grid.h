/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SCREEN_GRID_H
#define GEOM_SCREEN_GRID_H

#include "geom/screen_hull.h"

/** Cells a side. */
#define SCREEN_GRID_SIZE 64

/** A set of cells over a screen, NDC [-1, 1]: a word a row, a bit a cell, from the lower left.
 *  Conservative: what has been added lies in marked cells wholly. */
struct screen_grid {
	uint64_t rows[SCREEN_GRID_SIZE];
};

void screen_grid_clear(struct screen_grid *grid);
void screen_grid_fill(struct screen_grid *grid);

/** Marks all that is marked in another. */
void screen_grid_unite(struct screen_grid *grid, const struct screen_grid *other);

/** Marks no more than is marked in another, too. */
void screen_grid_cut(struct screen_grid *grid, const struct screen_grid *other);

/** Marks the cells around all that are marked. */
void screen_grid_widen(struct screen_grid *grid);

/**
 * Marks the convex hull of points, and all within `slack` cells of it.
 * edges: [edge_count <= 12] pairs of indices into points, among which are the hull's own edges. A
 * point that is far beyond the screen, or not finite, marks everything.
 */
void screen_grid_add(struct screen_grid *grid, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack);

/** Whether a marked cell touches the rectangle. */
bool screen_grid_touches(const struct screen_grid *grid, const float min[2], const float max[2]);

/** The most of what cells that touch the rectangle have; 0 beside the screen. of: not below 0,
 *  [SCREEN_GRID_SIZE * SCREEN_GRID_SIZE], row after row. */
float screen_grid_most(const float *of, const float min[2], const float max[2]);

/** End of the run of cells that starts at x in the row, all marked or all not: x < end <= size. */
int screen_grid_run_end(const struct screen_grid *grid, int x, int row);

/** The cells min <= x, row < max around all marked ones; false if there are none. */
bool screen_grid_bounds(const struct screen_grid *grid, int min[2], int max[2]);

/** Number of marked cells. */
size_t screen_grid_count(const struct screen_grid *grid);

bool screen_grid_has(const struct screen_grid *grid, int x, int row);

#endif
