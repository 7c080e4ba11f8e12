/* SPDX-License-Identifier: MIT */
#include "scene/edge_merge.h"

/* Edges that one is made of, at most. */
#define MERGED_MAX 24

/* Rows of texels that a triangle between a chain and its chord may touch the centres of, at most:
 * what is larger is not worth the search. */
#define ROWS_MAX 4

/* The greatest k for which texel centre k is not above the coordinate. */
static int32_t centre_below(int32_t coordinate, int32_t texel)
{
	int32_t shifted = coordinate - texel / 2, k = shifted / texel;
	return k - (shifted % texel < 0);
}

static int32_t least(int32_t a, int32_t b)
{
	return a < b ? a : b;
}

static int32_t most(int32_t a, int32_t b)
{
	return a > b ? a : b;
}

/* Widens [*low, *high] to where a side of a triangle passes a height. */
static void widen_by_side(const struct chain_point *a, const struct chain_point *b, int32_t y,
	double *low, double *high)
{
	if (most(a->y, b->y) < y || least(a->y, b->y) > y)
		return;
	double share = a->y == b->y ? 0.0 : ((double)y - a->y) / ((double)b->y - a->y);
	double x = a->x + share * ((double)b->x - a->x);
	*low = fmin(*low, x);
	*high = fmax(*high, x);
	if (a->y == b->y) {
		*low = fmin(*low, b->x);
		*high = fmax(*high, b->x);
	}
}

/* Whether no texel's centre is in a triangle, nor a step beside it. */
static bool is_between_centres(const struct chain_point *a, const struct chain_point *b,
	const struct chain_point *c, int32_t texel)
{
	int32_t bottom = least(a->y, least(b->y, c->y)), top = most(a->y, most(b->y, c->y));
	int32_t first = centre_below(bottom - 1, texel) + 1, last = centre_below(top, texel);
	if (last - first >= ROWS_MAX)
		return false;
	for (int32_t row = first; row <= last; row++) {
		int32_t y = row * texel + texel / 2;
		double low = INFINITY, high = -INFINITY;
		widen_by_side(a, b, y, &low, &high);
		widen_by_side(b, c, y, &low, &high);
		widen_by_side(c, a, y, &low, &high);
		if (low <= high && centre_below((int32_t)ceil(high) + 1, texel) !=
					   centre_below((int32_t)floor(low) - 2, texel))
			return false;
	}
	return true;
}

/* Whether a point is as near to an edge as is tolerated. */
static bool is_near(const struct chain_point *point, const struct chain_point *from,
	const struct chain_point *to, const struct edge_tolerance *tolerance)
{
	double run = (double)to->x - from->x, rise = (double)to->y - from->y;
	double x = (double)point->x - from->x, y = (double)point->y - from->y;
	double length2 = run * run + rise * rise;
	double share = length2 > 0.0 ? (x * run + y * rise) / length2 : 0.0;
	share = fmax(0.0, fmin(share, 1.0));
	x -= share * run;
	y -= share * rise;
	double depth = from->depth + share * ((double)to->depth - from->depth);
	return x * x + y * y <= (double)tolerance->steps * tolerance->steps &&
	       fabs(depth - point->depth) <= tolerance->depth;
}

/* How far from `first` one edge can go. */
static size_t merged_end(
	const struct chain_point *points, size_t first, const struct edge_tolerance *tolerance)
{
	size_t end = first + 1;
	while (!points[end].ends && end - first < MERGED_MAX) {
		if (!is_between_centres(&points[first], &points[end], &points[end + 1],
			    (int32_t)tolerance->texel))
			return end;
		for (size_t i = first + 1; i <= end; i++)
			if (!is_near(&points[i], &points[first], &points[end + 1], tolerance))
				return end;
		end++;
	}
	return end;
}

/* Whether nothing is left of a chain but a point and itself. */
static bool is_point(const struct chain_point *chain, size_t count, float depth)
{
	return count == 2 && chain[0].x == chain[1].x && chain[0].y == chain[1].y &&
	       fabsf(chain[0].depth - chain[1].depth) <= depth;
}

void edge_merge(struct edge_chains *chains, const struct edge_tolerance *tolerance)
{
	struct chain_point *points = chains->points;
	size_t kept = 0, chain = 0;
	for (size_t i = 0; i < chains->count;) {
		bool ends = points[i].ends;
		/* Written no later than it is read. */
		size_t next = ends ? i + 1 : merged_end(points, i, tolerance);
		points[kept++] = points[i];
		i = next;
		if (!ends)
			continue;
		if (is_point(&points[chain], kept - chain, tolerance->depth))
			kept = chain;
		chain = kept;
	}
	chains->count = kept;
}
