/* SPDX-License-Identifier: MIT */
#include "geom/sheets.h"
#include <assert.h>

/* The triangles from `first` on that show their backs. Those that are seen edge on do neither: they
 * hide nothing, and their boundary would lie on a line through the light. */
static void find_back(const struct caster *caster, const struct sheet_rule *rule,
	const float light[4], uint64_t *back)
{
	const float behind[4] = {-light[0], -light[1], -light[2], -light[3]};
	size_t first = rule->one_sided;
	(rule->all ? facing_find_all : facing_find)(caster, behind, back);
	for (size_t w = 0; w < first / EDGE_BLOCK; w++)
		back[w] = 0;
	back[first / EDGE_BLOCK] &= UINT64_MAX << first % EDGE_BLOCK;
}

static void reverse(struct silhouette_edge *edges, size_t begin, size_t end)
{
	for (size_t i = begin; i < end; i++)
		edges[i] = (struct silhouette_edge){edges[i].b, edges[i].a};
}

static size_t find(const struct caster *caster, const struct sheet_rule *rule,
	const uint64_t *facing, struct silhouette_edge *edges, size_t capacity)
{
	return (rule->all ? silhouette_find_all : silhouette_find)(caster, facing, edges, capacity);
}

static size_t smaller(size_t a, size_t b)
{
	return a < b ? a : b;
}

size_t sheets_find(const struct caster *caster, const struct sheet_rule *rule, const float light[4],
	const uint64_t *facing, uint64_t *back, struct silhouette_edge *edges, size_t capacity)
{
	assert(rule->one_sided <= caster->found.closed_count);
	size_t count = find(caster, rule, facing, edges, capacity);
	size_t written = smaller(count, capacity);
	if (rule->mirrored)
		reverse(edges, 0, written);
	if (rule->one_sided == caster->triangle_count)
		return count;
	find_back(caster, rule, light, back);
	size_t left = capacity - written;
	size_t more = find(caster, rule, back, left > 0 ? edges + written : NULL, left);
	/* What shows its back is on the right of its edges, but for a mirror. */
	if (!rule->mirrored)
		reverse(edges, written, written + smaller(more, left));
	return count + more;
}
