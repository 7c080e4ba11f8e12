/* SPDX-License-Identifier: MIT */
#include "geom/repeats.h"
#include "base/array.h"
#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

/* A triangle is looked at over one edge alone, that between its two lowest vertices, and is told
 * from others there by its third. seen: [vertex_count], for each third vertex the triangle that was
 * the first one looked at over the edge where it was met last. */
static void mark_at_edge(const struct side *sides, size_t count, const uint32_t *indices,
	uint32_t *seen, bool *repeated)
{
	uint32_t edge = NONE;
	for (size_t i = 0; i < count; i++) {
		size_t t = sides[i].triangle;
		const uint32_t *v = &indices[3 * t], *ends = sides[i].vertex;
		uint32_t third = v[0] ^ v[1] ^ v[2] ^ ends[0] ^ ends[1];
		if (third < ends[1])
			continue;
		if (edge == NONE)
			edge = (uint32_t)t;
		repeated[t] = seen[third] == edge;
		seen[third] = edge;
	}
}

static size_t keep_others(const bool *repeated, uint32_t *indices, size_t triangle_count)
{
	size_t kept = 0;
	for (size_t t = 0; t < triangle_count; t++)
		if (!repeated[t])
			memmove(&indices[3 * kept++], &indices[3 * t], 3 * sizeof(*indices));
	return kept;
}

bool repeats_drop(
	const struct sides *sides, size_t vertex_count, uint32_t *indices, size_t *triangle_count)
{
	uint32_t *seen = array_alloc(vertex_count, sizeof(*seen));
	bool *repeated = array_zalloc(*triangle_count, sizeof(*repeated));
	bool ok = seen != NULL && repeated != NULL;
	if (ok) {
		for (size_t v = 0; v < vertex_count; v++)
			seen[v] = NONE;
		for (size_t begin = 0, count; begin < sides->count; begin += count) {
			count = sides_at_edge(sides, begin);
			mark_at_edge(&sides->items[begin], count, indices, seen, repeated);
		}
		*triangle_count = keep_others(repeated, indices, *triangle_count);
	}
	free(seen);
	free(repeated);
	return ok;
}
