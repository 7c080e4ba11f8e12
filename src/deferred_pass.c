/* SPDX-License-Identifier: MIT */
#include "deferred_pass.h"
#include "sparse_pass.h"

static bool draw_receivers(const struct surface_pass *view, struct sm_error *error)
{
	/* Window x of 2, beside the light's screen. */
	static const GLuint none[4] = {0x40000000, 0, 0, 0};
	struct gl *gl = &view->renderer->gpu.gl;
	struct surface_pass pass = *view;
	pass.flags = (view->flags & FLAG_VISIBILITY) | FLAG_RECEIVERS;
	pass.first = true;
	pass.multisampled = false;
	/* Samples compare depths with those that another light may have drawn since. */
	pass.wanted = view->multisampled ? NULL : view->wanted;
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

static uint64_t find_flags(const struct surface_pass *view)
{
	const struct technique *technique = view->renderer->shadows.technique;
	uint64_t way = technique->surface_flags(view->shadow->state);
	return FLAG_RECEIVERS | FLAG_FLAT_INPUTS | (way & program_kind_flags(PROGRAM_FIND));
}

/* Of the light, with its receivers to read. */
static const struct program *use_program(
	const struct surface_pass *view, struct program_key key, struct sm_error *error)
{
	struct sm_renderer *renderer = view->renderer;
	struct gpu *gpu = &renderer->gpu;
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return NULL;
	renderer->shadows.technique->bind(view->shadow->state, gpu, view->frame, program);
	gpu_bind_texture(gpu, UNIT_POINTS, renderer->receivers.color);
	gpu_bind_texture(gpu, UNIT_VISIBILITY_DEPTH, renderer->receivers.depth);
	return program;
}

/* Fills the pixels that are wanted; of points: those among them and the next ones. */
static void fill(const struct surface_pass *view, bool points)
{
	struct gpu *gpu = &view->renderer->gpu;
	struct gl *gl = &gpu->gl;
	struct screen_part part = {0};
	gl->Enable(GL_SCISSOR_TEST);
	while (screen_part_next(&part, view->wanted, view->width, view->height)) {
		const struct pixel_box box = points ? sparse_pass_points_in(&part.box) : part.box;
		gl->Scissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
		gpu_fill_tested(gpu);
	}
	gl->Disable(GL_SCISSOR_TEST);
}

static bool find_points(const struct surface_pass *view, struct sm_error *error)
{
	struct gl *gl = &view->renderer->gpu.gl;
	struct program_key key = {PROGRAM_FIND, find_flags(view) | FLAG_POINTS};
	gl->Disable(GL_CULL_FACE);
	if (!sparse_pass_begin_points(view, error) || use_program(view, key, error) == NULL)
		return false;
	gl->Disable(GL_DEPTH_TEST);
	fill(view, true);
	return true;
}

/* What needs no edges, which then fails the depth test: drivers leave out whole blocks of pixels
 * there before they shade them. */
static bool find_known(
	const struct surface_pass *view, struct picture *cells, struct sm_error *error)
{
	struct surface_pass pass = *view;
	struct gl *gl = &view->renderer->gpu.gl;
	struct program_key key = {
		PROGRAM_KNOWN, FLAG_FLAT_INPUTS | (cells != NULL ? FLAG_CELLS : 0)};
	const struct program *program = use_program(view, key, error);
	if (program == NULL)
		return false;
	pass.cells = cells;
	if (cells != NULL)
		sparse_pass_bind(&pass, program);
	gl->Disable(GL_CULL_FACE);
	gl->Disable(GL_BLEND);
	gl->DepthMask(GL_TRUE);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
	fill(view, false);
	return true;
}

static bool find_rest(const struct surface_pass *view, struct sm_error *error)
{
	struct program_key key = {PROGRAM_FIND, find_flags(view)};
	if (use_program(view, key, error) == NULL)
		return false;
	view->renderer->gpu.gl.DepthMask(GL_FALSE);
	fill(view, false);
	view->renderer->gpu.gl.DepthMask(GL_TRUE);
	return true;
}

/* Of all lights, as the receivers are. */
static bool draw_points(const struct surface_pass *view, struct sm_error *error)
{
	struct gl *gl = &view->renderer->gpu.gl;
	gl_push_group(gl, "points");
	bool drawn = find_points(view, error);
	gl_pop_group(gl);
	return drawn;
}

static bool find(const struct surface_pass *view, struct shadowed_light *light, bool sparse,
	struct sm_error *error)
{
	struct gl *gl = &view->renderer->gpu.gl;
	struct picture *found = &light->found, *cells = sparse ? &light->cells : NULL;
	if ((sparse && !sparse_pass_join(view, cells, error)) ||
		!picture_resize(
			found, gl, STORAGE_FOUND, view->width, view->height, GL_R16UI, error))
		return false;
	return find_known(view, cells, error) && find_rest(view, error);
}

bool deferred_pass_draw(
	const struct surface_pass *view, struct shadowed_light *light, struct sm_error *error)
{
	struct gl *gl = &view->renderer->gpu.gl;
	bool sparse = light->sampling == SM_SAMPLING_DEFERRED_SPARSE;
	struct surface_pass pass = *view;
	struct screen_grid wanted;
	pass.wanted = &wanted;
	if (!surface_pass_mark(&pass, &wanted, error) || !draw_receivers(&pass, error) ||
		(sparse && !draw_points(&pass, error)))
		return false;
	gl_push_group(gl, "visibility");
	gl->light = (uint32_t)(light - view->renderer->lights);
	bool drawn = find(&pass, light, sparse, error);
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
		light->deferred_idle =
			sampling_is_deferred(light->sampling) ? 0 : light->deferred_idle + 1;
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
