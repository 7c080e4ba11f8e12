/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_CLIP_H
#define SCENE_EDGE_CLIP_H

#include "geom/silhouette.h"
#include <cglm/cglm.h>

/** Where the near plane cuts a caster's edge, between two of its vertices, or a vertex: a == b. */
struct clip_vertex {
	uint32_t a, b;      /* a <= b */
	double position[4]; /* clip space */
};

/** Boundaries of sheets beyond the near plane. Zero is empty; memory is kept from one use to the
 *  next. */
struct edge_clip {
	struct clip_vertex *vertices;  /* [vertex_count], owned */
	struct silhouette_edge *edges; /* [edge_count], between these; owned */
	size_t vertex_count, edge_count;
	/* Working memory; owned */
	struct clip_vertex *ends; /* two an edge */
	size_t end_count, vertex_capacity, edge_capacity, end_capacity;
};

/**
 * Clips the boundary of a caster's sheets, all of which count on both sides, at the near plane
 * z = -w of clip space, and closes it along the cut: at each vertex as many edges end as start, as
 * before. edges: [edge_count], sheet on the left; facing, back, mirrored: as
 * sheets_find() had and left them. False: out of
 * memory.
 */
bool edge_clip_near(struct edge_clip *clip, const struct caster *caster, const mat4 to_clip,
	const uint64_t *facing, const uint64_t *back, bool mirrored,
	const struct silhouette_edge *edges, size_t edge_count);

void edge_clip_finish(struct edge_clip *clip);

/** Of memory. */
size_t edge_clip_bytes(const struct edge_clip *clip);

/** Of one of the caster's vertices. */
void clip_position(
	const struct caster *caster, const mat4 to_clip, uint32_t vertex, double position[4]);

#endif
