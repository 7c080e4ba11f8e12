/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SILHOUETTE_H
#define GEOM_SILHOUETTE_H

#include "geom/caster.h"

/** Words in a set of one bit a triangle: t is bit t % 64 of word t / 64. */
size_t facing_words(const struct caster *caster);

/**
 * Which triangles face the light: those where
 *	((p1 - p0) x (p2 - p0)) . (light.xyz - light.w * p0) > 0
 * evaluated in double from the caster's float positions. None when the light is not finite, and
 * never one without area.
 *
 * light: object space, homogeneous: w = 1 a point, w = 0 the direction towards the light.
 * facing: [facing_words()], overwritten; bits past the last triangle are zero.
 */
void facing_find(const struct caster *caster, const float light[4], uint64_t *facing);

/** The same bits, with each triangle tested by itself: what facing_find() is measured against. */
void facing_find_all(const struct caster *caster, const float light[4], uint64_t *facing);

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
