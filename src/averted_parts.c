/* SPDX-License-Identifier: MIT */
#include "averted_parts.h"
#include "base/array.h"
#include "geom/averted.h"
#include <stdlib.h>
#include <string.h>

/* As a cosine, by which shaders may round: far more than floats do. */
#define SLACK 1e-4f

/* Of a transform, beyond which it is as good as singular. */
#define DISTORTION_MAX 1e3f

void averted_parts_finish(struct averted_parts *parts, struct gl *gl)
{
	gl_delete_buffer(gl, &parts->buffer);
	free(parts->averted);
	free(parts->indices);
	*parts = (struct averted_parts){0};
}

/* A bound on the greatest of a transform's singular values over the least: the cube of the root of
 * all squares over the determinant. */
static float distortion(mat4 transform)
{
	float squares = 0.0f;
	mat3 m;
	glm_mat4_pick3(transform, m);
	for (int column = 0; column < 3; column++)
		squares += glm_vec3_norm2(m[column]);
	return squares * sqrtf(squares) / fabsf(glm_mat3_det(m));
}

bool averted_find_vertices(const struct mesh *mesh, const struct gpu_mesh *gpu_mesh, mat4 transform,
	const struct light_frame *frame, uint8_t *averted)
{
	float distorted = distortion(transform);
	mat4 to_object;
	vec4 light;
	/* False for NaN too. */
	if (!(distorted < DISTORTION_MAX))
		return false;
	glm_mat4_inv(transform, to_object);
	glm_mat4_mulv(to_object, (float *)frame->origin, light);
	averted_vertices((const float(*)[3])mesh->positions, (const float(*)[3])mesh->normals,
		gpu_mesh->rises, mesh->vertex_count, light, SLACK * distorted, averted);
	return true;
}

static size_t cluster_indices(const struct mesh *mesh, size_t cluster)
{
	size_t all = 3 * CLUSTER_TRIANGLES, left = mesh->index_count - cluster * all;
	return left < all ? left : all;
}

/* Lists of what takes BEHIND and what takes all, in the order of the clusters, and then of what is
 * averted, which is found beside them. */
static void split(struct averted_parts *parts, const struct mesh *mesh,
	const struct gpu_mesh *gpu_mesh, const uint8_t *needs)
{
	uint32_t *rest = parts->indices, *away = rest + mesh->index_count;
	size_t turned = 0;
	memset(parts->count, 0, sizeof(parts->count));
	for (enum need need = NEED_BEHIND; need < NEED_COUNT; need++) {
		parts->first[need] = (size_t)(rest - parts->indices);
		for (size_t i = 0; i < gpu_mesh->cluster_count; i++) {
			size_t count = cluster_indices(mesh, i);
			if (needs[i] != need)
				continue;
			size_t found = averted_split(mesh->indices + 3 * CLUSTER_TRIANGLES * i,
				count, parts->averted, away + turned, rest);
			turned += found;
			rest += count - found;
			parts->count[need] += count - found;
		}
	}
	memmove(rest, away, turned * sizeof(*rest));
	parts->first[NEED_AMBIENT] = (size_t)(rest - parts->indices);
	parts->count[NEED_AMBIENT] = turned;
}

bool averted_parts_find(struct averted_parts *parts, struct gpu *gpu, const struct mesh *mesh,
	const struct gpu_mesh *gpu_mesh, mat4 transform, const struct light_frame *frame,
	const uint8_t *needs, struct sm_error *error)
{
	parts->split = false;
	if (!array_reserve((void **)&parts->averted, &parts->averted_capacity, mesh->vertex_count,
		    sizeof(*parts->averted)) ||
		!array_reserve((void **)&parts->indices, &parts->index_capacity,
			2 * mesh->index_count, sizeof(*parts->indices)))
		return error_no_memory(error);
	if (!averted_find_vertices(mesh, gpu_mesh, transform, frame, parts->averted))
		return true;
	split(parts, mesh, gpu_mesh, needs);
	parts->split = parts->count[NEED_AMBIENT] > 0;
	if (!parts->split)
		return true;
	size_t bytes =
		(parts->first[NEED_AMBIENT] + parts->count[NEED_AMBIENT]) * sizeof(*parts->indices);
	if (parts->buffer == 0)
		parts->buffer = gl_create_buffer(&gpu->gl, STORAGE_SURFACES);
	gpu->gl.BindVertexArray(gpu_mesh->surface);
	gl_fill_buffer(&gpu->gl, GL_ELEMENT_ARRAY_BUFFER, parts->buffer, bytes, parts->indices,
		GL_STREAM_DRAW);
	gpu->gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu_mesh->surface_indices);
	gpu->stats.uploaded_bytes += bytes;
	return true;
}

void averted_parts_draw(const struct averted_parts *parts, struct gpu *gpu,
	const struct gpu_mesh *mesh, enum need need)
{
	if (parts->count[need] > 0)
		gpu_draw_indices(gpu, mesh, parts->buffer, parts->first[need], parts->count[need]);
}

size_t averted_parts_bytes(const struct averted_parts *parts)
{
	return parts->averted_capacity * sizeof(*parts->averted) +
	       parts->index_capacity * sizeof(*parts->indices);
}
