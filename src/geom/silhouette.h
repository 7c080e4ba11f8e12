/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SILHOUETTE_H
#define GEOM_SILHOUETTE_H

#include "geom/facing.h"

/** Welded vertices of the caster. Seen from the light, the triangle that faces it is on the left of
 *  a -> b. */
struct silhouette_edge {
	uint32_t a, b;
};

/**
 * The edges between triangles that face the light and triangles that do not or are not there
 * (Chan & Durand 2003, section 3). They are closed loops: at each vertex as many end as start.
 * Returns the number found, at most edge_table_records(), and writes no more than capacity.
 */
size_t silhouette_find(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity);

/** The same edges in the same order, with each record looked at: what silhouette_find() is measured
 *  against. */
size_t silhouette_find_all(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity);

#endif
