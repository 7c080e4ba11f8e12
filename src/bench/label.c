/* SPDX-License-Identifier: MIT */
#include "bench/label.h"
#include <math.h>

/* Between a point and its text, pixels. */
#define GAP 9

/* Where a text may stand, in rings around its point: right and left are read best. */
static const double directions[][2] = {
	{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

#define DIRECTIONS (sizeof(directions) / sizeof(directions[0]))
#define RINGS 8

struct surroundings {
	const struct label *labels;
	size_t count, self;
	const struct box *obstacles;
	size_t obstacle_count;
	const struct box *area;
};

static double shared_area(const struct box *a, const struct box *b)
{
	double area = 1;
	for (int axis = 0; axis < 2; axis++) {
		double low = fmax(a->center[axis] - a->half[axis], b->center[axis] - b->half[axis]);
		double high =
			fmin(a->center[axis] + a->half[axis], b->center[axis] + b->half[axis]);
		area *= fmax(high - low, 0);
	}
	return area;
}

/* How bad it is for a text to be there: what it covers, in pixels, and what of it is outside, where
 * it is not seen at all. */
static double cost(const struct surroundings *around, const struct box *text)
{
	double sum = 8 * (4 * text->half[0] * text->half[1] - shared_area(text, around->area));
	for (size_t i = 0; i < around->obstacle_count; i++)
		sum += shared_area(text, &around->obstacles[i]);
	for (size_t i = 0; i < around->count; i++)
		if (i != around->self)
			sum += shared_area(text, &around->labels[i].text);
	return sum;
}

/* Of the places that cover least the nearest and best to read. */
static struct box best_place(const struct surroundings *around)
{
	const struct label *label = &around->labels[around->self];
	struct box best = label->text;
	double least = INFINITY;
	for (size_t i = 0; i < RINGS * DIRECTIONS; i++) {
		const double *direction = directions[i % DIRECTIONS];
		double gap = GAP + 10.0 * (double)(i / DIRECTIONS);
		struct box text = label->text;
		for (int axis = 0; axis < 2; axis++)
			text.center[axis] =
				label->point[axis] + direction[axis] * (text.half[axis] + gap);
		double here = cost(around, &text) + 0.1 * (double)i;
		if (here < least) {
			least = here;
			best = text;
		}
	}
	return best;
}

void labels_place(struct label *labels, size_t count, const struct box *obstacles,
	size_t obstacle_count, const struct box *area)
{
	for (size_t i = 0; i < count; i++)
		labels[i].text.center[0] = labels[i].text.center[1] = -INFINITY;
	/* Those that were placed first see the others from the second round on. */
	for (int round = 0; round < 4; round++)
		for (size_t i = 0; i < count; i++)
			labels[i].text = best_place(&(struct surroundings){
				labels, count, i, obstacles, obstacle_count, area});
}
