/* SPDX-License-Identifier: MIT */
#ifndef GEOM_CONES_H
#define GEOM_CONES_H

#include "geom/face.h"

/** How many cones are tested at once. */
#define CONE_BATCH 16

/** Which side a block of triangles shows a light. */
enum cone_side {
	CONE_MIXED, /* it may show both */
	CONE_FACES, /* each triangle faces it */
	CONE_AVERTS /* none does */
};

/**
 * Of each block of EDGE_BLOCK triangles, two cones around one axis (Sander et al. 2000, "Silhouette
 * Clipping", section 4): all triangles face a light in the one, and none a light in the other. Both
 * are as wide as the blocks' normals let them, and their tips are where the outermost of the
 * triangles' planes meet the axis. Lengths are shares of the planes' radius, places relative to
 * their centre. 36 bytes a block.
 */
struct face_cones {
	size_t count; /* whole batches; 0: there are none, and all blocks count as mixed */
	float *axis_x, *axis_y, *axis_z; /* axis_x owns the memory of all nine */
	float *x, *y, *z;                /* a point on the axis */
	float *faces_from, *averts_from; /* from there to the tips, along the axis and against it */
	float *spread; /* squared tangent of the normals' angle to the axis; infinite: never */
};

/** Makes the cones of all blocks, unless too few of them would be decided by one from all around:
 *  then count is 0. Arguments as face_planes_init() had them. False: out of memory. */
bool face_cones_init(struct face_cones *cones, const struct face_planes *planes,
	const float (*positions)[3], const uint32_t *indices, size_t triangle_count);
void face_cones_finish(struct face_cones *cones);

size_t face_cones_bytes(const struct face_cones *cones);

/** A light as cones see it: relative to the planes' centre and divided by
 *  |light.xyz - w centre| + |w| radius, so that all are within [-1, 1]. */
struct cone_light {
	float x, y, z, w;
};

/** False when there is nothing to divide by, or w is not 0, 1 or -1: cones say nothing then. */
bool cone_light_of(const struct face_planes *planes, const float light[4], struct cone_light *seen);

/** Decides for the batch that starts with block `first`; sides: enum cone_side. With w = -1 the
 *  light is a point's opposite, which those triangles face that show the point their backs. */
void face_cones_test(const struct face_cones *cones, size_t first, const struct cone_light *light,
	uint8_t sides[CONE_BATCH]);

/** Decides for block b, unless the light is within rounding of a cone's surface. slack: set to how
 * deep it is in the cone, where one decides: it may go that far, its w as it is, as a share of what
 * it was divided by, and stays in. */
enum cone_side face_cones_side(
	const struct face_cones *cones, size_t b, const struct cone_light *light, float *slack);

#endif
