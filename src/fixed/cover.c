/* SPDX-License-Identifier: MIT */
#include "fixed/cover.h"
#include <string.h>

/* Twice the area of a triangle, above 0 when it is counter-clockwise. Coordinates are below 2^15.
 */
static int64_t turn(const int32_t a[2], const int32_t b[2], const int32_t c[2])
{
	return (int64_t)(b[0] - a[0]) * (c[1] - a[1]) - (int64_t)(b[1] - a[1]) * (c[0] - a[0]);
}

int64_t outline_turn(const struct outline *outline, int a, int b, int c)
{
	return turn(outline->corners[a], outline->corners[b], outline->corners[c]);
}

/* Twice the area of a quad; 0 also when it is not convex. */
static int64_t convex_area(int32_t corners[4][2])
{
	int64_t area =
		turn(corners[0], corners[1], corners[2]) + turn(corners[0], corners[2], corners[3]);
	for (int i = 0; i < 4; i++) {
		int64_t at = turn(corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]);
		if ((at > 0 && area < 0) || (at < 0 && area > 0))
			return 0;
	}
	return area;
}

/* Pixels lie at their centres. Of two polygons with a common edge one has the pixels that lie on
 * it: the one whose left or top edge it is. */
static struct fixed_plane edge_of(const int32_t a[2], const int32_t b[2])
{
	const int32_t center = FIXED_SUBPIXELS / 2;
	int32_t x = b[0] - a[0], y = b[1] - a[1];
	if (x == 0 && y == 0)
		return (struct fixed_plane){0};
	bool left_or_top = y < 0 || (y == 0 && x < 0);
	int32_t at = x * (center - a[1]) - y * (center - a[0]);
	return (struct fixed_plane){
		at - (left_or_top ? 0 : 1), -FIXED_SUBPIXELS * y, FIXED_SUBPIXELS * x};
}

static int32_t max(int32_t a, int32_t b)
{
	return a > b ? a : b;
}

static int32_t min(int32_t a, int32_t b)
{
	return a < b ? a : b;
}

/* Pixels whose centres are in the box around corners; false when there are none. corners: x and y
 * of each. */
static bool find_rect(
	const int32_t *corners, int count, const struct fixed_screen *screen, int32_t rect[4])
{
	const int32_t size[2] = {screen->width, screen->height};
	for (int axis = 0; axis < 2; axis++) {
		int32_t low = corners[axis], high = low;
		for (int i = 1; i < count; i++) {
			low = min(low, corners[2 * i + axis]);
			high = max(high, corners[2 * i + axis]);
		}
		/* Coordinates are not below 0. */
		const int32_t half = FIXED_SUBPIXELS / 2;
		rect[axis] = max((low + half - 1) / FIXED_SUBPIXELS, screen->border);
		rect[2 + axis] = min((high + half) / FIXED_SUBPIXELS, size[axis] - screen->border);
	}
	return rect[0] < rect[2] && rect[1] < rect[3];
}

bool outline_has_pixels(const struct outline *outline, const struct fixed_screen *screen)
{
	int32_t rect[4];
	return find_rect(outline->corners[0], outline->count, screen, rect);
}

static int32_t tile_start(int32_t pixel)
{
	return pixel - pixel % FIXED_TILE;
}

static void start_tiles(struct cover_cutter *cutter)
{
	for (int axis = 0; axis < 2; axis++)
		cutter->tile[axis] = tile_start(cutter->piece.rect[axis]);
}

/* corners: in order around, of either orientation */
static bool piece_init(struct cover_cutter *cutter, int32_t corners[4][2], int count, bool ccw)
{
	cutter->piece = (struct fixed_cover){0};
	if (!find_rect(corners[0], count, cutter->screen, cutter->piece.rect))
		return false;
	for (int i = 0; i < count; i++) {
		const int32_t *a = corners[i], *b = corners[(i + 1) % count];
		cutter->piece.edges[i] = ccw ? edge_of(a, b) : edge_of(b, a);
	}
	start_tiles(cutter);
	return true;
}

/* Goes on in the fan around corner 0: by a quad if that is convex, else by a triangle. */
static bool next_piece(struct cover_cutter *cutter)
{
	const struct outline *outline = cutter->outline;
	while (cutter->next + 1 < outline->count) {
		int32_t corners[4][2];
		int at = cutter->next, left = outline->count - at;
		memcpy(corners[0], outline->corners[0], sizeof(corners[0]));
		memcpy(corners[1], outline->corners[at], (size_t)min(left, 3) * sizeof(corners[0]));
		int64_t area = left >= 3 ? convex_area(corners) : 0;
		int count = area != 0 ? 4 : 3;
		if (count == 3)
			area = turn(corners[0], corners[1], corners[2]);
		cutter->next += count - 2;
		if (area != 0 && piece_init(cutter, corners, count, area > 0))
			return true;
	}
	return false;
}

/* The largest that an edge has in a rectangle; within it nothing is beyond 32 bits. */
static int64_t most_inside(const struct fixed_plane *edge, const int32_t rect[4])
{
	int64_t x = edge->dx > 0 ? rect[2] - 1 : rect[0], y = edge->dy > 0 ? rect[3] - 1 : rect[1];
	return edge->at + edge->dx * x + edge->dy * y;
}

static bool may_cover(const struct fixed_cover *cover)
{
	for (int i = 0; i < 4; i++)
		if (most_inside(&cover->edges[i], cover->rect) < 0)
			return false;
	return cover->rect[0] < cover->rect[2] && cover->rect[1] < cover->rect[3];
}

/* The part of the piece in the tile, and on to the next tile. */
static void take_tile(struct cover_cutter *cutter, struct fixed_cover *cover)
{
	const int32_t *rect = cutter->piece.rect;
	int32_t *tile = cutter->tile;
	*cover = cutter->piece;
	if (rect[2] - rect[0] <= FIXED_TILE && rect[3] - rect[1] <= FIXED_TILE) {
		tile[1] = rect[3];
		return;
	}
	for (int axis = 0; axis < 2; axis++) {
		cover->rect[axis] = max(rect[axis], tile[axis]);
		cover->rect[2 + axis] = min(rect[2 + axis], tile[axis] + FIXED_TILE);
	}
	tile[0] += FIXED_TILE;
	if (tile[0] >= rect[2]) {
		tile[0] = tile_start(rect[0]);
		tile[1] += FIXED_TILE;
	}
}

void cover_cutter_init(struct cover_cutter *cutter, const struct outline *outline,
	const struct fixed_screen *screen)
{
	*cutter = (struct cover_cutter){.outline = outline, .screen = screen, .next = 1};
}

bool cover_cutter_next(struct cover_cutter *cutter, struct fixed_cover *cover)
{
	while (cutter->tile[1] < cutter->piece.rect[3] || next_piece(cutter)) {
		take_tile(cutter, cover);
		if (may_cover(cover))
			return true;
	}
	return false;
}
