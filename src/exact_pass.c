/* SPDX-License-Identifier: MIT */
#include "exact_pass.h"
#include "base/processor_time.h"
#include "exact_scene.h"
#include "fixed/passes.h"
#include "gles/picture.h"
#include "gles/primitives.h"
#include "gles/target.h"

struct exact {
	struct exact_scene scene;
	const struct number_model *number;
	uint64_t number_flag;
	uint32_t map_size;
	float width;
	bool sinusoid;
	struct primitives blockers, fins, surfaces;
	struct target casters;
	struct target receivers; /* of objects that only receive: made when there are any */
	struct target nearest;   /* smoothies: depth, and alpha' */
	struct target least;
	struct target nearest_depth; /* what all but the last are drawn with */
	struct target least_depth;
	struct picture seen; /* of the picture: what of the light does not reach it */
	GLuint falloff;      /* table of the sinusoid */
};

static void make_falloff(struct exact *exact, struct gl *gl)
{
	uint16_t table[FIXED_FALLOFF_SIZE];
	fixed_falloff_init(exact->number, table);
	static const struct texel_format as = {GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT};
	exact->falloff = gl_create_texture(gl, STORAGE_TABLES);
	gl->ActiveTexture(GL_TEXTURE0);
	gl_fill_texture(gl, exact->falloff, &as, FIXED_FALLOFF_SIZE, 1, table);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static bool depth_init(struct target *depth, const struct exact *exact, struct gpu *gpu,
	enum storage_owner owner, struct sm_error *error)
{
	return target_init_shared(depth, &gpu->gl, owner, (GLsizei)exact->map_size,
		GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, error);
}

/* No map is read once its light's visibility is found. */
static bool map_init(struct target *map, const struct exact *exact, struct gpu *gpu,
	enum storage_owner owner, const struct target *depth, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	GLenum format = owner == STORAGE_EXACT_LEAST ? GL_R16UI : GL_R32UI;
	if (!target_init_shared(
		    map, gl, owner, (GLsizei)exact->map_size, format, GL_COLOR_ATTACHMENT0, error))
		return false;
	gl->FramebufferTexture2D(
		GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->texture, 0);
	return true;
}

static bool init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct exact *exact = state;
	bool half = options->precision == SM_PRECISION_HALF;
	exact->number = half ? &number_half : &number_fixed12;
	exact->number_flag = half ? 0 : FLAG_FIXED12;
	exact->map_size = options->map_size;
	exact->width = options->width;
	exact->sinusoid = options->falloff == SM_FALLOFF_SINUSOID;
	if (exact->sinusoid)
		make_falloff(exact, &gpu->gl);
	const struct target *depth = &exact->nearest_depth;
	return depth_init(&exact->nearest_depth, exact, gpu, STORAGE_EXACT_NEAREST, error) &&
	       depth_init(&exact->least_depth, exact, gpu, STORAGE_EXACT_LEAST, error) &&
	       map_init(&exact->casters, exact, gpu, STORAGE_EXACT_CASTERS, depth, error) &&
	       map_init(&exact->nearest, exact, gpu, STORAGE_EXACT_NEAREST, depth, error) &&
	       map_init(&exact->least, exact, gpu, STORAGE_EXACT_LEAST, &exact->least_depth, error);
}

static void finish(void *state, struct gpu *gpu)
{
	struct exact *exact = state;
	struct gl *gl = &gpu->gl;
	exact_scene_finish(&exact->scene);
	primitives_finish(&exact->blockers, gl);
	primitives_finish(&exact->fins, gl);
	primitives_finish(&exact->surfaces, gl);
	picture_finish(&exact->seen, gl);
	target_finish(&exact->least, gl);
	target_finish(&exact->nearest, gl);
	target_finish(&exact->receivers, gl);
	target_finish(&exact->casters, gl);
	target_finish(&exact->least_depth, gl);
	target_finish(&exact->nearest_depth, gl);
	gl_delete_texture(gl, &exact->falloff);
}

/* What a map of depths holds where nothing is. Of what is above 0 it is by chance that softpipe
 * does not clear with 0 instead: as bits of a float it is not too small to be normal. */
#define CLEAR_DEPTH UINT32_MAX

/* The framebuffer that is bound. */
static void clear(struct gl *gl, GLuint value)
{
	const GLuint values[4] = {value, value, value, value};
	gl->DepthMask(GL_TRUE);
	gl->ClearBufferuiv(GL_COLOR, 0, values);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_LESS);
}

static void clear_map(const struct target *map, struct gl *gl, GLuint value)
{
	target_bind(map, gl);
	clear(gl, value);
}

/* Draws what was uploaded into the map, which holds what was drawn before. */
static bool draw(const struct target *map, const struct primitives *primitives, struct gpu *gpu,
	const struct program *program, struct sm_error *error)
{
	target_bind(map, &gpu->gl);
	return primitives_draw(primitives, gpu, program, map->size, map->size, error);
}

static bool draw_depth(struct exact *exact, struct gpu *gpu, const struct target *map,
	const struct fixed_blockers *blockers, struct sm_error *error)
{
	struct program_key key = {.kind = PROGRAM_EXACT_DEPTH};
	clear_map(map, &gpu->gl, CLEAR_DEPTH);
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	for (size_t first = 0; program != NULL && first < blockers->count;
		first += PRIMITIVES_MAX) {
		primitives_upload(&exact->blockers, gpu, &blockers->items[first],
			blockers->count - first, sizeof(*blockers->items));
		if (!draw(map, &exact->blockers, gpu, program, error))
			return false;
	}
	return program != NULL;
}

static bool draw_maps(struct exact *exact, struct gpu *gpu, struct sm_error *error)
{
	const struct fixed_scene *fixed = &exact->scene.fixed;
	gl_push_group(&gpu->gl, "shadow map");
	bool drawn = draw_depth(exact, gpu, &exact->casters, &fixed->casters, error);
	gl_pop_group(&gpu->gl);
	if (!drawn || fixed->receivers_only.count == 0)
		return drawn;
	if (!exact->receivers.whole &&
		!map_init(&exact->receivers, exact, gpu, STORAGE_EXACT_RECEIVERS,
			&exact->nearest_depth, error))
		return false;
	gl_push_group(&gpu->gl, "receiver map");
	drawn = draw_depth(exact, gpu, &exact->receivers, &fixed->receivers_only, error);
	gl_pop_group(&gpu->gl);
	return drawn;
}

/* What was uploaded, in one of the two passes. */
static bool draw_fins(struct exact *exact, struct gpu *gpu, const struct target *map,
	uint64_t flags, struct sm_error *error)
{
	struct program_key key = {.kind = PROGRAM_EXACT_FIN, .flags = exact->number_flag | flags};
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return false;
	gpu->gl.Uniform1ui(program->uniform.pole_depth, exact->scene.fixed.pole);
	return draw(map, &exact->fins, gpu, program, error);
}

/* Both passes of the paper, in turn for each part of the fins that is drawn at once: they have
 * nothing to do with each other. */
static bool draw_smoothies(struct exact *exact, struct gpu *gpu, struct sm_error *error)
{
	const struct fixed_fins *fins = &exact->scene.fixed.fins;
	uint64_t both = exact->scene.fixed.receivers_only.count > 0 ? FLAG_RECEIVER_MAP : 0;
	uint64_t shape = exact->sinusoid ? FLAG_SINUSOID : 0;
	clear_map(&exact->least, &gpu->gl, 0); /* not read where there is no depth */
	clear_map(&exact->nearest, &gpu->gl, CLEAR_DEPTH);
	gpu_bind_texture(gpu, UNIT_DEPTH, exact->casters.texture);
	gpu_bind_texture(gpu, UNIT_RECEIVER, exact->receivers.texture);
	gpu_bind_texture(gpu, UNIT_FALLOFF, exact->falloff);
	for (size_t first = 0; first < fins->count; first += PRIMITIVES_MAX) {
		primitives_upload(&exact->fins, gpu, &fins->items[first], fins->count - first,
			sizeof(*fins->items));
		if (!draw_fins(exact, gpu, &exact->nearest, both | FLAG_DEPTH_ONLY, error) ||
			!draw_fins(exact, gpu, &exact->least, both | shape, error))
			return false;
	}
	return true;
}

static bool draw_surfaces(
	struct exact *exact, struct gpu *gpu, bool visibility, struct sm_error *error)
{
	const struct fixed_receivers *receivers = &exact->scene.fixed.receivers;
	struct program_key key = {.kind = PROGRAM_EXACT_SURFACE,
		.flags = exact->number_flag | (visibility ? FLAG_VISIBILITY : 0)};
	const struct picture *seen = &exact->seen;
	picture_bind(seen, &gpu->gl);
	clear(&gpu->gl, 0);
	gpu_bind_texture(gpu, UNIT_DEPTH, exact->casters.texture);
	gpu_bind_texture(gpu, UNIT_SMOOTHIE, exact->least.texture);
	gpu_bind_texture(gpu, UNIT_SMOOTHIE_DEPTH, exact->nearest.texture);
	const struct program *program = program_use(&gpu->programs, &gpu->gl, key, error);
	if (program == NULL)
		return false;
	gpu->gl.Uniform1i(program->uniform.map_texels, (GLint)exact->map_size);
	for (size_t first = 0; first < receivers->count; first += PRIMITIVES_MAX) {
		primitives_upload(&exact->surfaces, gpu, &receivers->items[first],
			receivers->count - first, sizeof(*receivers->items));
		if (!primitives_draw(&exact->surfaces, gpu, program, (GLsizei)seen->width,
			    (GLsizei)seen->height, error))
			return false;
	}
	return true;
}

static bool find(struct exact *exact, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct technique_view *view, struct sm_error *error)
{
	struct exact_view needed = {.frame = frame,
		.width = view->width,
		.height = view->height,
		.map_size = exact->map_size,
		.fin_width = exact->width,
		.sinusoid = exact->sinusoid};
	glm_mat4_copy(view->world_to_clip, needed.world_to_clip);
	double start = processor_ms();
	if (!exact_scene_find(&exact->scene, scene, &needed))
		return error_no_memory(error);
	gpu->stats.silhouette_ms += processor_ms() - start;
	gpu->stats.silhouette_edges += exact->scene.fins.edge_count;
	gpu->stats.fin_vertices += 4 * fin_set_quads(&exact->scene.fins);
	return true;
}

static bool prepare_view(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct technique_view *view, struct sm_error *error)
{
	struct exact *exact = state;
	struct gl *gl = &gpu->gl;
	gl_push_group(gl, "primitives");
	bool drawn = find(exact, gpu, scene, frame, view, error);
	gl_pop_group(gl);
	if (!drawn || !draw_maps(exact, gpu, error))
		return false;
	gl_push_group(gl, "smoothies");
	drawn = draw_smoothies(exact, gpu, error);
	gl_pop_group(gl);
	if (!drawn || !picture_resize(&exact->seen, gl, STORAGE_EXACT_SEEN, view->width,
			      view->height, GL_R16UI, error))
		return false;
	gl_push_group(gl, "visibility");
	drawn = draw_surfaces(exact, gpu, view->visibility, error);
	gl_pop_group(gl);
	return drawn;
}

static void bind_seen(const struct exact *exact, struct gpu *gpu)
{
	gpu_bind_texture(gpu, UNIT_VISIBILITY, exact->seen.color);
	gpu_bind_texture(gpu, UNIT_VISIBILITY_DEPTH, exact->seen.depth);
}

static bool show(const void *state, struct gpu *gpu, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	struct program_key key = {.kind = PROGRAM_EXACT_COPY};
	if (program_use(&gpu->programs, gl, key, error) == NULL)
		return false;
	gl_push_group(gl, "copy");
	bind_seen(state, gpu);
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(GL_ALWAYS);
	gl->BindVertexArray(0);
	gl->DrawArrays(GL_TRIANGLES, 0, 3);
	gpu->stats.draw_calls++;
	gl_pop_group(gl);
	return true;
}

static uint64_t surface_flags(const void *state)
{
	(void)state;
	return FLAG_SEEN;
}

static void list_memory(const void *state, const struct memory_list *list)
{
	const struct exact *exact = state;
	exact_scene_list_memory(&exact->scene, list);
}

static void bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	(void)frame, (void)program;
	bind_seen(state, gpu);
}

const struct technique technique_exact = {
	.name = "smoothie",
	.summary = "smoothies in integers, the same bits with every driver",
	.options = OPTION_WIDTH | OPTION_FALLOFF | OPTION_PASSES | OPTION_PRECISION,
	.state_size = sizeof(struct exact),
	.reads_receivers = true,
	.init = init,
	.finish = finish,
	.prepare_view = prepare_view,
	.show = show,
	.surface_flags = surface_flags,
	.list_memory = list_memory,
	.bind = bind,
};
