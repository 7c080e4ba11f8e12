/* SPDX-License-Identifier: MIT */
#include "geom/screen_grid.h"
#include <math.h>
#include <string.h>

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

void screen_grid_cut(struct screen_grid *grid, const struct screen_grid *other)
{
	for (int row = 0; row < SCREEN_GRID_SIZE; row++)
		grid->rows[row] &= other->rows[row];
}

void screen_grid_widen(struct screen_grid *grid)
{
	uint64_t below = 0;
	for (int row = 0; row < SCREEN_GRID_SIZE; row++) {
		uint64_t here = grid->rows[row];
		uint64_t above = row + 1 < SCREEN_GRID_SIZE ? grid->rows[row + 1] : 0;
		uint64_t all = below | here | above;
		grid->rows[row] = all | all << 1 | all >> 1;
		below = here;
	}
}

static uint64_t bits_between(int first, int last)
{
	return ~(uint64_t)0 >> (SCREEN_GRID_SIZE - 1 - last) & ~(uint64_t)0 << first;
}

void screen_grid_add(struct screen_grid *grid, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack)
{
	struct screen_hull hull;
	int first, last;
	if (!screen_hull_init(&hull, points, edges, edge_count, slack, SCREEN_GRID_SIZE))
		return;
	for (int row = hull.first_row; row <= hull.last_row; row++)
		if (screen_hull_row(&hull, row, &first, &last))
			grid->rows[row] |= bits_between(first, last);
}

bool screen_grid_touches(const struct screen_grid *grid, const float min[2], const float max[2])
{
	int first, last, first_row, last_row;
	if (!screen_cells_between(min[0], max[0], SCREEN_GRID_SIZE, &first, &last) ||
		!screen_cells_between(min[1], max[1], SCREEN_GRID_SIZE, &first_row, &last_row))
		return false;
	uint64_t found = 0;
	for (int row = first_row; row <= last_row; row++)
		found |= grid->rows[row];
	return (found & bits_between(first, last)) != 0;
}

float screen_grid_most(const float *of, const float min[2], const float max[2])
{
	int first, last, first_row, last_row;
	float most = 0.0f;
	if (!screen_cells_between(min[0], max[0], SCREEN_GRID_SIZE, &first, &last) ||
		!screen_cells_between(min[1], max[1], SCREEN_GRID_SIZE, &first_row, &last_row))
		return most;
	for (int row = first_row; row <= last_row; row++)
		for (int x = first; x <= last; x++)
			most = fmaxf(most, of[row * SCREEN_GRID_SIZE + x]);
	return most;
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

size_t screen_grid_count(const struct screen_grid *grid)
{
	size_t count = 0;
	for (int row = 0; row < SCREEN_GRID_SIZE; row++)
		for (uint64_t left = grid->rows[row]; left != 0; left &= left - 1)
			count++;
	return count;
}

bool screen_grid_has(const struct screen_grid *grid, int x, int row)
{
	return grid->rows[row] >> x & 1;
}
