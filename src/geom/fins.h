/* SPDX-License-Identifier: MIT */
#ifndef GEOM_FINS_H
#define GEOM_FINS_H

#include "geom/silhouette.h"

/** Width of a fin in NDC at a vertex of the silhouette. */
enum fin_width {
	FIN_WIDTH_CONSTANT,    /* scale */
	FIN_WIDTH_PERSPECTIVE, /* scale / w_clip */
	FIN_WIDTH_PARALLEL,    /* scale * (1 - z), z in window space, [0, 1] */
};

struct fin_params {
	float object_to_clip[16]; /* column-major, the light's clip space: |x|, |y|, |z| <= w */
	enum fin_width width;
	float scale;     /* >= 0 */
	float pole;      /* K of struct light_frame: fins are drawn only as far out as
			    1 - b/r of a receiver at the far plane, since beyond it
			    alpha' is 1; 0: drawn in full */
	float finest;    /* NDC: fins and gaps nowhere wider are left out; 0: none is */
	float apron;     /* NDC: fins are drawn this much wider than they are */
	bool both_sides; /* fins inside the silhouette as well, of negative width */
	bool mirrored;   /* the transform flips orientation as seen with x right, y up */
};

/** alpha of a fragment = length(offset) / |width|, both interpolated. */
struct fin_vertex {
	float position[3]; /* NDC, w = 1; x and y may lie beyond the screen, z is in [-1, 1] */
	float offset[2];   /* from the silhouette, NDC */
	float width;       /* NDC; below 0: inside. Not 0 at one vertex of a quad at least, but for
			      the apron */
};

/** Working memory of fins_build(), kept between calls. */
struct fin_scratch {
	struct fin_edge *edges; /* silhouette edges as seen from the light */
	size_t edge_capacity;
	uint32_t *first; /* [vertex_capacity]: an end of an edge at the vertex, or none; all
			    none between calls */
	size_t vertex_capacity;
	size_t left_out_count; /* fins of edges that the last call left out: too fine */
};

void fin_scratch_init(struct fin_scratch *scratch);
void fin_scratch_finish(struct fin_scratch *scratch);
size_t fin_scratch_bytes(const struct fin_scratch *scratch);

/** Makes room for edge_count silhouette edges of the caster, < 2^31. False: out of memory, and
 *  nothing has changed. */
bool fin_scratch_reserve(
	struct fin_scratch *scratch, const struct caster *caster, size_t edge_count);

/** No silhouette of edge_count edges needs more vertices. */
size_t fins_max_vertices(size_t edge_count, bool both_sides);

/**
 * Smoothies without their depth: a quad along the outside of each silhouette edge, and at convex
 * corners further quads that close the gap between two of them (Chan & Durand 2003, section 3).
 * With both_sides the same along the inside, where the gaps are at concave corners.
 *
 * edges: [edge_count], from silhouette_find(). scratch: reserved for at least edge_count edges.
 * out: [capacity], a multiple of 4; quads of four vertices in order around, of either orientation.
 * Returns the number of vertices needed, at most fins_max_vertices(edge_count), and writes the
 * quads that fit. Everything written is finite, whatever the input.
 */
size_t fins_build(const struct caster *caster, const struct silhouette_edge *edges,
	size_t edge_count, const struct fin_params *params, struct fin_scratch *scratch,
	struct fin_vertex *out, size_t capacity);

#endif
