/* SPDX-License-Identifier: MIT */
#include "scene/edge_hollows.h"
#include "base/array.h"
#include "base/float_range.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* By how much, in steps of EDGE_DEPTH_STEPS, receivers are before a plane where it counts, and from
 * a step of the raster grid beside where they are: those on the triangle itself are not. */
#define PLANE_DEPTH 8.0

/* Tiles along x or y that a part of the screen is in. */
struct span {
	uint32_t first, end;
};

static struct span span_of(float min, float max, uint32_t screen, uint32_t tiles)
{
	float per_step = (float)tiles / (float)screen, last = (float)(tiles - 1);
	float first = larger(smaller(min * per_step, last), 0.0f);
	float end = larger(smaller(max * per_step, last), 0.0f);
	return (struct span){(uint32_t)first, (uint32_t)end + 1};
}

/* Where one would be in too many tiles it is in none. */
static bool append(struct edge_hollows *lists, const struct chain_hollow *hollow, uint32_t index,
	uint32_t screen, uint32_t tiles)
{
	struct span x = span_of(hollow->min[0], hollow->max[0], screen, tiles);
	struct span y = span_of(hollow->min[1], hollow->max[1], screen, tiles);
	if (x.first >= x.end || y.first >= y.end)
		return true;
	size_t added = (size_t)(x.end - x.first) * (y.end - y.first);
	if (lists->count + added > EDGE_HOLLOWS_MAX) {
		lists->dropped += added;
		return true;
	}
	if (!array_reserve((void **)&lists->of, &lists->capacity, lists->count + added,
		    sizeof(*lists->of)))
		return false;
	for (uint32_t row = y.first; row < y.end; row++)
		for (uint32_t column = x.first; column < x.end; column++)
			lists->of[lists->count++] =
				(struct listed_hollow){row * tiles + column, index};
	return true;
}

static int compare(const void *p, const void *q)
{
	const struct listed_hollow *a = p, *b = q;
	if (a->tile != b->tile)
		return a->tile < b->tile ? -1 : 1;
	return a->hollow < b->hollow ? -1 : a->hollow > b->hollow;
}

/* Leaves those out that there is no room for. */
static void drop(struct edge_hollows *lists, size_t most)
{
	size_t kept = 0, of_tile = 0;
	uint32_t tile = 0;
	for (size_t i = 0; i < lists->count; i++) {
		const struct listed_hollow listed = lists->of[i];
		of_tile = listed.tile == tile ? of_tile + 1 : 1;
		tile = listed.tile;
		if (of_tile <= HOLLOWS_MAX && kept < most)
			lists->of[kept++] = listed;
	}
	lists->dropped += lists->count - kept;
	lists->count = kept;
}

bool edge_hollows_list(struct edge_hollows *lists, const struct edge_chains *chains,
	uint32_t screen, uint32_t tiles, size_t most)
{
	lists->count = lists->dropped = 0;
	for (size_t i = 0; i < chains->hollow_count; i++)
		if (!append(lists, &chains->hollows[i], (uint32_t)i, screen, tiles))
			return false;
	if (lists->count > 0)
		qsort(lists->of, lists->count, sizeof(*lists->of), compare);
	drop(lists, most);
	return true;
}

size_t edge_hollows_of_tile(const struct edge_hollows *lists, size_t first)
{
	size_t end = first + 1;
	while (end < lists->count && lists->of[end].tile == lists->of[first].tile)
		end++;
	return end - first;
}

static double clamp(double value, double low, double high)
{
	return fmax(low, fmin(value, high));
}

static struct hollow_plane plane_of(const struct chain_hollow *hollow, uint32_t screen)
{
	const struct chain_point *at = hollow->corners;
	double sides[2][3], least = at[0].depth;
	for (int k = 0; k < 2; k++) {
		sides[k][0] = at[k + 1].x - at[0].x;
		sides[k][1] = at[k + 1].y - at[0].y;
		sides[k][2] = ((double)at[k + 1].depth - at[0].depth) * EDGE_DEPTH_STEPS;
		least = fmin(least, at[k + 1].depth);
	}
	double area = sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0];
	/* One that is seen edge on is before nothing that is not before its ends. */
	area = area == 0.0 ? 0.5 : area;
	double slope[2] = {(sides[0][2] * sides[1][1] - sides[0][1] * sides[1][2]) / area,
		(sides[0][0] * sides[1][2] - sides[0][2] * sides[1][0]) / area};
	double start = at[0].depth * (double)EDGE_DEPTH_STEPS -
		       slope[0] * (at[0].x - 0.5 * screen) - slope[1] * (at[0].y - 0.5 * screen) -
		       fabs(slope[0]) - fabs(slope[1]) - PLANE_DEPTH;
	return (struct hollow_plane){
		.slope = {(float)slope[0], (float)slope[1]},
		.start = (float)start,
		.near = (uint16_t)clamp(least * 65536.0, 0.0, 65535.0),
		.far = (uint16_t)clamp(ceil((double)hollow->far * 65536.0), 0.0, 65535.0),
	};
}

void edge_hollows_write(const struct edge_hollows *lists, const struct edge_chains *chains,
	uint32_t screen, struct edge_texel *texels)
{
	size_t count;
	for (size_t first = 0; first < lists->count; first += count) {
		struct edge_texel *edges = &texels[HOLLOW_TEXELS * first];
		count = edge_hollows_of_tile(lists, first);
		for (size_t i = 0; i < count; i++) {
			const struct chain_hollow *hollow =
				&chains->hollows[lists->of[first + i].hollow];
			struct hollow_plane plane = plane_of(hollow, screen);
			for (size_t k = 0; k < 3; k++) {
				const struct chain_point edge[2] = {
					hollow->corners[k], hollow->corners[(k + 1) % 3]};
				edges[3 * i + k] = edge_texel_of(edge, screen);
			}
			memcpy(&edges[3 * count + i], &plane, sizeof(plane));
		}
	}
}

void edge_hollows_finish(struct edge_hollows *lists)
{
	free(lists->of);
	*lists = (struct edge_hollows){0};
}

size_t edge_hollows_bytes(const struct edge_hollows *lists)
{
	return lists->capacity * sizeof(*lists->of);
}
