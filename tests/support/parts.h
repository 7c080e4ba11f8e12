/* SPDX-License-Identifier: MIT */
#ifndef SUPPORT_PARTS_H
#define SUPPORT_PARTS_H

#include <smoothie.h>

/* What the tests' scenes are made of. Whatever the scene refuses fails the test. */

/** Meshes; the handle is returned. */
uint32_t parts_add_mesh(struct sm_scene *scene, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t index_count);
/** x, z in [-1, 1] at y = 0, facing +y; uv (0, 0) at (-1, 0, -1), u along x, v along z. */
uint32_t parts_add_square(struct sm_scene *scene);
/** [-1, 1]^3 */
uint32_t parts_add_cube(struct sm_scene *scene);
/** Of radius 1 with smooth normals, 2 * steps by steps facets, steps in [2, 64]. */
uint32_t parts_add_sphere(struct sm_scene *scene, uint32_t steps);

enum part_role { PART_CASTS = 1, PART_RECEIVES = 2, PART_BOTH = 3 };

/** Scaled, then turned about y, then moved. */
struct pose {
	float scale[3];
	float turn; /* degrees */
	float position[3];
};

/** Column-major. */
void pose_matrix(const struct pose *pose, float matrix[16]);

/** A white object. roles: part_role bits. */
uint32_t parts_add_object(
	struct sm_scene *scene, uint32_t mesh, unsigned int roles, const struct pose *pose);

/** Without an intensity: a white one of intensity 1. */
uint32_t parts_add_light(struct sm_scene *scene, const struct sm_light_desc *desc);

/** 400 blocks of these roles close to each other, above a square that receives. */
void parts_add_small_blocks(struct sm_scene *scene, unsigned int roles);

/** A square that receives, below a lesser one that casts, below a light. */
void parts_add_shadowed_square(struct sm_scene *scene);

#endif
