/* SPDX-License-Identifier: MIT */
#ifndef MODEL_TRANSFORM_H
#define MODEL_TRANSFORM_H

#include "model/raster.h"
#include "scene/scene.h"

/** matrix * (position, 1), in double. */
void transform_point(mat4 matrix, const float position[3], double transformed[4]);

/** transform_point() of [count] positions; the caller's to free(), NULL without memory. */
double (*transform_all(mat4 matrix, const float (*positions)[3], size_t count))[4];

/** The corners of a triangle. */
void pick_corners(const double (*corners)[4], const uint32_t indices[3], double triangle[3][4]);

/** Which sides of an object's triangles are drawn, as gpu_set_faces() has it: those that face,
 * where the others are never seen, or are not to be. to_clip: from the object's space. */
enum raster_cull kept_faces(
	const struct mesh *mesh, const struct object *object, mat4 to_clip, bool single_sided);

#endif
