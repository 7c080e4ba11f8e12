/* SPDX-License-Identifier: MIT */
#include "gles/gpu.h"
#include "base/array.h"
#include "gles/probe.h"
#include <assert.h>
#include <stdlib.h>

bool gpu_init(struct gpu *gpu, sm_get_proc get_proc, const struct sm_driver_options *options,
	struct sm_error *error)
{
	*gpu = (struct gpu){0};
	if (!gl_load(&gpu->gl, get_proc, error) ||
		!caps_init(&gpu->caps, &gpu->gl, options->caps, error))
		return false;
	if (gpu_has(gpu, CAP_KHR_DEBUG))
		gl_load_debug(&gpu->gl, get_proc);
	if (gpu_has(gpu, CAP_TEXTURE_VIEW))
		gl_load_texture_view(&gpu->gl, get_proc);
	if (!ways_force(gpu, options->paths, options->path_count, error))
		return false;
	gpu->gl.finishes_passes = way_choose(gpu, DRIVER_PASSES, NULL) == PASSES_FINISHED;
	gpu->flat_inputs = way_choose(gpu, DRIVER_CONSTANTS, NULL) == CONSTANTS_FLAT;
	return true;
}

void gpu_finish(struct gpu *gpu)
{
	workers_finish(&gpu->workers);
	if (gpu->gl.GetError == NULL)
		return;
	gl_delete_buffer(&gpu->gl, &gpu->quad_indices);
	gl_delete_sampler(&gpu->gl, &gpu->stored_sampler);
	gpu_scene_finish(&gpu->scene, &gpu->gl);
	program_cache_finish(&gpu->programs, &gpu->gl);
	assert(gpu->gl.objects == 0 && gpu->gl.storages.count == 0);
	storages_finish(&gpu->gl.storages);
}

static void draw_elements(struct gpu *gpu, size_t first, size_t count, GLenum type)
{
	size_t size = type == GL_UNSIGNED_SHORT ? sizeof(GLushort) : sizeof(GLuint);
	gpu->gl.DrawElements(GL_TRIANGLES, (GLsizei)count, type, (const void *)(first * size));
	gpu->stats.draw_calls++;
	gpu->stats.triangles += count / 3;
}

void gpu_set_faces(
	struct gpu *gpu, const struct mesh *mesh, mat4 transform, mat4 to_clip, bool single_sided)
{
	struct gl *gl = &gpu->gl;
	gl->FrontFace(glm_mat4_det(transform) < 0.0f ? GL_CW : GL_CCW);
	if (single_sided || mesh_hides_back(mesh, to_clip))
		gl->Enable(GL_CULL_FACE);
	else
		gl->Disable(GL_CULL_FACE);
}

void gpu_draw_surface(
	struct gpu *gpu, const struct gpu_mesh *mesh, size_t first_cluster, size_t cluster_count)
{
	size_t first = 3 * first_cluster * CLUSTER_TRIANGLES;
	size_t count = 3 * cluster_count * CLUSTER_TRIANGLES;
	size_t left = (size_t)mesh->surface_count - first;
	gpu->gl.BindVertexArray(mesh->surface);
	draw_elements(gpu, first, count < left ? count : left, mesh->surface_type);
}

void gpu_draw_indices(
	struct gpu *gpu, const struct gpu_mesh *mesh, GLuint buffer, size_t first, size_t count)
{
	struct gl *gl = &gpu->gl;
	gl->BindVertexArray(mesh->surface);
	gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
	draw_elements(gpu, first, count, GL_UNSIGNED_INT);
	gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh->surface_indices);
}

void gpu_draw_caster(struct gpu *gpu, const struct gpu_mesh *mesh)
{
	gpu->gl.BindVertexArray(mesh->caster);
	draw_elements(gpu, 0, (size_t)mesh->caster_count, mesh->caster_type);
}

void gpu_draw_sheets(struct gpu *gpu, const struct gpu_mesh *mesh, const struct sheet_rule *rule)
{
	struct gl *gl = &gpu->gl;
	size_t count = (size_t)mesh->caster_count, one_sided = 3 * rule->one_sided;
	gl->BindVertexArray(mesh->caster);
	gl->FrontFace(rule->mirrored ? GL_CW : GL_CCW);
	if (one_sided > 0) {
		gl->Enable(GL_CULL_FACE);
		draw_elements(gpu, 0, one_sided, mesh->caster_type);
	}
	if (one_sided < count) {
		gl->Disable(GL_CULL_FACE);
		draw_elements(gpu, one_sided, count - one_sided, mesh->caster_type);
	}
}

static bool reserve_quads(struct gpu *gpu, size_t quad_count, struct sm_error *error)
{
	if (quad_count <= gpu->quad_capacity)
		return true;
	/* GLsizei counts the indices, 32 bits the vertices. */
	if (quad_count > INT32_MAX / 6)
		return error_set(error, SM_ERROR_MACHINE, "too many silhouette edges to draw");
	size_t capacity = quad_count + quad_count / 2;
	if (capacity > INT32_MAX / 6)
		capacity = quad_count;
	uint32_t *indices = array_alloc(capacity, 6 * sizeof(*indices));
	if (indices == NULL)
		return error_no_memory(error);
	static const uint32_t corners[6] = {0, 1, 2, 0, 2, 3};
	for (size_t i = 0; i < capacity * 6; i++)
		indices[i] = (uint32_t)(i / 6 * 4) + corners[i % 6];
	gl_fill_buffer(&gpu->gl, GL_ELEMENT_ARRAY_BUFFER, gpu->quad_indices,
		capacity * 6 * sizeof(*indices), indices, GL_STATIC_DRAW);
	free(indices);
	gpu->quad_capacity = capacity;
	return true;
}

bool gpu_draw_quads(struct gpu *gpu, size_t quad_count, struct sm_error *error)
{
	if (gpu->quad_indices == 0) {
		uint32_t light = gpu->gl.light;
		gpu->gl.light = SM_NONE;
		gpu->quad_indices = gl_create_buffer(&gpu->gl, STORAGE_QUADS);
		gpu->gl.light = light;
	}
	gpu->gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu->quad_indices);
	if (!reserve_quads(gpu, quad_count, error))
		return false;
	draw_elements(gpu, 0, quad_count * 6, GL_UNSIGNED_INT);
	return true;
}

void gpu_bind_texture(struct gpu *gpu, enum texture_unit unit, GLuint texture)
{
	gpu->gl.ActiveTexture(GL_TEXTURE0 + unit);
	gpu->gl.BindTexture(GL_TEXTURE_2D, texture);
}

void gpu_bind_layers(struct gpu *gpu, enum texture_unit unit, GLuint texture)
{
	gpu->gl.ActiveTexture(GL_TEXTURE0 + unit);
	gpu->gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture);
}

GLuint gpu_create_compare_sampler(struct gpu *gpu, GLint filter)
{
	struct gl *gl = &gpu->gl;
	GLuint sampler = gl_create_sampler(gl);
	gl->SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, filter);
	gl->SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, filter);
	gl->SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	gl->SamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	gl->SamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
	gl->SamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
	return sampler;
}

void gpu_bind_stored_sampler(struct gpu *gpu, enum texture_unit unit)
{
	struct gl *gl = &gpu->gl;
	if (gpu->stored_sampler == 0) {
		gpu->stored_sampler = gl_create_sampler(gl);
		gl->SamplerParameteri(
			gpu->stored_sampler, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
		gl->SamplerParameteri(gpu->stored_sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		gl->SamplerParameteri(gpu->stored_sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	}
	gl->BindSampler(unit, gpu->stored_sampler);
}

void gpu_fill_viewport(struct gpu *gpu, GLuint texture)
{
	gpu->gl.Disable(GL_BLEND);
	gpu->gl.Disable(GL_DEPTH_TEST);
	gpu_bind_texture(gpu, UNIT_BASE, texture);
	gpu_fill_tested(gpu);
}

void gpu_fill_tested(struct gpu *gpu)
{
	gpu->gl.BindVertexArray(0);
	gpu->gl.DrawArrays(GL_TRIANGLES, 0, 3);
	gpu->stats.draw_calls++;
}

void gpu_restore_state(struct gpu *gpu)
{
	struct gl *gl = &gpu->gl;
	gl->Disable(GL_SCISSOR_TEST);
	gl->Disable(GL_BLEND);
	gl->BlendEquation(GL_FUNC_ADD);
	gl->BlendFunc(GL_ONE, GL_ZERO);
	gl->Disable(GL_CULL_FACE);
	gl->FrontFace(GL_CCW);
	gl->Disable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
	gl->DepthMask(GL_TRUE);
	gl->DepthRangef(0.0f, 1.0f);
	gl->BindVertexArray(0);
	gl->BindBuffer(GL_ARRAY_BUFFER, 0);
	gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, 0);
	gl->UseProgram(0);
	for (GLuint unit = 0; unit < UNIT_COUNT; unit++) {
		gl->ActiveTexture(GL_TEXTURE0 + unit);
		gl->BindTexture(GL_TEXTURE_2D, 0);
		gl->BindTexture(GL_TEXTURE_2D_ARRAY, 0);
		gl->BindSampler(unit, 0);
	}
	gl->ActiveTexture(GL_TEXTURE0);
}
