/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"
#include "technique/fin_stream.h"

/* Smoothies on both sides of the silhouette. The buffer holds, of the nearest edge, the way to it,
 * its depth and that of the surface beside it; alpha is only found from them where a surface is
 * drawn, by the surface's own depth. Integer texels are core ES 3.0, whatever a driver makes of
 * floats: two half floats in a word, and two floats. */
struct two_sided {
	struct depth_map casters;
	struct depth_map receivers; /* of objects that only receive: made when there are any */
	struct target buffer;
	struct target nearness; /* the buffer's depth attachment: 0 at an edge, 1 where no fin is */
	struct fin_stream fins;
	uint64_t surface_flags, plain_flags;
};

/* Each texel that a surface in the penumbra looks up, 1.42 texels off at most, knows the edge. */
static const struct fin_shape fin_shape = {.share = 1.0f, .apron = 1.5f, .both_sides = true};

static bool two_sided_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct two_sided *two_sided = state;
	struct gl *gl = &gpu->gl;
	GLsizei size = (GLsizei)options->map_size;
	struct depth_ways ways;
	if (!depth_ways_choose(&ways, gpu, error))
		return false;
	two_sided->surface_flags = FLAG_TWO_SIDED | ways.taps;
	two_sided->plain_flags = ways.plain;
	fin_stream_init(&two_sided->fins, gpu);
	if (!depth_map_init(
		    &two_sided->casters, gpu, options->map_size, DEPTH_MAP_LINEAR, true, error) ||
		!target_init_shared(&two_sided->nearness, gl, STORAGE_SMOOTHIE_DEPTHS, size,
			GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, error) ||
		!target_init(&two_sided->buffer, gl, STORAGE_SMOOTHIES, size, GL_RGBA32UI,
			GL_COLOR_ATTACHMENT0, error))
		return false;
	gl->FramebufferTexture2D(
		GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, two_sided->nearness.texture, 0);
	return true;
}

static void two_sided_finish(void *state, struct gpu *gpu)
{
	struct two_sided *two_sided = state;
	fin_stream_finish(&two_sided->fins, gpu);
	target_finish(&two_sided->buffer, &gpu->gl);
	target_finish(&two_sided->nearness, &gpu->gl);
	depth_map_finish(&two_sided->receivers, gpu);
	depth_map_finish(&two_sided->casters, gpu);
}

static void clear_buffer(
	const struct two_sided *two_sided, struct gl *gl, const struct screen_box *part)
{
	/* An edge at depth 1, behind which nothing is: its bits as a float. */
	static const GLuint none[4] = {0, 0x3f800000, 0, 0};
	target_bind(&two_sided->buffer, gl);
	target_restrict_clear(&two_sided->buffer, part, gl);
	gl->DepthMask(GL_TRUE);
	gl->ClearBufferuiv(GL_COLOR, 0, none);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
}

static bool draw_fins(struct two_sided *two_sided, struct gpu *gpu, const struct light_frame *frame,
	const struct screen_box *part, uint64_t flags, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	struct program_key key = {.kind = PROGRAM_TWO_SIDED_FIN, .flags = flags};
	const struct program *program = program_use(&gpu->programs, gl, key, error);
	if (program == NULL)
		return false;
	gl->Uniform1f(
		program->uniform.spread, fin_stream_spread(frame, two_sided->casters.target.size));
	gl->Uniform1f(program->uniform.apron, fin_shape.apron);
	gl->Uniform1f(program->uniform.near_to_far, frame->near_to_far);
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
	target_restrict(target_part(&two_sided->buffer, part), gl);
	bool drawn = fin_stream_draw(&two_sided->fins, gpu, program, error);
	gl->Disable(GL_SCISSOR_TEST);
	return drawn;
}

static bool two_sided_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct two_sided *two_sided = state;
	const struct fin_maps maps = {&two_sided->casters, &two_sided->receivers};
	uint64_t flags = two_sided->plain_flags;
	struct screen_box part;
	if (!fin_stream_prepare(
		    &two_sided->fins, gpu, scene, frame, &fin_shape, &maps, &flags, &part, error))
		return false;
	if (screen_box_is_none(&part))
		return true;
	gl_push_group(&gpu->gl, "smoothies");
	gpu_bind_texture(gpu, UNIT_DEPTH, depth_map_plain_texture(&two_sided->casters));
	gpu_bind_texture(gpu, UNIT_RECEIVER, depth_map_plain_texture(&two_sided->receivers));
	clear_buffer(two_sided, &gpu->gl, &part);
	bool drawn = fin_stream_upload(&two_sided->fins, gpu, &two_sided->buffer, &part, error) &&
		     draw_fins(two_sided, gpu, frame, &part, flags, error);
	gl_pop_group(&gpu->gl);
	if (!drawn)
		depth_map_forget(&two_sided->casters);
	return drawn;
}

static uint64_t two_sided_surface_flags(const void *state)
{
	const struct two_sided *two_sided = state;
	return two_sided->surface_flags;
}

static const struct screen_grid *two_sided_soft_grid(const void *state)
{
	const struct two_sided *two_sided = state;
	return &two_sided->fins.grid;
}

static const struct screen_depths *two_sided_soft_depths(const void *state)
{
	const struct two_sided *two_sided = state;
	return two_sided->fins.depths;
}

static struct object_watch *two_sided_casters(
	void *state, const struct light_frame *frame, float *reach)
{
	struct two_sided *two_sided = state;
	*reach = fin_stream_reach(&fin_shape, frame, two_sided->casters.target.size);
	return &two_sided->casters.watch;
}

static void two_sided_list_memory(const void *state, const struct memory_list *list)
{
	const struct two_sided *two_sided = state;
	fin_stream_list_memory(&two_sided->fins, list);
	depth_map_list_memory(&two_sided->casters, list);
}

static void two_sided_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct two_sided *two_sided = state;
	depth_map_bind(&two_sided->casters, gpu, frame, program);
	gpu_bind_texture(gpu, UNIT_FINS, two_sided->buffer.texture);
	gpu->gl.Uniform1f(
		program->uniform.spread, fin_stream_spread(frame, two_sided->casters.target.size));
}

const struct technique technique_smoothie_two_sided = {
	.name = "smoothie-two-sided",
	.summary = "fins on both sides of silhouettes, the light's disc cut by the nearest edge",
	.state_size = sizeof(struct two_sided),
	.reads_receivers = true,
	.init = two_sided_init,
	.finish = two_sided_finish,
	.prepare = two_sided_prepare,
	.surface_flags = two_sided_surface_flags,
	.soft_grid = two_sided_soft_grid,
	.soft_depths = two_sided_soft_depths,
	.casters = two_sided_casters,
	.list_memory = two_sided_list_memory,
	.bind = two_sided_bind,
};
