/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"
#include "base/error.h"
#include "scene/light_reach.h"
#include <string.h>

/* No caster is before the near plane: there, from this share of its distance on, all is alike. */
#define LEAST_W 1e-3f

static const struct {
	GLint filter;
	float texels_around;
} filters[] = {
	[DEPTH_MAP_NEAREST] = {GL_NEAREST, LOOKUP_REACH_NEAREST},
	[DEPTH_MAP_LINEAR] = {GL_LINEAR, LOOKUP_REACH_LINEAR},
};

bool depth_ways_choose(struct depth_ways *ways, struct gpu *gpu, struct sm_error *error)
{
	static const uint64_t write[] = {
		[DEPTH_TEXTURE] = 0,
		[DEPTH_R32F] = FLAG_DEPTH_FLOAT,
		[DEPTH_R16F] = FLAG_DEPTH_HALF,
		[DEPTH_RGBA8] = FLAG_DEPTH_PACKED,
	};
	int depth = way_choose(gpu, DRIVER_DEPTH, error);
	int comparison = way_choose(gpu, DRIVER_COMPARISON, error);
	int taps = way_choose(gpu, DRIVER_TAPS, error);
	if (depth < 0 || comparison < 0 || taps < 0)
		return false;
	*ways = (struct depth_ways){
		.write = write[depth],
		.plain = write[depth] & ~FLAG_DEPTH_FLOAT,
		.format = way_at(DRIVER_DEPTH, (size_t)depth)->format,
		.compares_plainly = comparison == COMPARISON_FETCH,
		.taps_plainly = taps == TAPS_FETCH,
	};
	ways->taps = taps == TAPS_GATHER ? FLAG_GATHER : ways->plain;
	ways->compare = comparison == COMPARISON_SAMPLER  ? 0
			: comparison == COMPARISON_GATHER ? FLAG_GATHER
							  : FLAG_FOUR_FETCHES | ways->plain;
	return true;
}

static bool init_target(struct target *target, const struct depth_map *map, struct gpu *gpu,
	enum storage_owner owner, GLsizei size, GLenum format, GLenum attachment,
	struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	if (map->disc != NULL)
		return target_init_layers(
			target, gl, owner, size, map->disc->count, format, attachment, error);
	return map->shared ? target_init_shared(target, gl, STORAGE_RECEIVER_MAPS, size, format,
				     attachment, error)
			   : target_init(target, gl, owner, size, format, attachment, error);
}

/* A colour for each depth, unless the depth texture will do. */
static bool init_plain(struct depth_map *map, struct gpu *gpu, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	struct depth_ways ways;
	if (!depth_ways_choose(&ways, gpu, error))
		return false;
	map->write = ways.write;
	if (ways.format == 0)
		return true;
	if (!init_target(&map->plain, map, gpu, STORAGE_PLAIN_DEPTHS, map->target.size, ways.format,
		    GL_COLOR_ATTACHMENT0, error))
		return false;
	/* Those of a layer come and go with it. */
	if (map->disc == NULL)
		gl->FramebufferTexture2D(
			GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map->target.texture, 0);
	return true;
}

bool depth_map_init(struct depth_map *map, struct gpu *gpu, uint32_t size,
	enum depth_map_filter filter, bool plain, struct sm_error *error)
{
	map->filter = filter;
	if (!init_target(&map->target, map, gpu, STORAGE_SHADOW_MAPS, (GLsizei)size,
		    GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, error))
		return false;
	map->compare = gpu_create_compare_sampler(gpu, filters[filter].filter);
	return !plain || init_plain(map, gpu, error);
}

bool depth_map_init_layers(struct depth_map *map, struct gpu *gpu, uint32_t size,
	const struct disc *disc, enum depth_map_filter filter, bool plain, struct sm_error *error)
{
	map->disc = disc;
	return depth_map_init(map, gpu, size, filter, plain, error);
}

GLuint depth_map_plain_texture(const struct depth_map *map)
{
	return map->plain.texture != 0 ? map->plain.texture : map->target.texture;
}

static void bind_target(const struct depth_map *map, struct gl *gl, GLint layer)
{
	bool plain = map->plain.texture != 0;
	const struct target *target = plain ? &map->plain : &map->target;
	if (map->disc == NULL) {
		target_bind(target, gl);
		return;
	}
	target_bind_layer(target, gl, layer);
	if (plain)
		gl->FramebufferTextureLayer(
			GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, map->target.texture, 0, layer);
}

bool depth_map_init_once(
	struct depth_map *map, struct gpu *gpu, GLsizei size, struct sm_error *error)
{
	if (map->target.texture != 0)
		return true;
	map->shared = true;
	if (depth_map_init(map, gpu, (uint32_t)size, DEPTH_MAP_NEAREST, true, error))
		return true;
	depth_map_finish(map, gpu);
	return false;
}

void depth_map_finish(struct depth_map *map, struct gpu *gpu)
{
	object_watch_finish(&map->watch);
	gl_delete_sampler(&gpu->gl, &map->compare);
	target_finish(&map->plain, &gpu->gl);
	target_finish(&map->target, &gpu->gl);
}

void depth_map_list_memory(const struct depth_map *map, const struct memory_list *list)
{
	object_watch_list_memory(&map->watch, list);
}

static bool is_caster(const struct object *object)
{
	return object->casts;
}

static bool is_receiver_only(const struct object *object)
{
	return object->receives && !object->casts;
}

static bool has_content(const struct object *object, enum depth_map_content content)
{
	return content == DEPTH_OF_CASTERS ? is_caster(object) : is_receiver_only(object);
}

bool depth_map_has_content(const struct sm_scene *scene, enum depth_map_content content)
{
	for (size_t i = 0; i < scene->object_count; i++)
		if (has_content(&scene->objects[i], content))
			return true;
	return false;
}

static bool touches(const struct depth_map_redraw *redraw, const struct watched_object *object)
{
	struct screen_box box = disc_box_from(&object->box, redraw->point);
	return screen_box_touches(&box, &redraw->reach);
}

bool depth_map_is_drawn(struct gpu *gpu, const struct sm_scene *scene, size_t index,
	const struct light_frame *frame, const struct depth_map_redraw *redraw)
{
	const struct object *object = &scene->objects[index];
	if (redraw != NULL && redraw->watch->objects[index].left_out)
		return false;
	if (redraw != NULL && skip_take(&gpu->skips, SKIP_STATIC,
				      !touches(redraw, &redraw->watch->objects[index])))
		return false;
	return !skip_take(&gpu->skips, SKIP_CASTER,
		mesh_misses_screen(&scene->meshes[object->mesh], (vec4 *)object->transform,
			(vec4 *)frame->world_to_clip, 0.0f, true));
}

static void draw_objects(struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, enum depth_map_content content,
	const struct depth_map_redraw *redraw, const struct program *program)
{
	struct gl *gl = &gpu->gl;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (!has_content(object, content) ||
			!depth_map_is_drawn(gpu, scene, i, frame, redraw))
			continue;
		mat4 to_clip;
		glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
		gl->UniformMatrix4fv(program->uniform.object_to_clip, 1, GL_FALSE, to_clip[0]);
		gpu_set_faces(gpu, &scene->meshes[object->mesh], (vec4 *)object->transform, to_clip,
			false);
		gpu_draw_caster(gpu, &gpu->scene.meshes[object->mesh]);
	}
	gl->Disable(GL_CULL_FACE);
}

/* As to_plain() of common_plain_depth.glsl has these depths. */
static void clear(struct gl *gl, float depth, uint64_t write)
{
	GLfloat color[4] = {write & FLAG_DEPTH_HALF ? 2.0f * depth - 1.0f : depth, 0, 0, 1};
	if (write & FLAG_DEPTH_PACKED) {
		uint32_t bits;
		memcpy(&bits, &depth, sizeof(bits));
		for (int byte = 0; byte < 4; byte++)
			color[byte] = (float)(bits >> (8 * byte) & 0xff) / 255.0f;
	}
	gl->DepthMask(GL_TRUE);
	gl->ClearBufferfv(GL_DEPTH, 0, &depth);
	if (write != 0)
		gl->ClearBufferfv(GL_COLOR, 0, color);
}

static bool fill(struct gpu *gpu, const struct sm_scene *scene, const struct light_frame *frame,
	enum depth_map_content content, uint64_t write, struct target_area area,
	const struct depth_map_redraw *redraw, struct sm_error *error)
{
	struct gl *gl = &gpu->gl;
	struct program_key key = {PROGRAM_DEPTH_MAP, write};
	bool farthest = content == DEPTH_OF_FARTHEST_RECEIVERS;
	clear(gl, farthest ? 0.0f : 1.0f, write);
	const struct program *program = program_use(&gpu->programs, gl, key, error);
	if (program == NULL)
		return false;
	gl->Uniform1f(program->uniform.near_to_far, frame->near_to_far);
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(farthest ? GL_GREATER : GL_LESS);
	target_restrict(area, gl);
	/* Which would not leave alone the bits of a float. */
	gl->Disable(GL_DITHER);
	draw_objects(gpu, scene, frame, content, redraw, program);
	gl->Enable(GL_DITHER);
	gl->Disable(GL_SCISSOR_TEST);
	return true;
}

void depth_map_forget(struct depth_map *map)
{
	map->cleared = false;
	object_watch_forget(&map->watch);
}

/* redraw: NULL: all that may be there. */
static bool draw_part(struct depth_map *map, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, enum depth_map_content content,
	const struct screen_box *part, const struct depth_map_redraw *redraw,
	struct sm_error *error)
{
	target_restrict_clear(&map->target, part, &gpu->gl);
	return fill(gpu, scene, frame, content, map->write, target_part(&map->target, part), redraw,
		error);
}

bool depth_map_draw_part(struct depth_map *map, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, enum depth_map_content content,
	const struct screen_box *part, struct sm_error *error)
{
	gl_push_group(&gpu->gl, "receiver map");
	bind_target(map, &gpu->gl, 0);
	bool drawn = draw_part(map, gpu, scene, frame, content, part, NULL, error);
	gl_pop_group(&gpu->gl);
	return drawn;
}

/* The largest part of a target that is cleared alone where all may be: a driver may draw it, which
 * costs more for each texel. With llvmpipe a sixth costs as much as all. */
#define PART_SHARE_MAX 0.125f

static float share_of(const struct screen_box *part)
{
	float share = 0.25f; /* NDC are 2 wide */
	for (int axis = 0; axis < 2; axis++)
		share *= fmaxf(fminf(part->max[axis], 1.0f) - fmaxf(part->min[axis], -1.0f), 0.0f);
	return share;
}

void depth_map_narrow(struct screen_box *part, const struct screen_box *held)
{
	if (!screen_box_is_all(part) || share_of(held) <= PART_SHARE_MAX)
		screen_box_cut(part, held);
}

/* Where its casters are. */
static struct disc_box find_held(const struct depth_map *map)
{
	struct disc_box held = disc_box_none();
	for (size_t i = 0; i < map->watch.count; i++) {
		const struct watched_object *object = &map->watch.objects[i];
		if (object->shown && !object->left_out)
			disc_box_add(&held, &object->box);
	}
	return held;
}

/* A map alone is of that. */
static const struct disc middle = {.count = 1};

struct screen_box depth_map_held(const struct depth_map *map)
{
	return disc_box_from(&map->held, middle.points[0]);
}

/* Where a layer has changed, which is what a point of the light's disc sees. */
static struct screen_box find_changed(const struct depth_map *map, const float point[2])
{
	struct screen_box changed = disc_box_from(&map->moved, point);
	struct screen_box held = disc_box_from(&map->held, point);
	struct screen_box before = disc_box_from(&map->before, point);
	screen_box_add(&held, &before);
	depth_map_narrow(&changed, &held);
	return changed;
}

/* Finds what has changed of the map. */
static bool look(struct depth_map *map, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	if (!object_watch_look(&map->watch, scene, frame, is_caster, &map->moved))
		return error_no_memory(error);
	map->before = map->cleared ? map->held : disc_box_all();
	map->held = find_held(map);
	map->cleared = true;
	map->changed = find_changed(map, middle.points[0]);
	return true;
}

/* frame: of the point. */
static bool draw_layer(struct depth_map *map, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const float point[2], GLint layer, struct sm_error *error)
{
	const struct screen_box changed = find_changed(map, point);
	const struct depth_map_redraw redraw = {
		&map->watch, target_part_reach(&map->target, &changed), {point[0], point[1]}};
	bind_target(map, &gpu->gl, layer);
	return draw_part(map, gpu, scene, frame, DEPTH_OF_CASTERS, &changed, &redraw, error);
}

static bool draw_layers(struct depth_map *map, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	const struct disc *disc = map->disc != NULL ? map->disc : &middle;
	bool drawn = true;
	gl_push_group(&gpu->gl, map->disc != NULL ? "shadow maps" : "shadow map");
	for (GLint i = 0; i < disc->count && drawn; i++) {
		struct light_frame sheared = disc_frame(frame, disc->points[i]);
		drawn = draw_layer(map, gpu, scene, &sheared, disc->points[i], i, error);
	}
	gl_pop_group(&gpu->gl);
	return drawn;
}

bool depth_map_draw(struct depth_map *map, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	if (gpu->skips.off[SKIP_STATIC] || map->failures != gpu->failures)
		depth_map_forget(map);
	map->failures = gpu->failures;
	if (!look(map, scene, frame, error))
		return false;
	/* Then nothing has on any layer. */
	if (screen_box_is_none(&map->changed))
		return true;
	bool drawn = draw_layers(map, gpu, scene, frame, error);
	if (!drawn)
		depth_map_forget(map);
	return drawn;
}

bool depth_map_look_at_receivers(struct object_watch *watch, const struct sm_scene *scene,
	const struct light_frame *frame, struct screen_box *changed, struct sm_error *error)
{
	struct disc_box part;
	if (!object_watch_look(watch, scene, frame, is_receiver_only, &part))
		return error_no_memory(error);
	screen_box_add(changed, &part.box);
	return true;
}

/* How light space becomes window coordinates: w = z, x, y / (2 extent w), K (1 - near / w) for a
 * spot; w = 1, x, y / (2 extent), (z - near) / (far - near) for a directional light. */
static void set_screen(
	struct gpu *gpu, const struct light_frame *frame, const struct program *program)
{
	struct gl *gl = &gpu->gl;
	gl->Uniform1f(program->uniform.screen_scale, 0.5f / frame->half_extent);
	if (frame->parallel) {
		float per_unit = 1.0f / (frame->far - frame->near); /* far > near */
		gl->Uniform3f(program->uniform.screen_w, 0.0f, 1.0f, 1.0f);
		gl->Uniform3f(
			program->uniform.screen_depth, -frame->near * per_unit, 0.0f, per_unit);
	} else {
		gl->Uniform3f(program->uniform.screen_w, 1.0f, 0.0f, frame->near * LEAST_W);
		gl->Uniform3f(program->uniform.screen_depth, frame->pole,
			-frame->pole * frame->near, 0.0f);
	}
}

void depth_map_set_receiver(struct gpu *gpu, GLsizei texels, enum depth_map_filter filter,
	const struct light_frame *frame, const struct program *program)
{
	float size = (float)texels, limit[2];
	gpu->gl.Uniform2f(program->uniform.map_size, size, 1.0f / size);
	gpu->gl.Uniform1f(program->uniform.lookup_reach, filters[filter].texels_around / size);
	gpu->gl.Uniform1f(program->uniform.near_to_far, frame->near_to_far);
	set_screen(gpu, frame, program);
	light_frame_bias_limit(frame, size, limit);
	gpu->gl.Uniform2f(program->uniform.bias_limit, limit[0], limit[1]);
}

static void bind_textures(const struct depth_map *map, struct gpu *gpu)
{
	GLuint compared = map->target.texture, plain = depth_map_plain_texture(map);
	if (map->disc == NULL) {
		gpu_bind_texture(gpu, UNIT_DEPTH_COMPARE, compared);
		gpu_bind_texture(gpu, UNIT_DEPTH, plain);
		gpu->gl.BindSampler(UNIT_DEPTH_COMPARE, map->compare);
	} else {
		gpu_bind_layers(gpu, UNIT_DEPTH_LAYERS, compared);
		gpu_bind_layers(gpu, UNIT_PLAIN_LAYERS, plain);
		gpu->gl.BindSampler(UNIT_DEPTH_LAYERS, map->compare);
	}
}

void depth_map_bind(const struct depth_map *map, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	bind_textures(map, gpu);
	depth_map_set_receiver(gpu, map->target.size, map->filter, frame, program);
	if (map->disc != NULL)
		disc_bind(map->disc, gpu, frame, program);
}
