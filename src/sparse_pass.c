/* SPDX-License-Identifier: MIT */
#include "sparse_pass.h"
#include <float.h>

/* How far off its plane a surface may be that counts as one, in what a point's distance to the next
 * is of the camera's depth. */
#define PLANE_TOLERANCE 0.5f

/* The view's points: at corners of blocks of pixels, since drivers leave out whole blocks, and one
 * more beyond on each side. */
static void widen_view(const struct surface_pass *view, uint32_t columns, uint32_t rows, mat4 wide)
{
	const float size[2] = {(float)view->width, (float)view->height};
	const float points[2] = {(float)columns, (float)rows};
	glm_mat4_copy(view->world_to_clip, wide);
	for (int axis = 0; axis < 2; axis++) {
		float scale = size[axis] / (SPARSE_SPACING * points[axis]);
		float shift = scale + 3.0f / points[axis] - 1.0f;
		for (int column = 0; column < 4; column++)
			wide[column][axis] = scale * wide[column][axis] + shift * wide[column][3];
	}
}

/* Window depth d at distance w is K - b / w: a pixel aside is 2 / (scale width) w, which as a
 * difference of depth is (K - d) times 2 / (scale width). */
static void find_tolerance(const struct surface_pass *view, float tolerance[2])
{
	vec4 *m = view->world_to_clip;
	vec3 x = {m[0][0], m[1][0], m[2][0]}, z = {m[0][2], m[1][2], m[2][2]};
	vec3 w = {m[0][3], m[1][3], m[2][3]};
	float square = fmaxf(glm_vec3_norm2(w), FLT_MIN), across = fmaxf(glm_vec3_norm(x), FLT_MIN);
	float pole = 0.5f + 0.5f * glm_vec3_dot(z, w) / square;
	float pixel = 2.0f * sqrtf(square) / (across * (float)view->width);
	float step = PLANE_TOLERANCE * SPARSE_SPACING * pixel;
	tolerance[0] = pole * step;
	tolerance[1] = -step;
}

bool sparse_pass_begin_points(const struct surface_pass *view, struct sm_error *error)
{
	static const GLuint nothing[4] = {0, 0, 0, 0}; /* narrow */
	struct gl *gl = &view->renderer->gpu.gl;
	uint32_t columns = (view->width + SPARSE_SPACING - 1) / SPARSE_SPACING + 3;
	uint32_t rows = (view->height + SPARSE_SPACING - 1) / SPARSE_SPACING + 3;
	if (!picture_resize(
		    &view->renderer->points, gl, STORAGE_POINTS, columns, rows, GL_RG32UI, error))
		return false;
	gl->Disable(GL_BLEND);
	gl->ClearBufferuiv(GL_COLOR, 0, nothing);
	return true;
}

struct pixel_box sparse_pass_points_in(const struct pixel_box *pixels)
{
	return (struct pixel_box){
		.left = pixels->left / SPARSE_SPACING + 1,
		.bottom = pixels->bottom / SPARSE_SPACING + 1,
		.right = (pixels->right - 1) / SPARSE_SPACING + 3,
		.top = (pixels->top - 1) / SPARSE_SPACING + 3,
	};
}

static bool draw_points(const struct surface_pass *view, struct sm_error *error)
{
	const struct picture *points = &view->renderer->points;
	struct gl *gl = &view->renderer->gpu.gl;
	struct surface_pass pass = *view;
	mat4 wide;
	if (!sparse_pass_begin_points(view, error))
		return false;
	pass.width = points->width;
	pass.height = points->height;
	pass.flags = FLAG_VISIBILITY | FLAG_POINTS;
	pass.first = true;
	pass.multisampled = false;
	pass.cells = NULL;
	widen_view(view, pass.width, pass.height, wide);
	pass.world_to_clip = wide;
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
	gl->DepthMask(GL_TRUE);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
	return surface_pass_draw(&pass, error);
}

bool sparse_pass_join(
	const struct surface_pass *view, struct picture *cells, struct sm_error *error)
{
	struct gpu *gpu = &view->renderer->gpu;
	const struct picture *points = &view->renderer->points;
	float tolerance[2];
	/* Left by the surfaces. */
	gpu->gl.Disable(GL_CULL_FACE);
	if (!picture_resize(cells, &gpu->gl, STORAGE_CELLS, points->width, points->height,
		    GL_RGBA32UI, error))
		return false;
	struct program_key key = {.kind = PROGRAM_CELLS};
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return false;
	find_tolerance(view, tolerance);
	gpu->gl.Uniform2f(program->uniform.cell_depth, tolerance[0], tolerance[1]);
	gpu_bind_texture(gpu, UNIT_POINTS, points->color);
	gpu_fill_viewport(gpu, 0);
	return true;
}

bool sparse_pass_draw(
	const struct surface_pass *view, struct shadowed_light *light, struct sm_error *error)
{
	/* Found out before state is set for surfaces, which ask for it. */
	way_choose(&view->renderer->gpu, DRIVER_BRANCH, NULL);
	if (!draw_points(view, error))
		return false;
	struct gl *gl = &view->renderer->gpu.gl;
	gl_push_group(gl, "cells");
	gl->light = (uint32_t)(light - view->renderer->lights);
	bool drawn = sparse_pass_join(view, &light->cells, error);
	gl->light = SM_NONE;
	gl_pop_group(gl);
	return drawn;
}

void sparse_pass_bind(const struct surface_pass *pass, const struct program *program)
{
	struct gpu *gpu = &pass->renderer->gpu;
	float tolerance[2];
	find_tolerance(pass, tolerance);
	gpu_bind_texture(gpu, UNIT_CELLS, pass->cells->color);
	gpu->gl.Uniform1f(program->uniform.cell_scale, 1.0f / SPARSE_SPACING);
	gpu->gl.Uniform2f(program->uniform.cell_depth, tolerance[0], tolerance[1]);
}

static void give_back(struct sm_renderer *renderer, struct shadowed_light *light)
{
	picture_finish(&light->cells, &renderer->gpu.gl);
	light->points = (struct points_key){0};
}

void sparse_pass_end_frame(struct sm_renderer *renderer)
{
	struct gl *gl = &renderer->gpu.gl;
	bool used = false;
	for (size_t i = 0; i < renderer->light_capacity; i++) {
		struct shadowed_light *light = &renderer->lights[i];
		light->sparse_idle =
			sampling_is_sparse(light->sampling) ? 0 : light->sparse_idle + 1;
		if (light->sparse_idle == IDLE_FRAMES_MAX)
			give_back(renderer, light);
		used = used || light->cells.width > 0;
	}
	if (!used)
		picture_finish(&renderer->points, gl);
}

void sparse_pass_finish(struct sm_renderer *renderer)
{
	picture_finish(&renderer->points, &renderer->gpu.gl);
	for (size_t i = 0; i < renderer->light_capacity; i++)
		give_back(renderer, &renderer->lights[i]);
}
