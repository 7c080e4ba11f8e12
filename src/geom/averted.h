/* SPDX-License-Identifier: MIT */
#ifndef GEOM_AVERTED_H
#define GEOM_AVERTED_H

#include <stddef.h>
#include <stdint.h>

/**
 * Triangles that no light arrives at, whatever is before them: with normals n and positions p of
 * the corners, weighted by a point's barycentric coordinates b, the cosine to a light at l has the
 * sign of the sum of b_i b_j n_i (l - p_j), which is below 0 where n_i (l - p_i) + n_i (p_i - p_j)
 * is for all i and j.
 */

/** The most of n_i (p_i - p_j) in triangles that a vertex i is of. indices: [3 * triangle_count]
 *  into positions and normals. rises: [vertex_count], overwritten; 0 where there is none. */
void averted_rises(const float (*positions)[3], const float (*normals)[3], size_t vertex_count,
	const uint32_t *indices, size_t triangle_count, float *rises);

/** The light (w = 1: a place, 0: the direction to it) in the vertices' space. averted: [count], set
 *  to 1 for vertices whose normal leads away from it, with all that is beside them, by more than
 *  `slack` as a cosine; else 0. */
void averted_vertices(const float (*positions)[3], const float (*normals)[3], const float *rises,
	size_t count, const float light[4], float slack, uint8_t *averted);

/** Writes the triangles, of the indices given, of which all vertices are averted into `away`, and
 *  the others into `rest`, each [index_count]. Returns how many indices are in `away`. */
size_t averted_split(const uint32_t *indices, size_t index_count, const uint8_t *averted,
	uint32_t *away, uint32_t *rest);

#endif
