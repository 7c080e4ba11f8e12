/* SPDX-License-Identifier: MIT */
#include "geom/sides.h"
#include "base/array.h"
#include <stdlib.h>

static size_t collect_sides(const uint32_t *indices, size_t triangle_count, struct side *sides)
{
	size_t count = 0;
	for (size_t t = 0; t < triangle_count; t++) {
		const uint32_t *v = &indices[3 * t];
		if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
			continue;
		for (int k = 0; k < 3; k++) {
			uint32_t from = v[k], to = v[(k + 1) % 3];
			sides[count++] = (struct side){
				.vertex = {from < to ? from : to, from < to ? to : from},
				.triangle = (uint32_t)t,
				.k = (uint8_t)k,
				.reversed = from > to,
			};
		}
	}
	return count;
}

/* A stable counting sort by vertex[end]; ends: [vertex_count + 1]. */
static void sort_sides(const struct side *sides, size_t count, int end, size_t *ends,
	size_t vertex_count, struct side *sorted)
{
	for (size_t v = 0; v <= vertex_count; v++)
		ends[v] = 0;
	for (size_t i = 0; i < count; i++)
		ends[sides[i].vertex[end] + 1]++;
	for (size_t v = 0; v < vertex_count; v++)
		ends[v + 1] += ends[v];
	for (size_t i = 0; i < count; i++)
		sorted[ends[sides[i].vertex[end]]++] = sides[i];
}

bool sides_init(
	struct sides *sides, const uint32_t *indices, size_t triangle_count, size_t vertex_count)
{
	struct side *items = array_alloc(triangle_count, 3 * sizeof(*items));
	struct side *sorted = array_alloc(triangle_count, 3 * sizeof(*sorted));
	size_t *ends = array_alloc(vertex_count + 1, sizeof(*ends));
	bool ok = items != NULL && sorted != NULL && ends != NULL;
	*sides = (struct sides){.items = items};
	if (ok) {
		sides->count = collect_sides(indices, triangle_count, items);
		sort_sides(items, sides->count, 1, ends, vertex_count, sorted);
		sort_sides(sorted, sides->count, 0, ends, vertex_count, items);
	} else {
		sides_finish(sides);
	}
	free(sorted);
	free(ends);
	return ok;
}

void sides_finish(struct sides *sides)
{
	free(sides->items);
	*sides = (struct sides){0};
}

size_t sides_at_edge(const struct sides *sides, size_t begin)
{
	const struct side *first = &sides->items[begin];
	size_t end = begin + 1;
	while (end < sides->count && sides->items[end].vertex[0] == first->vertex[0] &&
		sides->items[end].vertex[1] == first->vertex[1])
		end++;
	return end - begin;
}

struct edge_counts sides_count_edges(const struct sides *sides)
{
	struct edge_counts counts = {0};
	for (size_t begin = 0, count; begin < sides->count; begin += count) {
		const struct side *side = &sides->items[begin];
		count = sides_at_edge(sides, begin);
		counts.edges++;
		counts.open += count == 1;
		counts.non_manifold += count > 2;
		counts.inverted += count == 2 && side[0].reversed == side[1].reversed;
	}
	return counts;
}
