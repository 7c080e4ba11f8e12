/* SPDX-License-Identifier: MIT */
#include "geom/clusters.h"
#include <math.h>

size_t clusters_count(size_t triangle_count)
{
	return (triangle_count + CLUSTER_TRIANGLES - 1) / CLUSTER_TRIANGLES;
}

static struct cluster box_of(
	const float (*positions)[3], const uint32_t *indices, size_t index_count)
{
	struct cluster box = {
		.min = {INFINITY, INFINITY, INFINITY},
		.max = {-INFINITY, -INFINITY, -INFINITY},
	};
	for (size_t i = 0; i < index_count; i++) {
		const float *p = positions[indices[i]];
		for (int axis = 0; axis < 3; axis++) {
			box.min[axis] = fminf(box.min[axis], p[axis]);
			box.max[axis] = fmaxf(box.max[axis], p[axis]);
		}
	}
	return box;
}

void clusters_find(const float (*positions)[3], const uint32_t *indices, size_t triangle_count,
	struct cluster *clusters)
{
	for (size_t first = 0; first < triangle_count; first += CLUSTER_TRIANGLES) {
		size_t left = triangle_count - first;
		size_t count = left < CLUSTER_TRIANGLES ? left : CLUSTER_TRIANGLES;
		*clusters++ = box_of(positions, indices + 3 * first, 3 * count);
	}
}
