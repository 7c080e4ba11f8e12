/* SPDX-License-Identifier: MIT */
#ifndef LOAD_SOLID_H
#define LOAD_SOLID_H

#include "load/model.h"

/*
 * Generated surfaces. Each function adds one mesh and one object to a model with room for them
 * (model_reserve()) and returns the object for the caller to name, colour and move: it is white,
 * casts and receives, and its transform is the identity. NULL when the model is full.
 */

/** Box with flat faces: its centre, and right-handed half axes. */
struct sm_object_desc *solid_box(
	struct model *model, const float center[3], const float half_axes[3][3]);

struct solid_box_desc {
	float center[3], half_axes[3][3]; /**< as of solid_box() */
};

/** Many boxes as one mesh. */
struct sm_object_desc *solid_boxes(
	struct model *model, const struct solid_box_desc *boxes, size_t count);

/** A point of a profile, and the normal of the surface there; both turn about the y axis. */
struct solid_point {
	float radius, y;
	float normal_radius, normal_y;
};

/**
 * Surface of revolution about the y axis. Points 2k and 2k + 1 of the profile make a band, over
 * which normals run from one to the other; a point on the axis makes a fan. With y up and the
 * radius to the right, the surface faces the right of the way from the first point to the second.
 */
struct sm_object_desc *solid_lathe(
	struct model *model, const struct solid_point *profile, size_t point_count, uint32_t sides);

/** A closed curve, nowhere vertical, of period 2 pi. */
typedef void (*solid_curve)(float t, float point[3]);

/** Smooth tube about a curve that is moved to center. */
struct sm_object_desc *solid_tube(struct model *model, const float center[3], solid_curve curve,
	float radius, uint32_t segments, uint32_t sides);

/** Distance of a surface from its centre, in a direction of length 1. */
typedef float (*solid_radius)(const void *data, const float direction[3]);

/** Icosahedron whose faces are split in four `levels` times and pushed out to the radius; flat
 *  without levels, smooth with them. */
struct sm_object_desc *solid_icosphere(struct model *model, const float center[3], uint32_t levels,
	solid_radius radius, const void *data);

/** Octahedron whose faces are split in splits * splits and pushed out to the radius: 8 * splits *
 *  splits triangles, smooth. splits: 1 to 10000. */
struct sm_object_desc *solid_octasphere(struct model *model, const float center[3], uint32_t splits,
	solid_radius radius, const void *data);

#endif
