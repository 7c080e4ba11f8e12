/* SPDX-License-Identifier: MIT */
#include "gles/probe.h"
#include "technique/smoothie_state.h"

#define FALLOFF_SIZE 256

static void make_falloff(struct smoothie *smoothie, struct gl *gl)
{
	uint8_t table[FALLOFF_SIZE];
	for (int i = 0; i < FALLOFF_SIZE; i++) {
		double alpha = i / (FALLOFF_SIZE - 1.0);
		table[i] = (uint8_t)lround(255.0 * (0.5 - 0.5 * cos(GLM_PI * alpha)));
	}
	static const struct texel_format as = {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
	smoothie->falloff = gl_create_texture(gl, STORAGE_TABLES);
	gl->ActiveTexture(GL_TEXTURE0);
	gl_fill_texture(gl, smoothie->falloff, &as, FALLOFF_SIZE, 1, table);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/* Takes the way that the driver has the minimum found in. */
static bool choose_way(struct smoothie *smoothie, struct gpu *gpu,
	const struct sm_shadow_options *options, uint64_t fin_flags, struct sm_error *error)
{
	struct depth_ways ways;
	smoothie->way = way_choose(gpu, DRIVER_SMOOTHIE, error);
	if (smoothie->way < 0 || !depth_ways_choose(&ways, gpu, error))
		return false;
	bool by_depth_test = smoothie->way == SMOOTHIE_DEPTH_TEST;
	smoothie->two_passes =
		options->passes == 2 || smoothie->way == SMOOTHIE_RGBA8 || by_depth_test;
	if (smoothie->two_passes && !gpu_has(gpu, CAP_DEPTH_FETCH))
		return error_set(error, SM_ERROR_MACHINE,
			"two smoothie passes take %s, which is not there: %s",
			cap_name(CAP_DEPTH_FETCH), gpu->caps.found[CAP_DEPTH_FETCH].why);
	smoothie->fin_flags = (fin_flags & FLAG_CONE) | ways.plain;
	smoothie->alpha_flags = (options->falloff == SM_FALLOFF_SINUSOID ? FLAG_SINUSOID : 0) |
				(by_depth_test ? FLAG_ALPHA_DEPTH : 0) |
				(smoothie->way == SMOOTHIE_FETCH ? FLAG_FETCH : 0);
	smoothie->surface_flags = FLAG_SMOOTHIE | ways.taps |
				  (smoothie->two_passes ? FLAG_SEPARATE_DEPTH : 0) |
				  (by_depth_test ? FLAG_ALPHA_DEPTH : 0);
	return true;
}

/* How both channels of the buffer are to be looked up. */
static enum pairs_way choose_pairs(const struct smoothie *smoothie, struct gpu *gpu)
{
	bool halves = way_at(DRIVER_SMOOTHIE, (size_t)smoothie->way)->format == GL_RG16F;
	bool free = halves && !smoothie->two_passes && smoothie->surface_flags & FLAG_GATHER;
	return free ? (enum pairs_way)way_choose(gpu, DRIVER_PAIRS, NULL) : PAIRS_APART;
}

/* Whether the buffer is of words that have the shadow map in them. */
static bool is_fused(const struct smoothie *smoothie)
{
	return (smoothie->surface_flags & FLAG_FUSED) != 0;
}

static void take_fused(struct smoothie *smoothie)
{
	smoothie->alpha_flags |= FLAG_FETCH | FLAG_FUSED;
	smoothie->surface_flags |= FLAG_FUSED;
}

bool smoothie_init(struct smoothie *smoothie, struct gpu *gpu,
	const struct sm_shadow_options *options, const struct fin_shape *shape, uint64_t fin_flags,
	struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	GLsizei size = (GLsizei)options->map_size;
	smoothie->shape = *shape;
	if (!choose_way(smoothie, gpu, options, fin_flags, error))
		return false;
	enum pairs_way pairs = choose_pairs(smoothie, gpu);
	if (pairs == PAIRS_FUSED)
		take_fused(smoothie);
	fin_stream_init(&smoothie->fins, gpu);
	if (options->falloff == SM_FALLOFF_SINUSOID && !(fin_flags & FLAG_CONE))
		make_falloff(smoothie, gl);
	if (!depth_map_init(
		    &smoothie->casters, gpu, options->map_size, DEPTH_MAP_LINEAR, true, error) ||
		!target_init(&smoothie->buffer, gl, STORAGE_SMOOTHIES, size,
			is_fused(smoothie) ? GL_R32I
					   : way_at(DRIVER_SMOOTHIE, (size_t)smoothie->way)->format,
			smoothie->way == SMOOTHIE_DEPTH_TEST ? GL_DEPTH_ATTACHMENT
							     : GL_COLOR_ATTACHMENT0,
			error))
		return false;
	if (pairs == PAIRS_WORDS)
		smoothie->words =
			target_create_view(&smoothie->buffer, gl, STORAGE_SMOOTHIES, GL_R32I);
	if (smoothie->words != 0)
		smoothie->surface_flags |= FLAG_WORDS;
	return !smoothie->two_passes ||
	       target_init(&smoothie->depth, gl, STORAGE_SMOOTHIE_DEPTHS, size,
		       GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, error);
}

void smoothie_finish(void *state, struct gpu *gpu)
{
	struct smoothie *smoothie = state;
	fin_stream_finish(&smoothie->fins, gpu);
	gl_delete_texture(&gpu->gl, &smoothie->falloff);
	target_finish(&smoothie->depth, &gpu->gl);
	gl_delete_texture(&gpu->gl, &smoothie->words);
	target_finish(&smoothie->buffer, &gpu->gl);
	depth_map_finish(&smoothie->receivers, gpu);
	depth_map_finish(&smoothie->casters, gpu);
}

static bool draw_fins(struct smoothie *smoothie, struct gpu *gpu, const struct light_frame *frame,
	uint64_t flags, struct sm_error *error)
{
	struct program_key key = {.kind = PROGRAM_FIN, .flags = flags};
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return false;
	gpu->gl.Uniform1f(program->uniform.near_to_far, frame->near_to_far);
	gpu->gl.Uniform1f(program->uniform.pole, frame->pole);
	return fin_stream_draw(&smoothie->fins, gpu, program, error);
}

/* Draws fins into a part of a depth texture, which is cleared: the least is kept. */
static bool draw_by_depth_test(struct smoothie *smoothie, struct gpu *gpu,
	const struct light_frame *frame, const struct target *target, const struct screen_box *part,
	uint64_t flags, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	target_bind(target, gl);
	target_restrict_clear(target, part, gl);
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
	gl->DepthMask(GL_TRUE);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
	target_restrict(target_part(target, part), gl);
	return draw_fins(smoothie, gpu, frame, flags, error);
}

/* The words of the shadow map in a part, and fins. */
static bool draw_fused(struct smoothie *smoothie, struct gpu *gpu, const struct light_frame *frame,
	const struct screen_box *part, uint64_t flags, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	static const struct program_key key = {.kind = PROGRAM_WORD};
	static const GLint lit[4] = {0x3f800000}; /* the bits of 1 */
	struct screen_box held = depth_map_held(&smoothie->casters);
	target_bind(&smoothie->buffer, gl);
	target_restrict_clear(&smoothie->buffer, part, gl);
	gl->ClearBufferiv(GL_COLOR, 0, lit);
	if (program_use(&gpu->programs, gl, key, error) == NULL)
		return false;
	screen_box_cut(&held, part);
	target_restrict(target_part(&smoothie->buffer, &held), gl);
	gpu_fill_viewport(gpu, smoothie->casters.target.texture);
	target_restrict(target_part(&smoothie->buffer, part), gl);
	return draw_fins(smoothie, gpu, frame, flags, error);
}

static bool draw_minimum(struct smoothie *smoothie, struct gpu *gpu,
	const struct light_frame *frame, const struct screen_box *part, uint64_t flags,
	struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	static const GLfloat lit[4] = {1.0f, 1.0f, 1.0f, 1.0f};
	target_bind(&smoothie->buffer, gl);
	target_restrict_clear(&smoothie->buffer, part, gl);
	gl->Disable(GL_DEPTH_TEST);
	gl->ClearBufferfv(GL_COLOR, 0, lit);
	if (smoothie->way != SMOOTHIE_FETCH)
		gl->Enable(GL_BLEND);
	gl->BlendEquation(GL_MIN);
	target_restrict(target_part(&smoothie->buffer, part), gl);
	bool drawn = draw_fins(smoothie, gpu, frame, flags, error);
	gl->BlendEquation(GL_FUNC_ADD);
	gl->Disable(GL_BLEND);
	return drawn;
}

/* flags: of PROGRAM_FIN. */
static bool draw_buffer(struct smoothie *smoothie, struct gpu *gpu, const struct light_frame *frame,
	const struct screen_box *part, uint64_t flags, struct sm_error *error)
{
	uint64_t depth_flags = (flags & ~FLAG_CONE) | FLAG_DEPTH_ONLY;
	uint64_t alpha_flags = flags | smoothie->alpha_flags;
	if (!fin_stream_upload(&smoothie->fins, gpu, &smoothie->buffer, part, error))
		return false;
	if (smoothie->two_passes && !draw_by_depth_test(smoothie, gpu, frame, &smoothie->depth,
					    part, depth_flags, error))
		return false;
	if (is_fused(smoothie))
		return draw_fused(smoothie, gpu, frame, part, alpha_flags, error);
	return smoothie->way == SMOOTHIE_DEPTH_TEST
		       ? draw_by_depth_test(
				 smoothie, gpu, frame, &smoothie->buffer, part, alpha_flags, error)
		       : draw_minimum(smoothie, gpu, frame, part, alpha_flags, error);
}

bool smoothie_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct smoothie *smoothie = state;
	const struct fin_maps maps = {&smoothie->casters, &smoothie->receivers};
	uint64_t flags = smoothie->fin_flags;
	struct screen_box part;
	if (!fin_stream_prepare(&smoothie->fins, gpu, scene, frame, &smoothie->shape, &maps, &flags,
		    &part, error))
		return false;
	if (screen_box_is_none(&part))
		return true;
	gl_push_group(&gpu->gl, "smoothies");
	gpu_bind_texture(gpu, UNIT_DEPTH, depth_map_plain_texture(&smoothie->casters));
	gpu_bind_texture(gpu, UNIT_RECEIVER, depth_map_plain_texture(&smoothie->receivers));
	gpu_bind_texture(gpu, UNIT_FALLOFF, smoothie->falloff);
	bool drawn = draw_buffer(smoothie, gpu, frame, &part, flags, error);
	gpu->gl.Disable(GL_SCISSOR_TEST);
	gl_pop_group(&gpu->gl);
	if (!drawn)
		depth_map_forget(&smoothie->casters);
	return drawn;
}

uint64_t smoothie_surface_flags(const void *state)
{
	const struct smoothie *smoothie = state;
	return smoothie->surface_flags;
}

const struct screen_grid *smoothie_soft_grid(const void *state)
{
	const struct smoothie *smoothie = state;
	return &smoothie->fins.grid;
}

const struct screen_depths *smoothie_soft_depths(const void *state)
{
	const struct smoothie *smoothie = state;
	return smoothie->fins.depths;
}

const struct fin_set *smoothie_fins(const void *state)
{
	const struct smoothie *smoothie = state;
	return &smoothie->fins.set;
}

struct object_watch *smoothie_casters(void *state, const struct light_frame *frame, float *reach)
{
	struct smoothie *smoothie = state;
	*reach = fin_stream_reach(&smoothie->shape, frame, smoothie->casters.target.size);
	return &smoothie->casters.watch;
}

void smoothie_list_memory(const void *state, const struct memory_list *list)
{
	const struct smoothie *smoothie = state;
	fin_stream_list_memory(&smoothie->fins, list);
	depth_map_list_memory(&smoothie->casters, list);
}

void smoothie_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct smoothie *smoothie = state;
	depth_map_bind(&smoothie->casters, gpu, frame, program);
	gpu_bind_texture(gpu, UNIT_SMOOTHIE, smoothie->buffer.texture);
	gpu_bind_texture(gpu, UNIT_SMOOTHIE_WORDS,
		is_fused(smoothie) ? smoothie->buffer.texture : smoothie->words);
	gpu_bind_texture(gpu, UNIT_SMOOTHIE_DEPTH, smoothie->depth.texture);
}

static bool init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	const struct fin_shape shape = {.width = options->width, .share = SMOOTHIE_WIDTH_SHARE};
	return smoothie_init(state, gpu, options, &shape, 0, error);
}

const struct technique technique_smoothie = {
	.name = "smoothie",
	.summary = "soft shadows by fins on silhouettes (Chan & Durand 2003)",
	.options = OPTION_WIDTH | OPTION_FALLOFF | OPTION_PASSES | OPTION_PRECISION,
	.state_size = sizeof(struct smoothie),
	.reads_receivers = true,
	.init = init,
	.finish = smoothie_finish,
	.prepare = smoothie_prepare,
	.surface_flags = smoothie_surface_flags,
	.soft_grid = smoothie_soft_grid,
	.soft_depths = smoothie_soft_depths,
	.texels_around = LOOKUP_REACH_LINEAR,
	.fins = smoothie_fins,
	.casters = smoothie_casters,
	.list_memory = smoothie_list_memory,
	.bind = smoothie_bind,
};
