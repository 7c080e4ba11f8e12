/* SPDX-License-Identifier: MIT */
#include "parts.h"
#include <cglm/cglm.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static uint32_t add_mesh(struct sm_scene *scene, const struct sm_mesh_desc *desc)
{
	uint32_t mesh;
	struct sm_error error;
	if (!sm_scene_add_mesh(scene, desc, &mesh, &error))
		fail_msg("%s", error.text);
	return mesh;
}

uint32_t parts_add_mesh(struct sm_scene *scene, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t index_count)
{
	struct sm_mesh_desc desc = {
		.positions = positions[0],
		.vertex_count = vertex_count,
		.indices = indices,
		.index_count = index_count,
	};
	return add_mesh(scene, &desc);
}

uint32_t parts_add_square(struct sm_scene *scene)
{
	static const float positions[][3] = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
	static const float uvs[][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
	static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
	struct sm_mesh_desc desc = {
		.positions = positions[0],
		.uvs = uvs[0],
		.vertex_count = 4,
		.indices = indices,
		.index_count = 6,
	};
	return add_mesh(scene, &desc);
}

uint32_t parts_add_cube(struct sm_scene *scene)
{
	/* Vertex i has +1 in x, y, z where bits 0, 1, 2 of i are set. */
	static const uint32_t indices[] = {
		0, 2, 3, 0, 3, 1, /* -z */
		4, 5, 7, 4, 7, 6, /* +z */
		0, 4, 6, 0, 6, 2, /* -x */
		1, 3, 7, 1, 7, 5, /* +x */
		0, 1, 5, 0, 5, 4, /* -y */
		2, 6, 7, 2, 7, 3, /* +y */
	};
	float positions[8][3];
	for (int i = 0; i < 8; i++)
		for (int axis = 0; axis < 3; axis++)
			positions[i][axis] = i >> axis & 1 ? 1.0f : -1.0f;
	return parts_add_mesh(scene, positions, 8, indices, 36);
}

#define STEPS_MAX 64

uint32_t parts_add_sphere(struct sm_scene *scene, uint32_t steps)
{
	static float positions[(STEPS_MAX + 1) * (2 * STEPS_MAX + 1)][3];
	static uint32_t indices[STEPS_MAX * 2 * STEPS_MAX * 6];
	uint32_t row = 2 * steps + 1;
	size_t index_count = 0;
	for (uint32_t i = 0; i <= steps; i++) {
		for (uint32_t j = 0; j < row; j++) {
			float polar = GLM_PIf * (float)i / (float)steps;
			float around = GLM_PIf * (float)(j % (row - 1)) / (float)steps;
			float *p = positions[i * row + j];
			p[0] = sinf(polar) * sinf(around);
			p[1] = cosf(polar);
			p[2] = sinf(polar) * cosf(around);
		}
	}
	for (uint32_t i = 0; i < steps; i++) {
		for (uint32_t j = 0; j < row - 1; j++) {
			uint32_t a = i * row + j, b = a + row;
			uint32_t quad[] = {a, b, b + 1, a, b + 1, a + 1};
			memcpy(indices + index_count, quad, sizeof(quad));
			index_count += 6;
		}
	}
	struct sm_mesh_desc desc = {
		.positions = positions[0],
		.normals = positions[0],
		.vertex_count = (size_t)(steps + 1) * row,
		.indices = indices,
		.index_count = index_count,
	};
	return add_mesh(scene, &desc);
}

void pose_matrix(const struct pose *pose, float matrix[16])
{
	mat4 m = GLM_MAT4_IDENTITY_INIT;
	glm_translate(m, (float *)pose->position);
	glm_rotate_y(m, glm_rad(pose->turn), m);
	glm_scale(m, (float *)pose->scale);
	memcpy(matrix, m, sizeof(m));
}

uint32_t parts_add_object(
	struct sm_scene *scene, uint32_t mesh, unsigned int roles, const struct pose *pose)
{
	struct sm_object_desc desc = {
		.mesh = mesh,
		.base_color = {1.0f, 1.0f, 1.0f, 1.0f},
		.image = SM_NONE,
		.casts = roles & PART_CASTS,
		.receives = roles & PART_RECEIVES,
	};
	pose_matrix(pose, desc.transform);
	uint32_t object;
	struct sm_error error;
	if (!sm_scene_add_object(scene, &desc, &object, &error))
		fail_msg("%s", error.text);
	return object;
}

uint32_t parts_add_light(struct sm_scene *scene, const struct sm_light_desc *desc)
{
	struct sm_light_desc filled = *desc;
	if (filled.intensity == 0.0f) {
		filled.intensity = 1.0f;
		glm_vec3_one(filled.color);
	}
	uint32_t light;
	struct sm_error error;
	if (!sm_scene_add_light(scene, &filled, &light, &error))
		fail_msg("%s", error.text);
	return light;
}

void parts_add_small_blocks(struct sm_scene *scene, unsigned int roles)
{
	uint32_t cube = parts_add_cube(scene);
	for (int i = 0; i < 400; i++)
		parts_add_object(scene, cube, roles,
			&(struct pose){{0.02f, 0.02f, 0.02f}, 7.0f * (float)i,
				{0.06f * (float)(i % 20) - 1, 0.6f, 0.06f * (float)(i / 20) - 1}});
	parts_add_object(scene, parts_add_square(scene), PART_RECEIVES,
		&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
}

void parts_add_shadowed_square(struct sm_scene *scene)
{
	uint32_t square = parts_add_square(scene);
	parts_add_object(scene, square, PART_CASTS,
		&(struct pose){.scale = {0.5f, 1, 0.5f}, .position = {0, 2, 0}});
	parts_add_object(scene, square, PART_RECEIVES, &(struct pose){.scale = {2, 1, 2}});
	parts_add_light(
		scene, &(struct sm_light_desc){.position = {0, 4, 0}, .radius = 0.6f, .angle = 80});
}
