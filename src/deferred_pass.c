/* SPDX-License-Identifier: MIT */
#include "deferred_pass.h"

static bool draw_receivers(const struct surface_pass *view, struct sm_error *error)
{
	/* Window x of 2, beside the light's screen. */
	static const GLuint none[4] = {0x40000000, 0, 0, 0};
	struct gl *gl = &view->renderer->gpu.gl;
	struct surface_pass pass = *view;
	pass.flags = (view->flags & FLAG_VISIBILITY) | FLAG_RECEIVERS;
	pass.first = true;
	pass.multisampled = false;
	view->renderer->received = (struct points_key){0};
	if (!picture_resize(&view->renderer->receivers, gl, STORAGE_RECEIVERS, view->width,
		    view->height, GL_RGBA32UI, error))
		return false;
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
	gl->DepthMask(GL_TRUE);
	gl->Disable(GL_BLEND);
	gl->ClearBufferuiv(GL_COLOR, 0, none);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
	return surface_pass_draw(&pass, error);
}

/* Its depth is the receivers', which is not used. */
static bool bind_found(
	const struct surface_pass *view, struct picture *found, struct sm_error *error)
{
	struct gl *gl = &view->renderer->gpu.gl;
	if (found->width == view->width && found->height == view->height) {
		picture_bind(found, gl);
		return true;
	}
	picture_finish(found, gl);
	return picture_init(found, gl, STORAGE_FOUND, view->width, view->height, GL_R16UI,
		view->renderer->receivers.depth, error);
}

static bool find(const struct surface_pass *view, struct picture *found, struct sm_error *error)
{
	struct sm_renderer *renderer = view->renderer;
	struct gpu *gpu = &renderer->gpu;
	uint64_t way = renderer->shadows.technique->surface_flags(view->shadow->state);
	struct program_key key = {PROGRAM_FIND, FLAG_RECEIVERS | (way & (FLAG_RUNS | FLAG_COARSE))};
	if (!bind_found(view, found, error))
		return false;
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return false;
	gpu->gl.Disable(GL_CULL_FACE);
	gpu->gl.Disable(GL_DEPTH_TEST);
	renderer->shadows.technique->bind(view->shadow->state, gpu, view->frame, program);
	gpu_bind_texture(gpu, UNIT_POINTS, renderer->receivers.color);
	gpu_fill_viewport(gpu, 0);
	return true;
}

bool deferred_pass_draw(
	const struct surface_pass *view, struct shadowed_light *light, struct sm_error *error)
{
	struct gl *gl = &view->renderer->gpu.gl;
	if (!draw_receivers(view, error))
		return false;
	gl_push_group(gl, "visibility");
	gl->light = (uint32_t)(light - view->renderer->lights);
	bool drawn = find(view, &light->found, error);
	gl->light = SM_NONE;
	gl_pop_group(gl);
	return drawn;
}

void deferred_pass_bind(const struct surface_pass *pass)
{
	struct gpu *gpu = &pass->renderer->gpu;
	gpu_bind_texture(gpu, UNIT_VISIBILITY, pass->found->color);
	gpu_bind_texture(gpu, UNIT_VISIBILITY_DEPTH, pass->renderer->receivers.depth);
}

static void give_back(struct sm_renderer *renderer, struct shadowed_light *light)
{
	picture_finish(&light->found, &renderer->gpu.gl);
	light->points = (struct points_key){0};
}

static void give_back_receivers(struct sm_renderer *renderer)
{
	picture_finish(&renderer->receivers, &renderer->gpu.gl);
	renderer->received = (struct points_key){0};
}

void deferred_pass_end_frame(struct sm_renderer *renderer)
{
	bool used = false;
	for (size_t i = 0; i < renderer->light_capacity; i++) {
		struct shadowed_light *light = &renderer->lights[i];
		bool deferred = light->sampling == SM_SAMPLING_DEFERRED;
		light->deferred_idle = deferred ? 0 : light->deferred_idle + 1;
		if (light->deferred_idle == IDLE_FRAMES_MAX)
			give_back(renderer, light);
		used = used || light->found.width > 0;
	}
	if (!used)
		give_back_receivers(renderer);
}

void deferred_pass_finish(struct sm_renderer *renderer)
{
	for (size_t i = 0; i < renderer->light_capacity; i++)
		give_back(renderer, &renderer->lights[i]);
	give_back_receivers(renderer);
}
