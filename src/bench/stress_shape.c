/* SPDX-License-Identifier: MIT */
#include "bench/stress_shape.h"
#include "base/array.h"
#include "base/error.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool make(struct stress_mesh *mesh, const float (*positions)[3], size_t vertex_count,
	const uint32_t *indices, size_t index_count, struct sm_error *error)
{
	if (!stress_mesh_init(mesh, vertex_count, index_count, error))
		return false;
	memcpy(mesh->positions, positions, vertex_count * sizeof(*positions));
	memcpy(mesh->indices, indices, index_count * sizeof(*indices));
	return true;
}

bool stress_shape_triangle(struct stress_mesh *mesh, struct sm_error *error)
{
	static const float positions[][3] = {{0, 0, -1}, {-1, 0, 1}, {1, 0, 1}};
	static const uint32_t indices[] = {0, 1, 2};
	return make(mesh, positions, 3, indices, 3, error);
}

bool stress_shape_square(struct stress_mesh *mesh, struct sm_error *error)
{
	static const float positions[][3] = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
	static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
	return make(mesh, positions, 4, indices, 6, error);
}

bool stress_shape_slivers(struct stress_mesh *mesh, double aspect, struct sm_error *error)
{
	/* Corner 4 lies on the side from 1 to 2, and 5 on that from 2 to 3, a sliver's width from
	 * corner 2; sides are 2 long. */
	float inside = (float)(1 - 2 / aspect);
	const float positions[][3] = {
		{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {inside, 0, 1}, {1, 0, inside}};
	static const uint32_t indices[] = {0, 1, 4, 0, 4, 2, 0, 2, 5, 0, 5, 3};
	return make(mesh, positions, 6, indices, 12, error);
}

bool stress_shape_cube(struct stress_mesh *mesh, struct sm_error *error)
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
	return make(mesh, positions, 8, indices, 36, error);
}

static void place_on_sphere(float p[3], uint32_t i, uint32_t j, uint32_t steps)
{
	double polar = M_PI * i / steps, around = M_PI * j / steps;
	double ring = i == 0 || i == steps ? 0 : sin(polar);
	p[0] = (float)(ring * sin(around));
	p[1] = (float)cos(polar);
	p[2] = (float)(ring * cos(around));
}

bool stress_shape_sphere(struct stress_mesh *mesh, uint32_t steps, struct sm_error *error)
{
	uint32_t row = 2 * steps;
	if (!stress_mesh_init(mesh, (size_t)(steps + 1) * row, (size_t)steps * row * 6, error))
		return false;
	uint32_t *out = mesh->indices;
	for (uint32_t i = 0; i <= steps; i++)
		for (uint32_t j = 0; j < row; j++)
			place_on_sphere(mesh->positions[i * row + j], i, j, steps);
	for (uint32_t i = 0; i < steps; i++) {
		for (uint32_t j = 0; j < row; j++, out += 6) {
			uint32_t a = i * row + j, next = i * row + (j + 1) % row;
			const uint32_t quad[] = {a, a + row, next + row, a, next + row, next};
			memcpy(out, quad, sizeof(quad));
		}
	}
	return true;
}

bool stress_shape_extend(struct stress_mesh *mesh, const uint32_t *corners, size_t index_count,
	struct sm_error *error)
{
	size_t old = mesh->index_count;
	if (!array_reserve((void **)&mesh->indices, &mesh->index_count, old + index_count,
		    sizeof(*mesh->indices)))
		return error_no_memory(error);
	memcpy(mesh->indices + old, corners, index_count * sizeof(*corners));
	/* array_reserve() may have made more room than that. */
	mesh->index_count = old + index_count;
	return true;
}
