/* SPDX-License-Identifier: MIT */
#include "geom/screen_cover.h"
#include <string.h>

void screen_cover_clear(struct screen_cover *cover)
{
	memset(cover, 0, sizeof(*cover));
}

void screen_cover_fill(struct screen_cover *cover)
{
	memset(cover, 0xff, sizeof(*cover));
}

/* Those of a word's bits that are among the cells first..last; some are. */
static uint64_t bits_of_word(int word, int first, int last)
{
	int from = first > 64 * word ? first - 64 * word : 0;
	int to = last < 64 * word + 63 ? last - 64 * word : 63;
	return ~(uint64_t)0 >> (63 - to) & ~(uint64_t)0 << from;
}

static void set_cells(uint64_t *row, int first, int last)
{
	for (int word = first / 64; word <= last / 64; word++)
		row[word] |= bits_of_word(word, first, last);
}

void screen_cover_add(struct screen_cover *cover, const struct screen_point *points,
	const uint8_t (*edges)[2], size_t edge_count, float slack)
{
	struct screen_hull hull;
	int first, last;
	if (!screen_hull_init(&hull, points, edges, edge_count, slack, SCREEN_COVER_SIZE))
		return;
	for (int row = hull.first_row; row <= hull.last_row; row++) {
		if (screen_hull_row(&hull, row, &first, &last))
			set_cells(cover->rows[row], first, last);
	}
}

struct cells {
	int first, last, first_row, last_row;
};

/* Those that a rectangle touches; false if it touches none. */
static bool find_cells(const float min[2], const float max[2], struct cells *cells)
{
	return screen_cells_between(
		       min[0], max[0], SCREEN_COVER_SIZE, &cells->first, &cells->last) &&
	       screen_cells_between(
		       min[1], max[1], SCREEN_COVER_SIZE, &cells->first_row, &cells->last_row);
}

void screen_cover_add_rectangle(struct screen_cover *cover, const float min[2], const float max[2])
{
	struct cells cells;
	if (!find_cells(min, max, &cells))
		return;
	for (int row = cells.first_row; row <= cells.last_row; row++)
		set_cells(cover->rows[row], cells.first, cells.last);
}

bool screen_cover_touches(const struct screen_cover *cover, const float min[2], const float max[2])
{
	struct cells cells;
	if (!find_cells(min, max, &cells))
		return false;
	for (int row = cells.first_row; row <= cells.last_row; row++)
		for (int word = cells.first / 64; word <= cells.last / 64; word++)
			if (cover->rows[row][word] & bits_of_word(word, cells.first, cells.last))
				return true;
	return false;
}
