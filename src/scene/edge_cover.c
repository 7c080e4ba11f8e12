/* SPDX-License-Identifier: MIT */
#include "scene/edge_cover.h"
#include "base/array.h"
#include <stdlib.h>
#include <string.h>

/* Of a tile's list, beyond the tile: texels of the map. */
#define MARGIN_TEXELS 1.5f

/* What float rounds distances by, tiles. */
#define ROUNDING 1e-3f

/* A long edge is gone through in so many pieces at most, each with a depth of its own. */
#define PIECES_MAX 16

/* A receiver as near to the light's plane as to see the disc from its edge gets no more. */
#define FACING_MIN 0.25f

/* Tiles per unit of depth between an edge and a receiver at p of the screen, as far as a penumbra
 * reaches. It spreads by disc_scale(), and away from the axis of a spot, whose disc faces the
 * receiver, farther: sideways by the slant of the ray, and for that the disc's far rim is behind
 * its middle. With e the receiver's ray at distance 1:
 *	|x - p| <= scale sqrt(1 + e^2) (d_r - d_x + 2 half_extent |e| (K - d_r) / (1 + e^2) |x - p|)
 */
static float spread_at(const struct light_frame *frame, float scale, uint32_t tiles, uint32_t x,
	uint32_t y, float deepest)
{
	if (frame->parallel)
		return scale;
	float half = frame->half_extent, size = 2.0f / (float)tiles;
	float ex = half * (fabsf(((float)x + 0.5f) * size - 1.0f) + 0.5f * size);
	float ey = half * (fabsf(((float)y + 0.5f) * size - 1.0f) + 0.5f * size);
	float e2 = ex * ex + ey * ey, slanted = scale * sqrtf(1.0f + e2);
	float turned = slanted / (float)tiles * 2.0f * half * sqrtf(e2) / (1.0f + e2) *
		       fmaxf(frame->pole - deepest, 0.0f);
	return slanted / fmaxf(1.0f - turned, FACING_MIN);
}

bool edge_cover_init(struct edge_cover *cover, const struct tile_depths *depths,
	const struct light_frame *frame, uint32_t map_size, uint32_t subpixel_bits)
{
	uint32_t tiles = depths->tiles;
	size_t count = (size_t)tiles * tiles;
	if (!array_reserve(
		    (void **)&cover->margin, &cover->margin_capacity, count, sizeof(float)) ||
		!array_reserve(
			(void **)&cover->base, &cover->base_capacity, count, sizeof(float)) ||
		!array_reserve((void **)&cover->rate, &cover->rate_capacity, count, sizeof(float)))
		return false;
	float per_texel = (float)tiles / (float)map_size;
	/* Finite also times a depth. */
	float scale = fminf(disc_scale(frame) * (float)tiles, 1e6f);
	cover->tiles = tiles;
	cover->per_step = per_texel / (float)(1u << subpixel_bits);
	cover->widest = MARGIN_TEXELS * per_texel + ROUNDING;
	cover->rate_max = 0.0f;
	cover->deepest_max = 0.0f;
	for (size_t i = 0; i < count; i++) {
		float deepest = depths->deepest[i];
		float spread = spread_at(frame, scale, tiles, (uint32_t)(i % tiles),
			(uint32_t)(i / tiles), fmaxf(deepest, 0.0f));
		cover->margin[i] = deepest < 0.0f ? -1.0f : cover->widest;
		cover->base[i] = deepest < 0.0f ? -1.0f : spread * deepest + ROUNDING;
		cover->rate[i] = spread;
		cover->rate_max = fmaxf(cover->rate_max, spread);
		cover->deepest_max = fmaxf(cover->deepest_max, deepest);
	}
	return true;
}

/* A piece of an edge, in tiles, and a line |normal . p - offset| = 0 along it. */
struct piece {
	float min[2], max[2];
	float depth; /* the nearest */
	float normal[2], offset;
	float reach; /* at most */
};

static int clamp_tile(const struct edge_cover *cover, float coordinate)
{
	return (int)floorf(fmaxf(0.0f, fminf(coordinate, (float)cover->tiles)));
}

/* Narrows [*left, *right] to where a row comes as near to the piece's line as it reaches. */
static void narrow(const struct piece *piece, int row, float *left, float *right)
{
	float nx = piece->normal[0], ny = piece->normal[1];
	if (fabsf(nx) < 1e-3f)
		return;
	float middle = (piece->offset - ny * ((float)row + 0.5f)) / nx;
	float around = (piece->reach + 0.5f * fabsf(ny)) / fabsf(nx) + ROUNDING;
	*left = fmaxf(*left, middle - around);
	*right = fminf(*right, middle + around);
}

/* Marks the tiles of a row that the piece concerns: those whose box is within reach of its line and
 * of its box. */
static void cover_row(struct edge_cover *cover, const struct piece *piece, int row)
{
	float left = piece->min[0] - piece->reach, right = piece->max[0] + piece->reach;
	narrow(piece, row, &left, &right);
	int first = clamp_tile(cover, left), end = clamp_tile(cover, right + 1.0f);
	size_t start = (size_t)row * cover->tiles;
	const float *margin = &cover->margin[start], *base = &cover->base[start];
	const float *rate = &cover->rate[start];
	float nx = piece->normal[0], ny = piece->normal[1];
	float half = 0.5f * (fabsf(nx) + fabsf(ny));
	float at_zero = ny * ((float)row + 0.5f) + 0.5f * nx - piece->offset;
	float dy = fmaxf(fmaxf(piece->min[1] - (float)(row + 1), (float)row - piece->max[1]), 0.0f);
	uint64_t *bits = cover->rows[row];
	for (int x = first; x < end; x++) {
		float at = (float)x;
		float reach = fmaxf(margin[x], base[x] - rate[x] * piece->depth);
		float line = fabsf(at_zero + nx * at) - half;
		float dx = fmaxf(fmaxf(piece->min[0] - (at + 1.0f), at - piece->max[0]), 0.0f);
		bool near =
			(line <= reach) & (dx * dx + dy * dy <= reach * reach) & (reach >= 0.0f);
		bits[x / 64] |= (uint64_t)near << x % 64;
	}
}

/* Widens [*bottom, *top) to the rows it has marked. */
static void cover_piece(struct edge_cover *cover, const struct piece *piece, int *bottom, int *top)
{
	int first = clamp_tile(cover, piece->min[1] - piece->reach);
	int end = clamp_tile(cover, piece->max[1] + piece->reach + 1.0f);
	for (int row = first; row < end; row++)
		cover_row(cover, piece, row);
	if (first >= end)
		return;
	*bottom = first < *bottom ? first : *bottom;
	*top = end > *top ? end : *top;
}

/* Numbers of the marked tiles in rows [bottom, top), whose marks are taken away. */
static size_t take_marks(struct edge_cover *cover, int bottom, int top, uint16_t *found)
{
	size_t count = 0;
	for (int row = bottom; row < top; row++) {
		for (int half = 0; half < 2; half++) {
			uint64_t bits = cover->rows[row][half];
			uint32_t first = (uint32_t)row * cover->tiles + 64 * (uint32_t)half;
			for (; bits != 0; bits &= bits - 1)
				found[count++] =
					(uint16_t)(first + (uint32_t)__builtin_ctzll(bits));
			cover->rows[row][half] = 0;
		}
	}
	return count;
}

/* From a to b: x, y in tiles, and depth. */
static struct piece piece_of(const struct edge_cover *cover, const float a[3], const float b[3])
{
	struct piece piece = {.depth = fminf(a[2], b[2])};
	for (int axis = 0; axis < 2; axis++) {
		piece.min[axis] = fminf(a[axis], b[axis]);
		piece.max[axis] = fmaxf(a[axis], b[axis]);
	}
	piece.reach = fmaxf(
		cover->widest, cover->rate_max * (cover->deepest_max - piece.depth) + ROUNDING);
	/* In double: ends may be far off the screen. */
	double run = (double)b[0] - a[0], rise = (double)b[1] - a[1];
	double length = sqrt(run * run + rise * rise);
	/* A line through a point reaches everything: the box is left. */
	if (length < 1e-3)
		return piece;
	piece.normal[0] = (float)(-rise / length);
	piece.normal[1] = (float)(run / length);
	piece.offset = (float)((run * a[1] - rise * a[0]) / length);
	return piece;
}

size_t edge_cover_find(struct edge_cover *cover, const struct chain_point *a,
	const struct chain_point *b, uint16_t *found)
{
	float from[3] = {(float)a->x * cover->per_step, (float)a->y * cover->per_step, a->depth};
	float to[3] = {(float)b->x * cover->per_step, (float)b->y * cover->per_step, b->depth};
	/* A reach that changes by less than a tile is one. */
	float change = cover->rate_max * fabsf(to[2] - from[2]);
	int pieces = (int)fminf(1.0f + change, PIECES_MAX);
	int bottom = (int)cover->tiles, top = 0;
	float start[3], end[3];
	memcpy(start, from, sizeof(start));
	for (int i = 1; i <= pieces; i++) {
		glm_vec3_lerp(from, to, (float)i / (float)pieces, end);
		struct piece piece = piece_of(cover, start, i == pieces ? to : end);
		cover_piece(cover, &piece, &bottom, &top);
		memcpy(start, end, sizeof(start));
	}
	return take_marks(cover, bottom, top, found);
}

void edge_cover_finish(struct edge_cover *cover)
{
	free(cover->margin);
	free(cover->base);
	free(cover->rate);
	*cover = (struct edge_cover){0};
}

size_t edge_cover_bytes(const struct edge_cover *cover)
{
	return (cover->margin_capacity + cover->base_capacity + cover->rate_capacity) *
	       sizeof(float);
}
