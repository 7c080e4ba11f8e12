/* SPDX-License-Identifier: MIT */
#include "geom/solid.h"
#include "base/array.h"
#include <stdlib.h>

/* Union-find over vertices, with path halving. */
static uint32_t root_of(uint32_t *parents, uint32_t v)
{
	while (parents[v] != v) {
		parents[v] = parents[parents[v]];
		v = parents[v];
	}
	return v;
}

static void join_triangles(const struct caster *caster, uint32_t *parents)
{
	for (uint32_t v = 0; v < caster->vertex_count; v++)
		parents[v] = v;
	for (size_t t = 0; t < caster->triangle_count; t++) {
		const uint32_t *corner = &caster->indices[3 * t];
		uint32_t root = root_of(parents, corner[0]);
		parents[root_of(parents, corner[1])] = root;
		parents[root_of(parents, corner[2])] = root;
	}
}

/* Six times the volume between the triangle and the origin, which moves to a vertex of its part so
 * that a mesh far from its origin keeps its digits. */
static double volume_under(const struct caster *caster, const uint32_t corner[3], uint32_t origin)
{
	const float(*p)[3] = (const float(*)[3])caster->positions;
	return face_volume(p[corner[0]], p[corner[1]], p[corner[2]], p[origin]);
}

static bool parts_are_outward(const struct caster *caster, uint32_t *parents, double *volumes)
{
	join_triangles(caster, parents);
	for (size_t t = 0; t < caster->triangle_count; t++) {
		const uint32_t *corner = &caster->indices[3 * t];
		uint32_t root = root_of(parents, corner[0]);
		volumes[root] += volume_under(caster, corner, root);
	}
	for (size_t t = 0; t < caster->triangle_count; t++)
		if (!(volumes[root_of(parents, caster->indices[3 * t])] > 0.0))
			return false;
	return true;
}

bool caster_is_solid(const struct caster *caster)
{
	const struct edge_counts *edges = &caster->found.edges;
	if (edges->open > 0 || edges->non_manifold > 0 || edges->inverted > 0 ||
		caster->found.turned > 0 || caster->found.repeated > 0)
		return false;
	uint32_t *parents = array_alloc(caster->vertex_count, sizeof(*parents));
	double *volumes = array_zalloc(caster->vertex_count, sizeof(*volumes));
	bool solid =
		parents != NULL && volumes != NULL && parts_are_outward(caster, parents, volumes);
	free(parents);
	free(volumes);
	return solid;
}
