/* SPDX-License-Identifier: MIT */
#include "geom/screen_depths.h"
#include <math.h>

/* The cells of a rectangle: columns and rows, first and last. */
static bool find_cells(const float min[2], const float max[2], int columns[2], int rows[2])
{
	return screen_cells_between(min[0], max[0], SCREEN_DEPTHS_SIZE, &columns[0], &columns[1]) &&
	       screen_cells_between(min[1], max[1], SCREEN_DEPTHS_SIZE, &rows[0], &rows[1]);
}

void screen_depths_clear(struct screen_depths *depths, const struct screen_box *box)
{
	int columns[2], rows[2];
	if (!find_cells(box->min, box->max, columns, rows))
		return;
	for (int row = rows[0]; row <= rows[1]; row++)
		for (int x = columns[0]; x <= columns[1]; x++)
			depths->least[row][x] = SCREEN_DEPTH_NONE;
}

void screen_depths_add(struct screen_depths *depths, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack, float depth)
{
	struct screen_hull hull;
	int first, last;
	if (!screen_hull_init(&hull, points, edges, edge_count, slack, SCREEN_DEPTHS_SIZE))
		return;
	for (int row = hull.first_row; row <= hull.last_row; row++) {
		if (!screen_hull_row(&hull, row, &first, &last))
			continue;
		for (int x = first; x <= last; x++)
			depths->least[row][x] = fminf(depths->least[row][x], depth);
	}
}

bool screen_depths_before(
	const struct screen_depths *depths, const float min[2], const float max[2], float depth)
{
	int columns[2], rows[2];
	if (!find_cells(min, max, columns, rows))
		return false;
	for (int row = rows[0]; row <= rows[1]; row++)
		for (int x = columns[0]; x <= columns[1]; x++)
			if (depths->least[row][x] < depth)
				return true;
	return false;
}
