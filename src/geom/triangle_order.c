/* SPDX-License-Identifier: MIT */
#include "geom/triangle_order.h"
#include "base/array.h"
#include "geom/edges.h"
#include "geom/face.h"
#include "geom/sides.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where a triangle is, as a share of the mesh's box, and its unit normal times NORMAL_WEIGHT, or
 * zero: what it has in common with others. */
#define FEATURES 6
#define NORMAL_WEIGHT 2.0f

struct item {
	float features[FEATURES];
	uint32_t triangle;
};

#define NONE UINT32_MAX

/* The growing of blocks. Triangles are counted from the first that is reordered. */
struct growth {
	size_t count;
	struct item *items;    /* of all triangles; sorted so that those alike are neighbours */
	uint32_t *place;       /* of a triangle among the items */
	uint32_t (*across)[3]; /* a triangle at each side, or NONE */
	uint8_t *touching;     /* how many of its neighbours are in the block */
	bool *taken;
	bool *waiting; /* in the block that is being threaded */
	uint32_t *order;
	size_t next; /* the first item that may be free */
};

/* A block that grows, and the free triangles around it. */
struct patch {
	double sum[FEATURES];
	size_t size, rim_count;
	uint32_t rim[3 * EDGE_BLOCK];
};

/* How alike the normals in a block are: the cosine of the angle to their mean, at least. */
#define LIKENESS_MIN 0.95
/* What a distance, as a share of the box, and a neighbour in the block count against an angle. */
#define DISTANCE_WEIGHT 1.0
#define NEIGHBOUR_WEIGHT 0.05

static void growth_finish(struct growth *growth)
{
	free(growth->items);
	free(growth->place);
	free(growth->across);
	free(growth->touching);
	free(growth->taken);
	free(growth->waiting);
	free(growth->order);
}

static bool growth_init(struct growth *growth, size_t count)
{
	*growth = (struct growth){
		.count = count,
		.items = array_alloc(count, sizeof(*growth->items)),
		.place = array_alloc(count, sizeof(*growth->place)),
		.across = array_alloc(count, sizeof(*growth->across)),
		.touching = array_zalloc(count, sizeof(*growth->touching)),
		.taken = array_zalloc(count, sizeof(*growth->taken)),
		.waiting = array_zalloc(count, sizeof(*growth->waiting)),
		.order = array_alloc(count, sizeof(*growth->order)),
	};
	return growth->items != NULL && growth->place != NULL && growth->across != NULL &&
	       growth->touching != NULL && growth->taken != NULL && growth->waiting != NULL &&
	       growth->order != NULL;
}

/* The longest side of the box around the triangles' vertices. */
static double extent_of(const float (*positions)[3], const uint32_t *indices, size_t count)
{
	double extent = 0.0;
	for (int axis = 0; axis < 3; axis++) {
		double min = INFINITY, max = -INFINITY;
		for (size_t i = 0; i < 3 * count; i++) {
			min = fmin(min, positions[indices[i]][axis]);
			max = fmax(max, positions[indices[i]][axis]);
		}
		extent = fmax(extent, max - min);
	}
	return extent;
}

static void find_features(
	struct growth *growth, const float (*positions)[3], const uint32_t *indices)
{
	double extent = extent_of(positions, indices, growth->count);
	double scale = extent > 0.0 ? 1.0 / extent : 0.0;
	const float *origin = positions[indices[0]];
	for (size_t t = 0; t < growth->count; t++) {
		const uint32_t *v = &indices[3 * t];
		const float *p = positions[v[0]];
		double n[3];
		face_normal(p, positions[v[1]], positions[v[2]], n);
		double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
		double weight = length > 0.0 ? NORMAL_WEIGHT / length : 0.0;
		for (int i = 0; i < 3; i++) {
			growth->items[t].features[i] = (float)(((double)p[i] - origin[i]) * scale);
			growth->items[t].features[3 + i] = (float)(n[i] * weight);
		}
		growth->items[t].triangle = (uint32_t)t;
	}
}

/* Which feature differs most. */
static int widest_feature(const struct item *items, size_t count)
{
	double sums[FEATURES] = {0}, squares[FEATURES] = {0}, most = -1.0;
	int widest = 0;
	for (size_t i = 0; i < count; i++) {
		for (int f = 0; f < FEATURES; f++) {
			sums[f] += items[i].features[f];
			squares[f] += (double)items[i].features[f] * items[i].features[f];
		}
	}
	for (int f = 0; f < FEATURES; f++) {
		double variance = squares[f] - sums[f] * sums[f] / (double)count;
		if (variance > most) {
			most = variance;
			widest = f;
		}
	}
	return widest;
}

static void swap_items(struct item *a, struct item *b)
{
	struct item kept = *a;
	*a = *b;
	*b = kept;
}

/* Moves the `middle` items least in a feature before the others (Hoare 1961, "Find"). */
static void partition(struct item *items, size_t count, size_t middle, int feature)
{
	size_t low = 0, high = count;
	while (high - low > 1) {
		float pivot = items[low + (high - low) / 2].features[feature];
		size_t i = low, j = high;
		for (;;) {
			while (items[i].features[feature] < pivot)
				i++;
			while (items[j - 1].features[feature] > pivot)
				j--;
			if (i >= j)
				break;
			swap_items(&items[i++], &items[--j]);
		}
		/* Below i nothing is above the pivot, and from j on nothing is below it. */
		if (middle < j)
			high = j;
		else if (middle > i)
			low = i;
		else
			return;
	}
}

/* Halves the items where they differ most, down to blocks. */
static void sort_alike(struct item *items, size_t count)
{
	while (count > EDGE_BLOCK) {
		size_t middle = count / 2;
		partition(items, count, middle, widest_feature(items, count));
		sort_alike(items, middle);
		items += middle;
		count -= middle;
	}
}

static bool find_across(struct growth *growth, const uint32_t *indices, size_t vertex_count)
{
	struct sides sides;
	if (!sides_init(&sides, indices, growth->count, vertex_count))
		return false;
	memset(growth->across, 0xff, growth->count * sizeof(*growth->across));
	for (size_t begin = 0, count; begin < sides.count; begin += count) {
		count = sides_at_edge(&sides, begin);
		const struct side *side = &sides.items[begin];
		for (size_t i = 0; i + 1 < count; i += 2) {
			growth->across[side[i].triangle][side[i].k] = side[i + 1].triangle;
			growth->across[side[i + 1].triangle][side[i + 1].k] = side[i].triangle;
		}
	}
	sides_finish(&sides);
	return true;
}

/* Low is better; INFINITY when the triangle looks another way than the block. */
static double misfit(const struct growth *growth, const struct patch *patch, uint32_t triangle)
{
	const float *own = growth->items[growth->place[triangle]].features;
	double distance = 0.0, dot = 0.0, length = 0.0;
	for (int i = 0; i < 3; i++) {
		double off = own[i] - patch->sum[i] / (double)patch->size;
		distance += off * off;
		dot += own[3 + i] * patch->sum[3 + i];
		length += patch->sum[3 + i] * patch->sum[3 + i];
	}
	double likeness = length > 0.0 ? dot / (NORMAL_WEIGHT * sqrt(length)) : 1.0;
	if (likeness < LIKENESS_MIN)
		return INFINITY;
	return 1.0 - likeness + DISTANCE_WEIGHT * sqrt(distance) -
	       NEIGHBOUR_WEIGHT * growth->touching[triangle];
}

/* The triangle around the block that fits best, removed from there; or the first free one. */
static uint32_t choose(struct growth *growth, struct patch *patch)
{
	size_t best = patch->rim_count;
	double least = INFINITY;
	for (size_t i = 0; i < patch->rim_count; i++) {
		double cost = misfit(growth, patch, patch->rim[i]);
		if (cost < least) {
			least = cost;
			best = i;
		}
	}
	if (best < patch->rim_count)
		return patch->rim[best];
	while (growth->taken[growth->items[growth->next].triangle])
		growth->next++;
	return growth->items[growth->next].triangle;
}

static void leave_rim(struct patch *patch, uint32_t triangle)
{
	for (size_t i = 0; i < patch->rim_count; i++) {
		if (patch->rim[i] == triangle) {
			patch->rim[i] = patch->rim[--patch->rim_count];
			return;
		}
	}
}

static void take(struct growth *growth, struct patch *patch, uint32_t triangle)
{
	const float *features = growth->items[growth->place[triangle]].features;
	growth->taken[triangle] = true;
	leave_rim(patch, triangle);
	patch->size++;
	for (int f = 0; f < FEATURES; f++)
		patch->sum[f] += features[f];
	for (int k = 0; k < 3; k++) {
		uint32_t other = growth->across[triangle][k];
		if (other != NONE && !growth->taken[other] && growth->touching[other]++ == 0)
			patch->rim[patch->rim_count++] = other;
	}
}

static void grow_block(struct growth *growth, size_t begin, size_t size)
{
	struct patch patch = {.size = 0};
	for (size_t i = 0; i < size; i++) {
		uint32_t triangle = choose(growth, &patch);
		take(growth, &patch, triangle);
		growth->order[begin + i] = triangle;
	}
	for (size_t i = 0; i < patch.rim_count; i++)
		growth->touching[patch.rim[i]] = 0;
}

/* How many triangles of the block that are still to be threaded are beside this one. */
static int count_waiting(const struct growth *growth, uint32_t triangle)
{
	int count = 0;
	for (int k = 0; k < 3; k++) {
		uint32_t other = growth->across[triangle][k];
		count += other != NONE && growth->waiting[other];
	}
	return count;
}

/* The waiting one of some triangles that has the fewest others beside it (Warnsdorff's rule), or
 * NONE. */
static uint32_t most_secluded(const struct growth *growth, const uint32_t *triangles, size_t count)
{
	uint32_t best = NONE;
	int fewest = 4;
	for (size_t i = 0; i < count; i++) {
		if (triangles[i] == NONE || !growth->waiting[triangles[i]])
			continue;
		int beside = count_waiting(growth, triangles[i]);
		if (beside < fewest) {
			fewest = beside;
			best = triangles[i];
		}
	}
	return best;
}

/* Orders a block so that as many triangles as can be are followed by one beside them. */
static void thread_block(struct growth *growth, size_t begin, size_t size)
{
	uint32_t members[EDGE_BLOCK], triangle = NONE;
	memcpy(members, &growth->order[begin], size * sizeof(*members));
	for (size_t i = 0; i < size; i++)
		growth->waiting[members[i]] = true;
	for (size_t i = 0; i < size; i++) {
		if (triangle != NONE)
			triangle = most_secluded(growth, growth->across[triangle], 3);
		if (triangle == NONE)
			triangle = most_secluded(growth, members, size);
		growth->waiting[triangle] = false;
		growth->order[begin + i] = triangle;
	}
}

static bool reorder(const struct growth *growth, uint32_t *indices)
{
	uint32_t *copy = array_copy(indices, growth->count, 3 * sizeof(*indices));
	if (copy == NULL)
		return false;
	for (size_t i = 0; i < growth->count; i++)
		memcpy(&indices[3 * i], &copy[3 * (size_t)growth->order[i]], 3 * sizeof(*indices));
	free(copy);
	return true;
}

bool triangle_order_blocks(const float (*positions)[3], size_t vertex_count, uint32_t *indices,
	size_t first, size_t triangle_count)
{
	struct growth growth;
	size_t count = triangle_count - first;
	uint32_t *own = &indices[3 * first];
	bool ok = growth_init(&growth, count) && find_across(&growth, own, vertex_count);
	if (ok && count > 0) {
		find_features(&growth, positions, own);
		sort_alike(growth.items, count);
		for (size_t i = 0; i < count; i++)
			growth.place[growth.items[i].triangle] = (uint32_t)i;
		for (size_t begin = 0, size; begin < count; begin += size) {
			size = EDGE_BLOCK - (first + begin) % EDGE_BLOCK;
			size = size < count - begin ? size : count - begin;
			grow_block(&growth, begin, size);
			thread_block(&growth, begin, size);
		}
		ok = reorder(&growth, own);
	}
	growth_finish(&growth);
	return ok;
}
