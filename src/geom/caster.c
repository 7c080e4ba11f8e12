/* SPDX-License-Identifier: MIT */
#include "geom/caster.h"
#include "base/array.h"
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

static bool weld(struct caster *caster, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices)
{
	size_t index_count = 3 * caster->triangle_count;
	size_t size = sizeof(*caster->positions);
	uint32_t *remap = array_alloc(vertex_count, sizeof(*remap));
	caster->positions = array_alloc(vertex_count, size);
	caster->sources = array_alloc(vertex_count, sizeof(*caster->sources));
	caster->indices = array_alloc(index_count, sizeof(*caster->indices));
	bool ok = remap != NULL && caster->positions != NULL && caster->sources != NULL &&
		  caster->indices != NULL;
	if (ok) {
		caster->vertex_count = meshopt_generateVertexRemap(
			remap, indices, index_count, positions, vertex_count, size);
		meshopt_remapVertexBuffer(caster->positions, positions, vertex_count, size, remap);
		meshopt_remapIndexBuffer(caster->indices, indices, index_count, remap);
		for (size_t v = 0; v < vertex_count; v++)
			if (remap[v] != UINT32_MAX)
				caster->sources[remap[v]] = (uint32_t)v;
	}
	free(remap);
	return ok;
}

static void order_range(struct caster *caster, size_t first, size_t count)
{
	uint32_t *indices = &caster->indices[3 * first];
	meshopt_optimizeVertexCache(indices, indices, 3 * count, caster->vertex_count);
}

/* Neighbours near each other keep the edge table small and the search in the cache. */
static bool order(struct caster *caster)
{
	size_t closed = caster->found.closed_count, count = caster->vertex_count;
	uint32_t *remap = array_alloc(count, sizeof(*remap));
	if (remap == NULL)
		return false;
	order_range(caster, 0, closed);
	order_range(caster, closed, caster->triangle_count - closed);
	size_t index_count = 3 * caster->triangle_count;
	meshopt_optimizeVertexFetchRemap(remap, caster->indices, index_count, count);
	meshopt_remapIndexBuffer(caster->indices, caster->indices, index_count, remap);
	meshopt_remapVertexBuffer(
		caster->positions, caster->positions, count, sizeof(*caster->positions), remap);
	meshopt_remapVertexBuffer(
		caster->sources, caster->sources, count, sizeof(*caster->sources), remap);
	free(remap);
	return true;
}

bool caster_init(struct caster *caster, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t triangle_count)
{
	*caster = (struct caster){.triangle_count = triangle_count};
	if (!weld(caster, positions, vertex_count, indices))
		goto error;
	if (!orientation_repair(&caster->found, (const float(*)[3])caster->positions,
		    caster->vertex_count, caster->indices, &caster->triangle_count))
		goto error;
	if (!order(caster))
		goto error;
	if (!edge_table_init(
		    &caster->edges, caster->indices, caster->triangle_count, caster->vertex_count))
		goto error;
	if (!face_planes_init(&caster->planes, caster->positions, caster->vertex_count,
		    caster->indices, caster->triangle_count))
		goto error;
	return true;
error:
	caster_finish(caster);
	return false;
}

void caster_move(struct caster *caster, const float (*positions)[3])
{
	for (size_t v = 0; v < caster->vertex_count; v++)
		memcpy(caster->positions[v], positions[caster->sources[v]],
			sizeof(caster->positions[v]));
	face_planes_update(&caster->planes, (const float(*)[3])caster->positions,
		caster->vertex_count, caster->indices);
}

void caster_finish(struct caster *caster)
{
	free(caster->positions);
	free(caster->sources);
	free(caster->indices);
	edge_table_finish(&caster->edges);
	face_planes_finish(&caster->planes);
	*caster = (struct caster){0};
}

size_t caster_bytes(const struct caster *caster)
{
	return caster->vertex_count * (sizeof(*caster->positions) + sizeof(*caster->sources)) +
	       3 * caster->triangle_count * sizeof(*caster->indices) +
	       edge_table_bytes(&caster->edges) + face_planes_bytes(&caster->planes);
}
