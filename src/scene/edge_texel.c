/* SPDX-License-Identifier: MIT */
#include "scene/edge_texel.h"
#include <math.h>

/* Of places. */
#define LIMIT ((1 << (EDGE_PLACE_BITS - 1)) - 1)

/* A point's x, y and depth, in steps. */
struct steps {
	double at[3];
};

static const double most[3] = {LIMIT, LIMIT, EDGE_DEPTH_STEPS - 2};

static struct steps steps_of(const struct chain_point *point, uint32_t screen)
{
	double middle = 0.5 * screen;
	return (struct steps){
		{point->x - middle, point->y - middle, (double)point->depth * EDGE_DEPTH_STEPS}};
}

static bool is_within(const struct steps *point)
{
	return fabs(point->at[0]) <= LIMIT && fabs(point->at[1]) <= LIMIT &&
	       point->at[2] <= most[2];
}

/* Leaves of the shares from `first` to `last` of the way those where a coordinate is at most a
 * limit.
 */
static void cut(double from, double to, double limit, double *first, double *last)
{
	double share = (limit - from) / (to - from);
	if (from > limit && to > limit)
		*last = *first;
	else if (from > limit)
		*first = fmax(*first, share);
	else if (to > limit)
		*last = fmin(*last, share);
}

/* Nothing is left where last <= first: both ends are the same then. */
static void clip(struct steps *from, struct steps *to)
{
	double first = 0.0, last = 1.0;
	struct steps a = *from, b = *to;
	for (int axis = 0; axis < 3; axis++) {
		cut(a.at[axis], b.at[axis], most[axis], &first, &last);
		if (axis < 2)
			cut(-a.at[axis], -b.at[axis], most[axis], &first, &last);
	}
	last = fmax(first, last);
	for (int axis = 0; axis < 3; axis++) {
		from->at[axis] = a.at[axis] + first * (b.at[axis] - a.at[axis]);
		to->at[axis] = a.at[axis] + last * (b.at[axis] - a.at[axis]);
	}
}

/* Plain C, where lrint() and fmin() are calls: that was half of what making a texel took. */
static int32_t clamped(double value, double low, double high)
{
	double within = value < low ? low : value > high ? high : value;
	return (int32_t)(within < 0.0 ? within - 0.5 : within + 0.5);
}

static void write_end(uint32_t words[2], const struct steps *end)
{
	uint32_t mask = (1u << EDGE_DEPTH_BITS) - 1;
	uint32_t depth = 2 * (uint32_t)clamped(0.5 * end->at[2], 0.0, 0.5 * most[2]);
	const uint32_t halves[2] = {depth >> EDGE_DEPTH_BITS, depth & mask};
	for (int axis = 0; axis < 2; axis++) {
		uint32_t place = (uint32_t)clamped(end->at[axis], -LIMIT, LIMIT);
		words[axis] = place << EDGE_DEPTH_BITS | halves[axis];
	}
}

struct edge_texel edge_texel_of(const struct chain_point edge[2], uint32_t screen)
{
	struct edge_texel texel;
	struct steps from = steps_of(&edge[0], screen), to = steps_of(&edge[1], screen);
	if (!is_within(&from) || !is_within(&to))
		clip(&from, &to);
	write_end(&texel.words[0], &from);
	write_end(&texel.words[2], &to);
	texel.words[1] |= chain_is_grazing(edge);
	texel.words[3] |= edge[0].sheets > 1 && !chain_is_grazing(edge);
	return texel;
}
