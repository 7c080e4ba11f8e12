/* SPDX-License-Identifier: MIT */
#include "scene/edge_winding.h"
#include <string.h>

/* The least integer that is not below dividend / divisor; divisor > 0. */
static int64_t divide_up(int64_t dividend, int64_t divisor)
{
	int64_t quotient = dividend / divisor;
	return quotient + (dividend % divisor > 0);
}

static int64_t clamp(int64_t value, int64_t low, int64_t high)
{
	return value < low ? low : value > high ? high : value;
}

/* The rows whose centres are below y. In units of 1 / (2 tiles) steps that of row i is at
 * (2 i + 1) screen. */
static int64_t rows_below(int64_t y, int64_t screen, int64_t tiles)
{
	return clamp(divide_up(2 * tiles * y - screen, 2 * screen), 0, tiles);
}

/* In each row whose centre an edge passes, the tiles to the left of it are wound around once more,
 * or less where it runs down: where that changes is noted. */
static void add_edge(const struct chain_point *a, const struct chain_point *b, int64_t screen,
	int64_t tiles, int32_t *changes)
{
	const struct chain_point *low = a->y < b->y ? a : b, *high = low == a ? b : a;
	int32_t turn = a->y < b->y ? (int32_t)a->sheets : -(int32_t)a->sheets;
	int64_t first = rows_below(low->y, screen, tiles);
	int64_t end = rows_below(high->y, screen, tiles);
	int64_t rise = (int64_t)high->y - low->y, run = (int64_t)high->x - low->x;
	for (int64_t row = first; row < end; row++) {
		/* x times rise, in units of 1 / (2 tiles) steps; below 2^60. */
		int64_t above = (2 * row + 1) * screen - 2 * tiles * low->y;
		int64_t at = 2 * tiles * rise * low->x + above * run;
		int64_t centre = screen * rise;
		int64_t left = clamp(divide_up(at - centre, 2 * centre), 0, tiles);
		changes[row * tiles] += turn;
		if (left < tiles)
			changes[row * tiles + left] -= turn;
	}
}

void edge_winding_find(
	const struct edge_chains *chains, uint32_t screen, uint32_t tiles, int32_t *winding)
{
	memset(winding, 0, (size_t)tiles * tiles * sizeof(*winding));
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *a = &chains->points[i], *b = a + 1;
		if (a->sheets > 0 && !chain_is_grazing(a) && a->y != b->y)
			add_edge(a, b, screen, tiles, winding);
	}
	for (size_t row = 0; row < tiles; row++)
		for (size_t x = 1; x < tiles; x++)
			winding[row * tiles + x] += winding[row * tiles + x - 1];
}
