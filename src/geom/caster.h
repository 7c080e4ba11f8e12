/* SPDX-License-Identifier: MIT */
#ifndef GEOM_CASTER_H
#define GEOM_CASTER_H

#include "geom/cones.h"
#include "geom/edges.h"
#include "geom/face.h"
#include "geom/hollows.h"
#include "geom/orientation.h"

/** A mesh as its silhouettes are searched: welded by position alone, wound consistently, in a
 *  triangle order of its own: closed parts first, and blocks of neighbours that look alike. */
struct caster {
	uint64_t version; /* of triangles and positions: no other caster has it, nor had */
	size_t vertex_count;
	float (*positions)[3]; /* [vertex_count], without negative zeros; distinct at first */
	uint32_t *sources;     /* [vertex_count]: one of the vertices that were welded into it */
	size_t triangle_count;
	uint32_t *indices; /* [3 * triangle_count] */
	struct orientation found;
	struct edge_table edges;
	struct face_planes planes;
	struct face_cones cones;
	struct hollows hollows;
};

/**
 * positions: [vertex_count][3], finite, equal ones equal in every bit; vertex_count < 2^32 - 1.
 * indices: [3 * triangle_count], each < vertex_count; triangle_count < 2^31. Both are copied.
 * False: out of memory.
 */
bool caster_init(struct caster *caster, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t triangle_count);
void caster_finish(struct caster *caster);

/** Before the first caster_move(). False: out of memory; nothing has changed. */
bool caster_let_move(struct caster *caster);

/** Moves vertices: positions as for caster_init(), of as many vertices. What was welded stays so,
 *  and windings, parts and edges are those of the first positions. The cones are dropped: they take
 *  longer to make than triangles take to test. */
void caster_move(struct caster *caster, const float (*positions)[3]);

#endif
