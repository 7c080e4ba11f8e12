/* SPDX-License-Identifier: MIT */
#ifndef GEOM_FACE_H
#define GEOM_FACE_H

#include "geom/edges.h"

/** (p1 - p0) x (p2 - p0) in double: twice the area long, towards the side that faces. */
void face_normal(const float p0[3], const float p1[3], const float p2[3], double normal[3]);

/** Six times the signed volume between the triangle and a point: positive where the triangle shows
 *  that point its back. */
double face_volume(const float p0[3], const float p1[3], const float p2[3], const float origin[3]);

/**
 * The triangles' planes, 8 bytes each, for a first and nearly always final answer to which side a
 * light is on: with unit normal n and offset d = n . (p0 - center) / radius, rounded to
 * 1 / FACE_PLANE_ONE.
 * All zero for a triangle without area.
 */
struct face_planes {
	size_t count;
	int16_t *values;          /* of each block of EDGE_BLOCK triangles all n.x, n.y, n.z, d */
	double center[3], radius; /* a sphere around all vertices */
	size_t degenerate;        /* triangles whose normal is exactly zero */
};

#define FACE_PLANE_ONE 32767
#define FACE_VALUES 4

/** How many triangles block b has. */
static inline size_t face_block_size(const struct face_planes *planes, size_t b)
{
	size_t left = planes->count - b * EDGE_BLOCK;
	return left < EDGE_BLOCK ? left : EDGE_BLOCK;
}

/** Of block b, [FACE_VALUES][face_block_size()]. */
static inline int16_t *face_block_values(const struct face_planes *planes, size_t b)
{
	return &planes->values[b * EDGE_BLOCK * FACE_VALUES];
}

/** positions: [vertex_count][3], finite; indices: [3 * triangle_count]. False: out of memory. */
bool face_planes_init(struct face_planes *planes, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t triangle_count);
/** The same triangles with their vertices elsewhere. */
void face_planes_update(struct face_planes *planes, const float (*positions)[3],
	size_t vertex_count, const uint32_t *indices);
void face_planes_finish(struct face_planes *planes);

size_t face_planes_bytes(const struct face_planes *planes);

#endif
