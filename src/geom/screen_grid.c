/* SPDX-License-Identifier: MIT */
#include "geom/screen_grid.h"
#include <assert.h>
#include <math.h>
#include <string.h>

/* Points farther away than this many cells leave no digits for where their edge crosses a cell. */
#define FAR_AWAY 1e4f

#define EDGES_MAX 12

void screen_grid_clear(struct screen_grid *grid)
{
	memset(grid, 0, sizeof(*grid));
}

void screen_grid_fill(struct screen_grid *grid)
{
	memset(grid, 0xff, sizeof(*grid));
}

void screen_grid_unite(struct screen_grid *grid, const struct screen_grid *other)
{
	for (int row = 0; row < SCREEN_GRID_SIZE; row++)
		grid->rows[row] |= other->rows[row];
}

static float to_cells(float ndc)
{
	return (ndc * 0.5f + 0.5f) * SCREEN_GRID_SIZE;
}

/* First and last cell of from..to that are on the screen; false if none is. */
static bool clip_cells(float from, float to, int *first, int *last)
{
	float lo = fmaxf(floorf(from), 0.0f), hi = fminf(floorf(to), SCREEN_GRID_SIZE - 1.0f);
	if (!(lo <= hi))
		return false;
	*first = (int)lo;
	*last = (int)hi;
	return true;
}

static uint64_t bits_between(int first, int last)
{
	return ~(uint64_t)0 >> (SCREEN_GRID_SIZE - 1 - last) & ~(uint64_t)0 << first;
}

/* Widens x[0]..x[1] by the part of the edge a -> b between heights y0 and y1. */
static void widen(struct screen_point a, struct screen_point b, float y0, float y1, float x[2])
{
	if ((a.y < y0 && b.y < y0) || (a.y > y1 && b.y > y1))
		return;
	float from = a.x, to = b.x;
	/* An edge that crosses a height is not level: its rise is not 0. */
	float per_rise = (b.x - a.x) / (b.y != a.y ? b.y - a.y : 1.0f);
	if ((a.y < y0) != (b.y < y0))
		*(a.y < y0 ? &from : &to) = a.x + (y0 - a.y) * per_rise;
	if ((a.y > y1) != (b.y > y1))
		*(a.y > y1 ? &from : &to) = a.x + (y1 - a.y) * per_rise;
	x[0] = fminf(x[0], fminf(from, to));
	x[1] = fmaxf(x[1], fmaxf(from, to));
}

void screen_grid_add(struct screen_grid *grid, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack)
{
	struct screen_point ends[EDGES_MAX][2];
	float bottom = INFINITY, top = -INFINITY;
	int first_row, last_row, first, last;
	assert(edge_count <= EDGES_MAX);
	for (size_t i = 0; i < edge_count; i++) {
		for (int end = 0; end < 2; end++) {
			const struct screen_point *point = &points[edges[i][end]];
			float x = to_cells(point->x), y = to_cells(point->y);
			/* false for NaN too */
			if (!(fabsf(x) < FAR_AWAY && fabsf(y) < FAR_AWAY)) {
				screen_grid_fill(grid);
				return;
			}
			ends[i][end] = (struct screen_point){x, y};
			bottom = fminf(bottom, y);
			top = fmaxf(top, y);
		}
	}
	if (!clip_cells(bottom - slack, top + slack, &first_row, &last_row))
		return;
	for (int row = first_row; row <= last_row; row++) {
		float x[2] = {INFINITY, -INFINITY};
		for (size_t i = 0; i < edge_count; i++)
			widen(ends[i][0], ends[i][1], (float)row - slack, (float)(row + 1) + slack,
				x);
		if (clip_cells(x[0] - slack, x[1] + slack, &first, &last))
			grid->rows[row] |= bits_between(first, last);
	}
}

bool screen_grid_touches(const struct screen_grid *grid, const float min[2], const float max[2])
{
	int first, last, first_row, last_row;
	if (!clip_cells(to_cells(min[0]), to_cells(max[0]), &first, &last) ||
		!clip_cells(to_cells(min[1]), to_cells(max[1]), &first_row, &last_row))
		return false;
	uint64_t found = 0;
	for (int row = first_row; row <= last_row; row++)
		found |= grid->rows[row];
	return (found & bits_between(first, last)) != 0;
}

int screen_grid_run_end(const struct screen_grid *grid, int x, int row)
{
	bool marked = screen_grid_has(grid, x, row);
	while (x < SCREEN_GRID_SIZE && screen_grid_has(grid, x, row) == marked)
		x++;
	return x;
}

bool screen_grid_bounds(const struct screen_grid *grid, int min[2], int max[2])
{
	uint64_t columns = 0;
	min[1] = SCREEN_GRID_SIZE;
	for (int row = 0; row < SCREEN_GRID_SIZE; row++) {
		columns |= grid->rows[row];
		if (grid->rows[row] == 0)
			continue;
		min[1] = row < min[1] ? row : min[1];
		max[1] = row + 1;
	}
	if (columns == 0)
		return false;
	min[0] = 0;
	max[0] = SCREEN_GRID_SIZE;
	while (!(columns >> min[0] & 1))
		min[0]++;
	while (!(columns >> (max[0] - 1) & 1))
		max[0]--;
	return true;
}

bool screen_grid_has(const struct screen_grid *grid, int x, int row)
{
	return grid->rows[row] >> x & 1;
}
