/* SPDX-License-Identifier: MIT */
#include "geom/caster.h"
#include "base/array.h"
#include "geom/triangle_order.h"
#include <assert.h>
#include <meshoptimizer.h>
#include <stdatomic.h>
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

/* Blocks of neighbours that look one way keep the edge table small and are searched as a whole. */
static bool order_triangles(struct caster *caster)
{
	const float(*positions)[3] = (const float(*)[3])caster->positions;
	size_t closed = caster->found.closed_count;
	return triangle_order_blocks(positions, caster->vertex_count, caster->indices, 0, closed) &&
	       triangle_order_blocks(positions, caster->vertex_count, caster->indices, closed,
		       caster->triangle_count);
}

/* As the triangles come to them. */
static bool order_vertices(struct caster *caster)
{
	size_t count = caster->vertex_count, index_count = 3 * caster->triangle_count;
	uint32_t *remap = array_alloc(count, sizeof(*remap));
	if (remap == NULL)
		return false;
	meshopt_optimizeVertexFetchRemap(remap, caster->indices, index_count, count);
	meshopt_remapIndexBuffer(caster->indices, caster->indices, index_count, remap);
	meshopt_remapVertexBuffer(
		caster->positions, caster->positions, count, sizeof(*caster->positions), remap);
	meshopt_remapVertexBuffer(
		caster->sources, caster->sources, count, sizeof(*caster->sources), remap);
	free(remap);
	return true;
}

/* Welding and dropping repeats left room. */
static void trim(struct caster *caster)
{
	caster->positions =
		array_trim(caster->positions, caster->vertex_count, sizeof(*caster->positions));
	caster->sources =
		array_trim(caster->sources, caster->vertex_count, sizeof(*caster->sources));
	caster->indices =
		array_trim(caster->indices, 3 * caster->triangle_count, sizeof(*caster->indices));
}

static uint64_t next_version(void)
{
	static _Atomic uint64_t last;
	return atomic_fetch_add(&last, 1) + 1;
}

bool caster_init(struct caster *caster, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t triangle_count)
{
	*caster = (struct caster){.version = next_version(), .triangle_count = triangle_count};
	if (!weld(caster, positions, vertex_count, indices))
		goto error;
	if (!orientation_repair(&caster->found, (const float(*)[3])caster->positions,
		    caster->vertex_count, caster->indices, &caster->triangle_count))
		goto error;
	if (!order_triangles(caster) || !order_vertices(caster))
		goto error;
	trim(caster);
	if (!edge_table_init(
		    &caster->edges, caster->indices, caster->triangle_count, caster->vertex_count))
		goto error;
	if (!face_planes_init(&caster->planes, caster->positions, caster->vertex_count,
		    caster->indices, caster->triangle_count))
		goto error;
	if (!face_cones_init(&caster->cones, &caster->planes, (const float(*)[3])caster->positions,
		    caster->indices, caster->triangle_count))
		goto error;
	if (!hollows_init(&caster->hollows, (const float(*)[3])caster->positions, caster->indices,
		    &caster->edges, caster->found.closed_count))
		goto error;
	return true;
error:
	caster_finish(caster);
	return false;
}

bool caster_let_move(struct caster *caster)
{
	struct hollows moving;
	if (caster->hollows.moving)
		return true;
	if (!hollows_init(
		    &moving, NULL, caster->indices, &caster->edges, caster->found.closed_count)) {
		hollows_finish(&moving);
		return false;
	}
	hollows_finish(&caster->hollows);
	caster->hollows = moving;
	return true;
}

void caster_move(struct caster *caster, const float (*positions)[3])
{
	assert(caster->hollows.moving);
	for (size_t v = 0; v < caster->vertex_count; v++)
		memcpy(caster->positions[v], positions[caster->sources[v]],
			sizeof(caster->positions[v]));
	face_planes_update(&caster->planes, (const float(*)[3])caster->positions,
		caster->vertex_count, caster->indices);
	face_cones_finish(&caster->cones);
	caster->version = next_version();
}

void caster_finish(struct caster *caster)
{
	free(caster->positions);
	free(caster->sources);
	free(caster->indices);
	edge_table_finish(&caster->edges);
	face_planes_finish(&caster->planes);
	face_cones_finish(&caster->cones);
	hollows_finish(&caster->hollows);
	*caster = (struct caster){0};
}
