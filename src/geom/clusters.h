/* SPDX-License-Identifier: MIT */
#ifndef GEOM_CLUSTERS_H
#define GEOM_CLUSTERS_H

#include <stddef.h>
#include <stdint.h>

/** Triangles of a mesh that are kept or skipped together: this many that follow each other. In an
 *  order good for a vertex cache they are neighbours. */
#define CLUSTER_TRIANGLES 128

struct cluster {
	float min[3], max[3]; /* box around the triangles */
};

/** ceil(triangle_count / CLUSTER_TRIANGLES) */
size_t clusters_count(size_t triangle_count);

/** indices: [3 * triangle_count] into positions. clusters: [clusters_count()], overwritten. */
void clusters_find(const float (*positions)[3], const uint32_t *indices, size_t triangle_count,
	struct cluster *clusters);

#endif
