/* SPDX-License-Identifier: MIT */
#ifndef GEOM_FINS_H
#define GEOM_FINS_H

#include "geom/fin.h"
#include "geom/silhouette.h"

struct fin_params {
	float object_to_clip[16]; /* column-major, the light's clip space: |x|, |y|, |z| <= w */
	struct fin_law law;
	float finest;    /* NDC: fins and gaps nowhere wider are left out; 0: none is */
	bool both_sides; /* fins inside the silhouette as well, of negative width */
	bool mirrored;   /* the transform flips orientation as seen with x right, y up */
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

/** No silhouette of edge_count edges needs more. */
size_t fins_max(size_t edge_count);

/**
 * Smoothies without their depth: a fin along the outside of each silhouette edge, and at convex
 * corners further ones that close the gap between two of them (Chan & Durand 2003, section 3).
 * With both_sides the same along the inside, where the gaps are at concave corners.
 *
 * edges: [edge_count], from silhouette_find(). scratch: reserved for at least edge_count edges.
 * Returns the number of fins needed, at most fins_max(edge_count), and writes the first that fit
 * into out: [capacity]. What fin_expand() makes of them is finite, whatever the input.
 */
size_t fins_build(const struct caster *caster, const struct silhouette_edge *edges,
	size_t edge_count, const struct fin_params *params, struct fin_scratch *scratch,
	struct fin *out, size_t capacity);

#endif
