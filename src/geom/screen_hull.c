/* SPDX-License-Identifier: MIT */
#include "geom/screen_hull.h"
#include <assert.h>
#include <math.h>

/* Points farther away than this many cells leave no digits for where their edge crosses a cell. */
#define FAR_AWAY 1e4f

static float to_cells(float ndc, int size)
{
	return (ndc * 0.5f + 0.5f) * (float)size;
}

/* First and last cell of from..to that are on the screen; false if none is. */
static bool clip_cells(float from, float to, int size, int *first, int *last)
{
	float lo = fmaxf(floorf(from), 0.0f), hi = fminf(floorf(to), (float)size - 1.0f);
	if (!(lo <= hi))
		return false;
	*first = (int)lo;
	*last = (int)hi;
	return true;
}

bool screen_cells_between(float from, float to, int size, int *first, int *last)
{
	return clip_cells(to_cells(from, size), to_cells(to, size), size, first, last);
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

bool screen_hull_init(struct screen_hull *hull, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack, int size)
{
	float bottom = INFINITY, top = -INFINITY;
	assert(edge_count <= SCREEN_HULL_EDGES_MAX);
	hull->edge_count = edge_count;
	hull->size = size;
	hull->slack = slack;
	hull->everywhere = false;
	for (size_t i = 0; i < edge_count; i++) {
		for (int end = 0; end < 2; end++) {
			const struct screen_point *point = &points[edges[i][end]];
			float x = to_cells(point->x, size), y = to_cells(point->y, size);
			/* false for NaN too */
			if (!(fabsf(x) < FAR_AWAY && fabsf(y) < FAR_AWAY)) {
				hull->everywhere = true;
				hull->first_row = 0;
				hull->last_row = size - 1;
				return true;
			}
			hull->ends[i][end] = (struct screen_point){x, y};
			bottom = fminf(bottom, y);
			top = fmaxf(top, y);
		}
	}
	return clip_cells(bottom - slack, top + slack, size, &hull->first_row, &hull->last_row);
}

bool screen_hull_row(const struct screen_hull *hull, int row, int *first, int *last)
{
	float x[2] = {INFINITY, -INFINITY}, slack = hull->slack;
	if (hull->everywhere) {
		*first = 0;
		*last = hull->size - 1;
		return true;
	}
	for (size_t i = 0; i < hull->edge_count; i++)
		widen(hull->ends[i][0], hull->ends[i][1], (float)row - slack,
			(float)(row + 1) + slack, x);
	return clip_cells(x[0] - slack, x[1] + slack, hull->size, first, last);
}
