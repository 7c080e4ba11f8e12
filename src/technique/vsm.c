/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"

/* Donnelly & Lauritzen 2006. */
struct vsm {
	struct depth_map map;
	struct depth_map receivers; /* of objects that only receive: made when there are any */
	struct object_watch watch;  /* on those */
	struct target rows;         /* blurred across */
	struct target moments;      /* blurred both ways */
	GLint blur_radius;          /* texels */
	float min_variance;
	uint64_t surface_flags, blur_flags, plain_flags;
	uint64_t drawn_flags; /* of the first blur, that the moments were drawn with */
};

/* Of depths in [-1/2, 1/2]: a variance below these may be none, for their squares' rounding. */
#define MIN_VARIANCE_32F 1e-6f
#define MIN_VARIANCE_SPLIT 4e-6f

static bool vsm_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct vsm *vsm = state;
	struct gl *gl = &gpu->gl;
	GLsizei size = (GLsizei)options->map_size;
	struct depth_ways ways;
	int way = way_choose(gpu, DRIVER_MOMENTS, error);
	if (way < 0 || !depth_ways_choose(&ways, gpu, error))
		return false;
	vsm->plain_flags = ways.plain;
	GLenum format = way_at(DRIVER_MOMENTS, (size_t)way)->format;
	bool split = way >= MOMENTS_RGBA16F;
	bool filtered = way == MOMENTS_RG32F || way == MOMENTS_RGBA16F;
	vsm->blur_radius = (GLint)options->samples / 2;
	vsm->min_variance = split ? MIN_VARIANCE_SPLIT : MIN_VARIANCE_32F;
	vsm->blur_flags = split ? FLAG_SPLIT : 0;
	vsm->surface_flags = FLAG_VSM | vsm->blur_flags | (filtered ? 0 : FLAG_FOUR_FETCHES);
	if (!depth_map_init(&vsm->map, gpu, options->map_size, DEPTH_MAP_LINEAR, true, error) ||
		!target_init_shared(
			&vsm->rows, gl, STORAGE_BLUR, size, format, GL_COLOR_ATTACHMENT0, error) ||
		!target_init(&vsm->moments, gl, STORAGE_MOMENTS, size, format, GL_COLOR_ATTACHMENT0,
			error))
		return false;
	if (filtered) {
		gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
		gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	}
	return true;
}

static void vsm_finish(void *state, struct gpu *gpu)
{
	struct vsm *vsm = state;
	target_finish(&vsm->moments, &gpu->gl);
	target_finish(&vsm->rows, &gpu->gl);
	object_watch_finish(&vsm->watch);
	depth_map_finish(&vsm->receivers, gpu);
	depth_map_finish(&vsm->map, gpu);
}

/* Into a part of a target. */
static bool blur(const struct vsm *vsm, struct gpu *gpu, const struct light_frame *frame,
	GLuint from, const struct target *to, const struct screen_box *part, uint64_t flags,
	struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	struct program_key key = {.kind = PROGRAM_BLUR, .flags = flags | vsm->blur_flags};
	const struct program *program = program_use(&gpu->programs, gl, key, error);
	if (program == NULL)
		return false;
	gl->Uniform1i(program->uniform.blur_radius, vsm->blur_radius);
	gl->Uniform1f(program->uniform.near_to_far, frame->near_to_far);
	/* The far plane, for what lies beside the screen. */
	static const GLfloat far_plane[4] = {0.5f, 0.25f};
	target_bind(to, gl);
	target_restrict_clear(to, part, gl);
	gl->ClearBufferfv(GL_COLOR, 0, far_plane);
	target_restrict(target_part(to, part), gl);
	gpu_fill_viewport(gpu, from);
	gl->Disable(GL_SCISSOR_TEST);
	return true;
}

static bool draw_moments(struct vsm *vsm, struct gpu *gpu, const struct light_frame *frame,
	const struct screen_box parts[2], uint64_t flags, struct sm_error *error)
{
	const struct target *rows = &vsm->rows;
	gl_push_group(&gpu->gl, "blur");
	gpu_bind_texture(gpu, UNIT_RECEIVER, depth_map_plain_texture(&vsm->receivers));
	bool drawn = blur(vsm, gpu, frame, depth_map_plain_texture(&vsm->map), rows, &parts[1],
			     flags, error) &&
		     blur(vsm, gpu, frame, rows->texture, &vsm->moments, &parts[0], 0, error);
	gl_pop_group(&gpu->gl);
	return drawn;
}

static bool prepare(struct vsm *vsm, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	float reach = 2.0f * (float)vsm->blur_radius / (float)vsm->rows.size;
	uint64_t flags = FLAG_FROM_DEPTH | vsm->plain_flags;
	if (depth_map_has_content(scene, DEPTH_OF_RECEIVERS_ONLY))
		flags |= FLAG_RECEIVER_MAP;
	if (!depth_map_draw(&vsm->map, gpu, scene, frame, error))
		return false;
	struct screen_box changed = vsm->map.changed;
	if (!depth_map_look_at_receivers(&vsm->watch, scene, frame, &changed, error))
		return false;
	if (flags != vsm->drawn_flags)
		changed = screen_box_all();
	vsm->drawn_flags = flags;
	if (screen_box_is_none(&changed))
		return true;
	/* Of the moments, of the rows that they are made from, and of the maps that those are. */
	struct screen_box parts[3];
	for (int i = 0; i < 3; i++)
		parts[i] = screen_box_widened(&changed, (float)(i + 1) * reach);
	if (flags & FLAG_RECEIVER_MAP &&
		(!depth_map_init_once(&vsm->receivers, gpu, vsm->map.target.size, error) ||
			!depth_map_draw_part(&vsm->receivers, gpu, scene, frame,
				DEPTH_OF_FARTHEST_RECEIVERS, &parts[2], error)))
		return false;
	return draw_moments(vsm, gpu, frame, parts, flags, error);
}

static bool vsm_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct vsm *vsm = state;
	bool drawn = prepare(vsm, gpu, scene, frame, error);
	/* What has changed since is known no more. */
	if (!drawn)
		depth_map_forget(&vsm->map);
	return drawn;
}

static uint64_t vsm_surface_flags(const void *state)
{
	const struct vsm *vsm = state;
	return vsm->surface_flags;
}

static float vsm_reach(const void *state, const struct light_frame *frame)
{
	(void)frame;
	const struct vsm *vsm = state;
	return 2.0f * (float)vsm->blur_radius / (float)vsm->moments.size;
}

static struct object_watch *vsm_casters(void *state, const struct light_frame *frame, float *reach)
{
	struct vsm *vsm = state;
	*reach = vsm_reach(state, frame);
	return &vsm->map.watch;
}

static void vsm_list_memory(const void *state, const struct memory_list *list)
{
	const struct vsm *vsm = state;
	depth_map_list_memory(&vsm->map, list);
	object_watch_list_memory(&vsm->watch, list);
}

static void vsm_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct vsm *vsm = state;
	depth_map_set_receiver(gpu, vsm->map.target.size, DEPTH_MAP_LINEAR, frame, program);
	gpu_bind_texture(gpu, UNIT_MOMENTS, vsm->moments.texture);
	gpu->gl.Uniform1f(program->uniform.min_variance, vsm->min_variance);
}

const struct technique technique_vsm = {
	.name = "vsm",
	.summary = "variance shadow maps, blurred over so many texels a side (Donnelly & Lauritzen "
		   "2006)",
	.samples = {5, 9},
	.state_size = sizeof(struct vsm),
	.reads_receivers = true,
	.init = vsm_init,
	.finish = vsm_finish,
	.prepare = vsm_prepare,
	.surface_flags = vsm_surface_flags,
	.reach = vsm_reach,
	.needs_parts = true,
	.casters = vsm_casters,
	.list_memory = vsm_list_memory,
	.bind = vsm_bind,
};
