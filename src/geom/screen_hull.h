/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SCREEN_HULL_H
#define GEOM_SCREEN_HULL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A corner of a shape, NDC. */
struct screen_point {
	float x, y;
};

#define SCREEN_HULL_EDGES_MAX 12

/** The convex hull of points and all near it, over a screen of square cells. Conservative. */
struct screen_hull {
	struct screen_point ends[SCREEN_HULL_EDGES_MAX][2]; /* of its edges, in cells */
	size_t edge_count;
	int size;    /* cells a side of the screen */
	float slack; /* in cells */
	bool everywhere;
	int first_row, last_row; /* that it touches */
};

/**
 * edges: [edge_count <= 12] pairs of indices into points, among which are the hull's own edges.
 * slack: in cells. A point that is far beyond the screen, or not finite, has the hull be
 * everywhere. False: it is on no cell.
 */
bool screen_hull_init(struct screen_hull *hull, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack, int size);

/** First and last cell of a row that the hull touches; false if it touches none. */
bool screen_hull_row(const struct screen_hull *hull, int row, int *first, int *last);

/** First and last of `size` cells that from..to touches, NDC; false if it touches none. */
bool screen_cells_between(float from, float to, int size, int *first, int *last);

#endif
