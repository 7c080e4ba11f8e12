/* SPDX-License-Identifier: MIT */
#ifndef TESTS_GEOM_FIN_PROBE_H
#define TESTS_GEOM_FIN_PROBE_H

#include "geom/fins.h"

/* Fins of small silhouettes, and what they look like. Whatever goes wrong fails the test. */

#define CLOSE 1e-6f /* NDC; results are a few float operations away from coordinates near 1 */

extern const float identity[16];
/** A perspective along -z: w = -z, the near plane at z = -1, the far plane at z = -3. */
extern const float perspective[16];

/** Fins of constant width .1. */
struct fin_params params_of(const float object_to_clip[16]);

/** Vertices are all that a caster needs here; they are not copied. */
struct caster caster_of(const float (*positions)[3], size_t vertex_count);

struct fins {
	struct fin_vertex *vertices; /* the caller's to free() */
	size_t count, left_out_count;
};

struct fins expand(const struct fin *built, size_t count, const struct fin_params *params);

/** Into exactly as much memory as is needed, so that a sanitizer sees any write beyond. */
struct fins build(const struct caster *caster, const struct silhouette_edge *edges,
	size_t edge_count, const struct fin_params *params);
struct fins build_positions(const float (*positions)[3], size_t vertex_count,
	const struct silhouette_edge *edges, size_t edge_count, const struct fin_params *params);

void assert_vertex(
	const struct fin_vertex *v, const float position[3], const float offset[2], float width);

/** Twice the area of triangle a, b, p; positive when p is on the left of a -> b. */
float side(const float a[2], const float b[2], const float p[2]);
bool covers(const struct fin_vertex quad[4], const float p[2]);
/** Of the point, over all quads outside (side 1) or inside (-1) of the silhouette, as blending with
 *  MIN leaves it; 1 where there are none. */
float alpha_on_side(const struct fins *fins, float side, const float p[2]);
/** Outside. */
float alpha_at(const struct fins *fins, const float p[2]);
/** Distance of p from the segments of the silhouette, as a share of the width; 1 beyond it. */
float distance_at(const float (*positions)[3], const struct silhouette_edge *edges,
	size_t edge_count, float width, const float p[2]);

#endif
