/* SPDX-License-Identifier: MIT */
#include "geom/screen_parts.h"

/* Left or lower pixel of a cell: the first whose centre is in it. */
static int first_pixel(uint32_t pixels, int cell)
{
	uint64_t twice = 2 * (uint64_t)pixels * (uint64_t)cell;
	return (int)((twice + SCREEN_GRID_SIZE - 1) / (2 * SCREEN_GRID_SIZE));
}

static int rows_end(const struct screen_grid *cells, int row)
{
	int end = row + 1;
	while (end < SCREEN_GRID_SIZE && cells->rows[end] == cells->rows[row])
		end++;
	return end;
}

/* Finds the next run of marked cells in the part's rows; false: there is none from `x` on. */
static bool find_run(struct screen_part *part, const struct screen_grid *cells, int x)
{
	if (x < SCREEN_GRID_SIZE && !screen_grid_has(cells, x, part->bottom))
		x = screen_grid_run_end(cells, x, part->bottom);
	part->first = x;
	part->end = x < SCREEN_GRID_SIZE ? screen_grid_run_end(cells, x, part->bottom) : x;
	return x < SCREEN_GRID_SIZE;
}

bool screen_part_next(
	struct screen_part *part, const struct screen_grid *cells, uint32_t width, uint32_t height)
{
	bool found = part->top > 0 && find_run(part, cells, part->end);
	while (!found && part->top < SCREEN_GRID_SIZE) {
		part->bottom = part->top;
		part->top = rows_end(cells, part->bottom);
		found = find_run(part, cells, 0);
	}
	part->box = (struct pixel_box){
		.left = first_pixel(width, part->first),
		.bottom = first_pixel(height, part->bottom),
		.right = first_pixel(width, part->end),
		.top = first_pixel(height, part->top),
	};
	return found;
}
