/* SPDX-License-Identifier: MIT */
#include "model/transform.h"
#include "base/array.h"
#include <string.h>

void transform_point(mat4 matrix, const float position[3], double transformed[4])
{
	for (int row = 0; row < 4; row++) {
		transformed[row] = matrix[3][row];
		for (int column = 0; column < 3; column++)
			transformed[row] += (double)matrix[column][row] * position[column];
	}
}

double (*transform_all(mat4 matrix, const float (*positions)[3], size_t count))[4]
{
	double(*transformed)[4] = array_alloc(count, sizeof(*transformed));
	for (size_t i = 0; transformed != NULL && i < count; i++)
		transform_point(matrix, positions[i], transformed[i]);
	return transformed;
}

void pick_corners(const double (*corners)[4], const uint32_t indices[3], double triangle[3][4])
{
	for (int i = 0; i < 3; i++)
		memcpy(triangle[i], corners[indices[i]], sizeof(triangle[i]));
}

enum raster_cull kept_faces(
	const struct mesh *mesh, const struct object *object, mat4 to_clip, bool single_sided)
{
	if (!single_sided && !mesh_hides_back(mesh, to_clip))
		return RASTER_ALL;
	return glm_mat4_det((vec4 *)object->transform) < 0.0f ? RASTER_BACK : RASTER_FRONT;
}
