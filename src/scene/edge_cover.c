/* SPDX-License-Identifier: MIT */
#include "scene/edge_cover.h"
#include "base/array.h"
#include "base/float4.h"
#include "base/float_range.h"
#include <stdlib.h>
#include <string.h>

/* Of a tile's list, beyond the tile: texels of the map. */
#define MARGIN_TEXELS 1.5f

/* What float rounds distances by, tiles. */
#define ROUNDING 1e-3f

/* A long edge is gone through in so many pieces at most, each with a depth of its own. */
#define PIECES_MAX 16

/* How far the far rim of the disc may be behind its middle, of the way to an edge. An edge that is
 * nearer concerns everything. */
#define TURN_MAX 0.75f

/* Of the disc's area, what a grazing triangle hides at least; and how much less deep than its plane
 * receivers are where it counts. */
#define GRAZING_SHARE (1.0 / 64.0)
#define GRAZING_DEPTH (32.0 / 16777216.0)

/* Halvings of the depths among which one is sought. */
#define LIMIT_STEPS 12

/* Tiles that are gone through at a time. */
#define TESTED 4

/* The depth of such an edge. */
#define AT_THE_LIGHT (-1e6f)

/* The light's frame as reaches depend on it. */
struct spread {
	float scale; /* disc_scale(), tiles */
	float slope; /* of the ray at the screen's rim, 0 for a directional light */
	float size;  /* of a tile, of half a screen */
	float pole;
};

static struct spread spread_of(const struct light_frame *frame, uint32_t tiles)
{
	return (struct spread){
		/* Finite also times a depth. */
		.scale = smaller(disc_scale(frame) * (float)tiles, 1e6f),
		.slope = frame->parallel ? 0.0f : frame->half_extent,
		.size = 2.0f / (float)tiles,
		.pole = frame->pole,
	};
}

/* Of the part of a tile that is farthest from the light's axis: slope of the ray along x or y. */
static inline float4 slope_at(const struct spread *spread, float4 tile)
{
	return spread->slope *
	       (absolute4((tile + 0.5f) * spread->size - 1.0f) + 0.5f * spread->size);
}

/* Of the way to window depth d, how far the disc that faces a receiver at the slope is turned away
 * from the light's axis, divided by K - d. */
static inline float4 turn_at(const struct spread *spread, float4 slope2)
{
	return spread->scale * spread->size * spread->slope * root4(slope2 / (1.0f + slope2));
}

/* Tiles per unit of depth between an edge and a receiver at p of the screen, as far as a penumbra
 * reaches. It spreads by disc_scale(), and away from the axis of a spot, whose disc faces the
 * receiver, farther: by the slant of the ray, and as the disc's far rim is behind its middle. With
 * e the receiver's ray at distance 1, of slope2 = e^2:
 *	|x - p| <= scale sqrt(1 + e^2) (d_r - d_x + 2 half_extent |e| (K - d_r) / (1 + e^2) |x - p|)
 * The deepest receiver is the one that is reached from farthest, while the turn on the way to the
 * edge is below 1.
 */
static inline float4 spread_at(const struct spread *spread, float4 slope2, float4 deepest)
{
	float4 none = {0.0f}, most = TURN_MAX + none;
	float4 turn = turn_at(spread, slope2) * larger4(spread->pole - deepest, none);
	return spread->scale * root4(1.0f + slope2) / (1.0f - smaller4(turn, most));
}

static float largest_of(float4 values)
{
	return larger(larger(values[0], values[1]), larger(values[2], values[3]));
}

/* A row of tiles whose receivers are at most so deep. */
static void init_row(
	struct edge_cover *cover, const struct spread *spread, uint32_t row, const float *deepest)
{
	size_t start = (size_t)row * cover->tiles;
	float4 none = {0.0f}, rate_max = none, deepest_max = none;
	float4 slope_y = slope_at(spread, (float)row + none);
	for (uint32_t x = 0; x < cover->tiles; x += TESTED) {
		float4 slope_x = slope_at(spread, (float)x + (float4){0.0f, 1.0f, 2.0f, 3.0f});
		float4 depth = load4(&deepest[x]);
		float4 reach = spread_at(
			spread, slope_x * slope_x + slope_y * slope_y, larger4(depth, none));
		int4 empty = depth < 0.0f;
		float4 rate = choose4(empty, none, reach);
		store4(&cover->margin[start + x],
			choose4(empty, none - 1.0f, cover->widest + none));
		store4(&cover->base[start + x],
			choose4(empty, none - 1.0f, reach * depth + ROUNDING));
		store4(&cover->rate[start + x], rate);
		rate_max = larger4(rate_max, rate);
		deepest_max = larger4(deepest_max, depth);
	}
	cover->rate_max = larger(cover->rate_max, largest_of(rate_max));
	cover->deepest_max = larger(cover->deepest_max, largest_of(deepest_max));
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
		!array_reserve((void **)&cover->grazing.found, &cover->grazing.capacity, count,
			sizeof(uint16_t)) ||
		!array_reserve((void **)&cover->rate, &cover->rate_capacity, count, sizeof(float)))
		return false;
	float per_texel = (float)tiles / (float)map_size;
	cover->tiles = tiles;
	cover->per_step = per_texel / (float)(1u << subpixel_bits);
	cover->widest = MARGIN_TEXELS * per_texel + ROUNDING;
	cover->rate_max = 0.0f;
	cover->deepest_max = 0.0f;
	struct spread spread = spread_of(frame, tiles);
	cover->deepest = depths->deepest;
	cover->grazing.corners = NULL;
	cover->scale = spread.scale;
	cover->turn_max = turn_at(&spread, 2.0f * spread.slope * spread.slope + (float4){0.0f})[0];
	cover->pole = frame->pole;
	for (uint32_t row = 0; row < tiles; row++)
		init_row(cover, &spread, row, &depths->deepest[(size_t)row * tiles]);
	return true;
}

/* A piece of an edge, in tiles, and a line |normal . p - offset| = 0 along it. */
struct piece {
	float min[2], max[2];
	float depth; /* the nearest */
	float normal[2], offset;
	float half;  /* of a tile's box, along the normal */
	float reach; /* at most */
	float per_x; /* 1 / normal[0]; 0: the line runs along rows */
};

static int clamp_tile(const struct edge_cover *cover, float coordinate)
{
	return (int)larger(0.0f, smaller(coordinate, (float)cover->tiles));
}

/* Narrows [*left, *right] to where a row comes as near to the piece's line as it reaches. */
static void narrow(const struct piece *piece, int row, float *left, float *right)
{
	float ny = piece->normal[1];
	if (piece->per_x == 0.0f)
		return;
	float middle = (piece->offset - ny * ((float)row + 0.5f)) * piece->per_x;
	float around = (piece->reach + 0.5f * fabsf(ny)) * fabsf(piece->per_x) + ROUNDING;
	*left = larger(*left, middle - around);
	*right = smaller(*right, middle + around);
}

/* Which of the tiles [x, x + TESTED) of a row the piece concerns, a bit each: those whose box is
 * within reach of its line and of its box. at_zero: of a tile 0's centre from the line; above:
 * square of the row's distance from the box. */
static inline uint32_t test_tiles(const struct edge_cover *cover, const struct piece *piece,
	size_t row_start, int x, float at_zero, float above)
{
	size_t first = row_start + (size_t)x;
	float4 at = (float)x + (float4){0.0f, 1.0f, 2.0f, 3.0f};
	float4 penumbra = load4(&cover->base[first]) - load4(&cover->rate[first]) * piece->depth;
	float4 reach = larger4(load4(&cover->margin[first]), penumbra);
	float4 center = at_zero + piece->normal[0] * at;
	float4 line = absolute4(center) - piece->half;
	float4 aside = larger4(piece->min[0] - 1.0f - at, at - piece->max[0]);
	float4 dx = larger4(aside, (float4){0.0f});
	/* A reach below 0 is within reach of no line. */
	int4 near = (line <= reach) & (dx * dx + above <= reach * reach) & (int4){1, 2, 4, 8};
	uint64_t halves[2];
	memcpy(halves, &near, sizeof(halves));
	halves[0] |= halves[1];
	return (uint32_t)(halves[0] | halves[0] >> 32);
}

/* Marks tiles from x on. */
static inline void mark(uint64_t row[2], int x, uint64_t bits)
{
	row[x / 64] |= bits << x % 64;
	if (x % 64 > 64 - TESTED)
		row[x / 64 + 1] |= bits >> (64 - x % 64);
}

/* Marks the tiles of a row that the piece concerns. */
static void cover_row(struct edge_cover *cover, const struct piece *piece, int row)
{
	float left = piece->min[0] - piece->reach, right = piece->max[0] + piece->reach;
	narrow(piece, row, &left, &right);
	int first = clamp_tile(cover, left), end = clamp_tile(cover, right + 1.0f);
	int last = (int)cover->tiles - TESTED;
	size_t start = (size_t)row * cover->tiles;
	float at_zero =
		piece->normal[1] * ((float)row + 0.5f) + 0.5f * piece->normal[0] - piece->offset;
	float dy =
		larger(larger(piece->min[1] - (float)(row + 1), (float)row - piece->max[1]), 0.0f);
	for (; first < end; first += TESTED) {
		int x = first < last ? first : last;
		mark(cover->rows[row], x, test_tiles(cover, piece, start, x, at_zero, dy * dy));
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
	int halves = cover->tiles > 64 ? 2 : 1;
	for (int row = bottom; row < top; row++) {
		for (int half = 0; half < halves; half++) {
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
	struct piece piece = {.depth = smaller(a[2], b[2])};
	if (cover->turn_max * (cover->pole - piece.depth) > TURN_MAX)
		piece.depth = AT_THE_LIGHT;
	for (int axis = 0; axis < 2; axis++) {
		piece.min[axis] = smaller(a[axis], b[axis]);
		piece.max[axis] = larger(a[axis], b[axis]);
	}
	piece.reach = larger(
		cover->widest, cover->rate_max * (cover->deepest_max - piece.depth) + ROUNDING);
	/* In double: ends may be far off the screen. */
	double run = (double)b[0] - a[0], rise = (double)b[1] - a[1];
	double length = sqrt(run * run + rise * rise);
	/* A line through a point reaches everything: the box is left. */
	if (length < 1e-3)
		return piece;
	piece.normal[0] = (float)(-rise / length);
	piece.normal[1] = (float)(run / length);
	piece.per_x = fabsf(piece.normal[0]) < 1e-3f ? 0.0f : 1.0f / piece.normal[0];
	piece.offset = (float)((run * a[1] - rise * a[0]) / length);
	piece.half = 0.5f * (fabsf(piece.normal[0]) + fabsf(piece.normal[1]));
	return piece;
}

/* Marks the tiles that an edge is near enough to. */
static void cover_edge(struct edge_cover *cover, const struct chain_point *a,
	const struct chain_point *b, int *bottom, int *top)
{
	float from[3] = {(float)a->x * cover->per_step, (float)a->y * cover->per_step, a->depth};
	float to[3] = {(float)b->x * cover->per_step, (float)b->y * cover->per_step, b->depth};
	/* A reach that changes by less than a tile is one. */
	float change = cover->rate_max * fabsf(to[2] - from[2]);
	int pieces = (int)smaller(1.0f + change, PIECES_MAX);
	float start[3], end[3];
	memcpy(start, from, sizeof(start));
	for (int i = 1; i <= pieces; i++) {
		glm_vec3_lerp(from, to, (float)i / (float)pieces, end);
		struct piece piece = piece_of(cover, start, i == pieces ? to : end);
		cover_piece(cover, &piece, bottom, top);
		memcpy(start, end, sizeof(start));
	}
}

/* A grazing triangle on the screen: x and y in tiles, and depth; and its plane's slopes. */
struct grazing {
	double at[3][3];
	double slope[2];
};

static double doubled_area(const double a[2], const double b[2], const double c[2])
{
	return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* False where its plane cannot be told: nothing is seen of it. */
static bool find_grazing(
	const struct edge_cover *cover, const struct chain_point *corners, struct grazing *grazing)
{
	double sides[2][3];
	for (int k = 0; k < 3; k++) {
		grazing->at[k][0] = corners[k].x * (double)cover->per_step;
		grazing->at[k][1] = corners[k].y * (double)cover->per_step;
		grazing->at[k][2] = corners[k].depth;
	}
	for (int i = 0; i < 3; i++) {
		sides[0][i] = grazing->at[1][i] - grazing->at[0][i];
		sides[1][i] = grazing->at[2][i] - grazing->at[0][i];
	}
	double area = sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0];
	if (area == 0.0)
		return false;
	grazing->slope[0] = (sides[0][2] * sides[1][1] - sides[0][1] * sides[1][2]) / area;
	grazing->slope[1] = (sides[0][0] * sides[1][2] - sides[0][2] * sides[1][0]) / area;
	/* Flat ones graze no light but by rounding. */
	return grazing->slope[0] != 0.0 || grazing->slope[1] != 0.0;
}

/* Whether all receivers in a tile are before the plane. */
static bool is_after(const struct edge_cover *cover, const struct grazing *grazing, uint32_t tile)
{
	const double *slope = grazing->slope, *at = grazing->at[0];
	double x = tile % cover->tiles + 0.5 - at[0], y = tile / cover->tiles + 0.5 - at[1];
	double around = 0.5 + (double)cover->per_step;
	double least =
		at[2] + slope[0] * x + slope[1] * y - around * (fabs(slope[0]) + fabs(slope[1]));
	return least > (double)cover->deepest[tile] + GRAZING_DEPTH;
}

/* Whether it may hide its share from a receiver at a depth behind its middle: one that has it
 * before rim of its disc, from where its plane is seen at the greatest angle. */
static bool shows(const struct edge_cover *cover, const struct grazing *grazing, double depth)
{
	double middle[3] = {0.0, 0.0, 0.0}, most = 0.0, seen[3][2];
	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++)
			middle[i] += grazing->at[k][i] / 3.0;
	double steep = hypot(grazing->slope[0], grazing->slope[1]);
	for (int side = -1; side <= 1; side += 2) {
		for (int k = 0; k < 3; k++) {
			double before = (double)cover->scale * (depth - grazing->at[k][2]);
			if (before <= 0.0)
				return true;
			for (int i = 0; i < 2; i++) {
				double aside = side * (double)cover->scale * (depth - middle[2]) *
					       grazing->slope[i] / steep;
				seen[k][i] = (grazing->at[k][i] - middle[i] - aside) / before;
			}
		}
		most = fmax(most, fabs(doubled_area(seen[0], seen[1], seen[2])));
	}
	return 0.5 * most >= GLM_PI * GRAZING_SHARE;
}

/* The depth of receivers from which on it shows no more. */
static double depth_limit(const struct edge_cover *cover, const struct grazing *grazing)
{
	double near = 0.0, far = 1.0;
	for (int k = 0; k < 3; k++)
		near = fmax(near, grazing->at[k][2]);
	if (near >= far || shows(cover, grazing, far))
		return far;
	for (int i = 0; i < LIMIT_STEPS; i++) {
		double middle = 0.5 * (near + far);
		*(shows(cover, grazing, middle) ? &near : &far) = middle;
	}
	return far;
}

/* The one that is longest on the screen, where the triangle is narrow: the others are as near. */
static int longest_side(const struct chain_point *corners)
{
	double longest = -1.0;
	int found = 0;
	for (int k = 0; k < 3; k++) {
		double length = hypot((double)corners[k + 1].x - corners[k].x,
			(double)corners[k + 1].y - corners[k].y);
		found = length > longest ? k : found;
		longest = fmax(longest, length);
	}
	return found;
}

/* Has cover->grazing be of a triangle. */
static void find_grazing_tiles(struct edge_cover *cover, const struct chain_point *corners)
{
	int bottom = (int)cover->tiles, top = 0, side = longest_side(corners);
	uint16_t *found = cover->grazing.found;
	float deepest_max = cover->deepest_max;
	struct grazing grazing;
	cover->grazing.corners = corners;
	cover->grazing.count = 0;
	if (!find_grazing(cover, corners, &grazing))
		return;
	double limit = depth_limit(cover, &grazing);
	cover->deepest_max = smaller(deepest_max, (float)limit);
	cover_edge(cover, &corners[side], &corners[side + 1], &bottom, &top);
	cover->deepest_max = deepest_max;
	size_t count = take_marks(cover, bottom, top, found);
	for (size_t i = 0; i < count; i++)
		if ((double)cover->deepest[found[i]] <= limit &&
			is_after(cover, &grazing, found[i]))
			found[cover->grazing.count++] = found[i];
}

size_t edge_cover_find(struct edge_cover *cover, const struct chain_point *a,
	const struct chain_point *b, uint16_t *found)
{
	int bottom = (int)cover->tiles, top = 0;
	if (!chain_is_grazing(a)) {
		cover_edge(cover, a, b, &bottom, &top);
		return take_marks(cover, bottom, top, found);
	}
	const struct chain_point *corners = a - (a->sheets - CHAIN_GRAZING);
	if (cover->grazing.corners != corners)
		find_grazing_tiles(cover, corners);
	memcpy(found, cover->grazing.found, cover->grazing.count * sizeof(*found));
	return cover->grazing.count;
}

void edge_cover_finish(struct edge_cover *cover)
{
	free(cover->margin);
	free(cover->base);
	free(cover->rate);
	free(cover->grazing.found);
	*cover = (struct edge_cover){0};
}

size_t edge_cover_bytes(const struct edge_cover *cover)
{
	return (cover->margin_capacity + cover->base_capacity + cover->rate_capacity) *
		       sizeof(float) +
	       cover->grazing.capacity * sizeof(uint16_t);
}
