/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "deferred_pass.h"
#include "gles/probe.h"
#include "scene/camera.h"
#include "scene/light_reach.h"
#include "sparse_pass.h"
#include "surface_parts.h"
#include <float.h>
#include <string.h>

static float encode_srgb(float c)
{
	return c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1.0f / 2.4f) - 0.055f;
}

static void clear(struct gl *gl, const struct sm_scene *scene, uint64_t flags)
{
	GLfloat color[4] = {1.0f, 1.0f, 1.0f, 1.0f};
	for (int i = 0; i < 3 && !(flags & FLAG_VISIBILITY); i++) {
		float c = scene->environment.background[i];
		color[i] = flags & FLAG_ENCODE_SRGB ? encode_srgb(c) : c;
	}
	/* 65535 as high and low byte: lit. */
	if (flags & FLAG_VISIBILITY)
		color[2] = 0.0f;
	gl->DepthMask(GL_TRUE);
	gl->ClearBufferfv(GL_COLOR, 0, color);
	gl->ClearBufferfv(GL_DEPTH, 0, &(GLfloat){1.0f});
}

static void set_pass_state(struct gl *gl, bool first)
{
	gl->Enable(GL_DEPTH_TEST);
	gl->DepthFunc(first ? GL_LESS : GL_EQUAL);
	gl->DepthMask(first);
	if (first) {
		gl->Disable(GL_BLEND);
	} else {
		gl->Enable(GL_BLEND);
		gl->BlendFunc(GL_ONE, GL_ONE);
	}
}

static void choose_light(struct surface_pass *pass, uint32_t index, struct shadowed_light *light)
{
	/* Whose space is that of the surfaces even so: rounding is the same then. */
	pass->light = light->left_out ? NULL : &pass->scene->lights[index].desc;
	pass->frame = &light->frame;
	pass->shadow = light->left_out ? NULL : light->shadow;
	pass->cells = light->sampling == SM_SAMPLING_SPARSE ? &light->cells : NULL;
	pass->found = sampling_is_deferred(light->sampling) ? &light->found : NULL;
}

static bool is_same(const struct points_key *a, const struct points_key *b)
{
	return light_key_is_same(&a->light, &b->light) &&
	       objects_age_is_same(&a->objects, &b->objects) &&
	       view_key_is_same(&a->view, &b->view) && a->sampling == b->sampling &&
	       a->whole == b->whole;
}

/* Whether the receivers there are, of whatever light, are at the depths of those that are wanted,
 * if any are. */
static bool has_receivers(const struct sm_renderer *renderer, const struct points_key *key)
{
	const struct points_key *received = &renderer->received;
	return !sampling_is_deferred(key->sampling) ||
	       (received->light.scene == key->light.scene &&
		       memcmp(received->light.anchor, key->light.anchor, sizeof(vec3)) == 0 &&
		       objects_age_is_same(&received->objects, &key->objects) &&
		       view_key_is_same(&received->view, &key->view));
}

static void choose_sampling(const struct surface_pass *view, struct shadowed_light *light,
	const struct technique_view *seen)
{
	struct sm_renderer *renderer = view->renderer;
	struct sm_frame_stats *stats = &renderer->gpu.stats;
	const struct technique *technique = renderer->shadows.technique;
	light->sampling = technique->sampling != NULL ? technique->sampling(light->shadow->state,
								view->scene, &light->frame, seen)
						      : SM_SAMPLING_DENSE;
	stats->sparse_lights += sampling_is_sparse(light->sampling);
	stats->deferred_lights += sampling_is_deferred(light->sampling);
}

/* What is known of a light's visibility before its surfaces are drawn. That of an earlier frame
 * serves where it would be the same. */
static bool draw_visibility(const struct surface_pass *view, uint32_t index,
	struct shadowed_light *light, const struct technique_view *seen, struct sm_error *error)
{
	struct sm_renderer *renderer = view->renderer;
	struct surface_pass pass = *view;
	choose_sampling(view, light, seen);
	if (light->sampling == SM_SAMPLING_DENSE)
		return true;
	const struct points_key key = {
		.light = light->shadow->key,
		.objects = objects_age(view->scene, false),
		.view = view_key_of(seen),
		.sampling = light->sampling,
		.whole = renderer->whole || renderer->gpu.skips.off[SKIP_RECEIVER],
	};
	bool same = is_same(&light->points, &key) && has_receivers(renderer, &key);
	if (skip_take(&renderer->gpu.skips, SKIP_POINTS, same))
		return true;
	light->points = (struct points_key){0};
	choose_light(&pass, index, light);
	pass.first = index == view->lead;
	pass.cells = pass.found = NULL;
	bool drawn = light->sampling == SM_SAMPLING_SPARSE
			     ? sparse_pass_draw(&pass, light, error)
			     : deferred_pass_draw(&pass, light, error);
	if (drawn)
		light->points = key;
	if (drawn && sampling_is_deferred(light->sampling))
		renderer->received = key;
	return drawn;
}

/* Of 8 bits, where light is added up as sRGB: what is less than half a step changes no pixel, and
 * drivers round a step's place by less than a quarter of one. */
#define GREY_STEP (1.0f / (255.0f * 12.92f))
#define DIM_MAX (GREY_STEP / 4.0f)

/* A light is left out where it shows nothing; the lead light, which is added to the ambient light
 * before the sum is rounded, only where it reaches nothing. */
static void find_left_out(const struct surface_pass *pass, struct shadowed_light *light, bool lead)
{
	struct skips *skips = &pass->renderer->gpu.skips;
	float limit = lead ? FLT_MIN : DIM_MAX;
	light->shows = light->brightest >= limit;
	light->left_out = skip_take(skips, SKIP_VIEW, light->brightest == 0.0f);
	if (!lead && light->brightest > 0.0f && skip_take(skips, SKIP_DIM, !light->shows))
		light->left_out = true;
}

static void find_frame(
	const struct surface_pass *pass, uint32_t index, struct shadowed_light *light)
{
	const struct technique *technique = pass->renderer->shadows.technique;
	(technique->fits_screen ? light_frame_fit : light_frame_init)(
		&light->frame, &pass->scene->lights[index].desc, pass->scene);
}

/* Finds what all lights show, whatever is skipped. The lead is the first that shows anything, so
 * that the surfaces are drawn once where no other does. Returns how many show. */
static uint32_t find_lights(struct surface_pass *pass, uint32_t count)
{
	struct shadowed_light *lights = pass->renderer->lights;
	struct view_volume volume;
	uint32_t shown = 0;
	view_volume_init(&volume, pass->world_to_clip);
	pass->lead = count;
	for (uint32_t i = 0; i < count; i++) {
		find_frame(pass, i, &lights[i]);
		lights[i].brightest = light_brightest(&pass->scene->lights[i].desc,
			&lights[i].frame, pass->scene, &volume, DIM_MAX);
		if (pass->lead == count && lights[i].brightest >= DIM_MAX)
			pass->lead = i;
	}
	if (pass->lead == count)
		pass->lead = 0;
	for (uint32_t i = 0; i < count; i++) {
		find_left_out(pass, &lights[i], i == pass->lead);
		shown += lights[i].shows;
	}
	return shown;
}

/* The one whose visibility is the picture. */
static void find_only_light(struct surface_pass *pass, uint32_t index)
{
	struct shadowed_light *light = &pass->renderer->lights[0];
	find_frame(pass, index, light);
	light->shows = true;
	light->left_out = false;
	pass->lead = index;
}

/* The light's shadow, in the shadow set and, where that is how it is sampled, in the view. */
static bool draw_shadow(const struct surface_pass *pass, uint32_t first, uint32_t index,
	const struct technique_view *view, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	struct shadowed_light *light = &renderer->lights[index - first];
	const struct shadow_request request = {.local = &renderer->local,
		.index = index - first,
		.frame = &light->frame,
		.view = view};
	light->shadow = shadow_set_prepare(&renderer->shadows, &renderer->gpu, &request, error);
	if (light->shadow == NULL)
		return false;
	renderer->gpu.stats.lights++;
	return draw_visibility(pass, index, light, view, error);
}

static size_t count_triangles(const struct sm_scene *scene)
{
	size_t count = 0;
	for (size_t i = 0; i < scene->object_count; i++)
		count += scene->meshes[scene->objects[i].mesh].index_count / 3;
	return count;
}

static bool reserve_lights(struct sm_renderer *renderer, uint32_t count)
{
	size_t known = renderer->light_capacity;
	if (!array_reserve((void **)&renderer->lights, &renderer->light_capacity, count,
		    sizeof(*renderer->lights)))
		return false;
	if (known < renderer->light_capacity)
		memset(renderer->lights + known, 0,
			(renderer->light_capacity - known) * sizeof(*renderer->lights));
	return true;
}

/* Shadow maps of lights first .. last - 1, into renderer->lights. */
static bool draw_shadows(
	const struct surface_pass *pass, uint32_t first, uint32_t last, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	const struct technique_view view = {.world_to_clip = pass->world_to_clip,
		.width = pass->width,
		.height = pass->height,
		.visibility = pass->flags & FLAG_VISIBILITY,
		.multisampled = pass->multisampled,
		/* Found out on first use, by drawing, before there is any state. */
		.deferrable = gpu_has(&renderer->gpu, CAP_DEPTH_FETCH),
		.triangles = count_triangles(pass->scene)};
	for (uint32_t i = first; i < last; i++) {
		struct shadowed_light *light = &renderer->lights[i - first];
		if (pass->alone)
			shadow_set_leave(&renderer->shadows, i - first);
		if (!light->left_out && !draw_shadow(pass, first, i, &view, error))
			return false;
		/* Left out or not, so that the choices after are the same. */
		if (!light->shows)
			shadow_set_leave(&renderer->shadows, i - first);
	}
	return true;
}

/* Adds one light to the picture. */
static bool draw_light(
	struct surface_pass *pass, uint32_t first, uint32_t index, struct sm_error *error)
{
	struct shadowed_light *light = &pass->renderer->lights[index - first];
	if (light->left_out && !pass->first)
		return true;
	choose_light(pass, index, light);
	if (!surface_pass_draw(pass, error))
		return false;
	pass->first = false;
	set_pass_state(&pass->renderer->gpu.gl, false);
	return true;
}

/* Shadow maps of lights first .. last - 1, then their surfaces, one light after the other. The
 * maps come first so that a tiled GPU need not store and load the picture between two lights. */
static bool draw_lights(struct surface_pass *pass, uint32_t first, uint32_t last,
	GLuint framebuffer, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	struct gl *gl = &renderer->gpu.gl;
	GLint samples = 0;
	gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	gl->GetIntegerv(GL_SAMPLES, &samples);
	pass->multisampled = samples > 1;
	if (!draw_shadows(pass, first, last, error))
		return false;
	surface_parts_find_ways(pass);
	gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	gl->Viewport(0, 0, (GLsizei)pass->width, (GLsizei)pass->height);
	if (pass->flags & FLAG_VISIBILITY && renderer->shadows.technique->show != NULL)
		return renderer->shadows.technique->show(
			renderer->lights[0].shadow->state, &renderer->gpu, error);
	gl_finish_passes(gl);
	clear(gl, pass->scene, pass->flags);
	pass->first = true;
	set_pass_state(gl, true);
	if (first == last)
		return surface_pass_draw(pass, error);
	bool drawn = draw_light(pass, first, pass->lead, error);
	for (uint32_t i = first; i < last && drawn; i++)
		drawn = i == pass->lead || draw_light(pass, first, i, error);
	return drawn;
}

static bool check_view(const struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_view *view, struct sm_error *error)
{
	const GLint *limit = renderer->gpu.caps.max_viewport;
	if (view->width == 0 || view->height == 0 || view->width > (uint32_t)limit[0] ||
		view->height > (uint32_t)limit[1])
		return error_set(error, SM_ERROR_INPUT,
			"a picture of %ux%u pixels; this driver draws from 1x1 to %dx%d",
			view->width, view->height, limit[0], limit[1]);
	const struct sm_shadow_options *options = &renderer->shadows.options;
	bool exact = options->precision != SM_PRECISION_FLOAT;
	if (exact && (view->width > SM_EXACT_SIZE_MAX || view->height > SM_EXACT_SIZE_MAX))
		return error_set(error, SM_ERROR_INPUT,
			"a picture of %ux%u pixels; with the precision \"%s\" it has at most %dx%d",
			view->width, view->height,
			sm_precision_name((size_t)options->precision - 1), SM_EXACT_SIZE_MAX,
			SM_EXACT_SIZE_MAX);
	if (view->visibility_of != SM_NONE && view->visibility_of >= scene->light_count)
		return error_set(error, SM_ERROR_INPUT, "no light %u to show; the scene has %zu",
			view->visibility_of, scene->light_count);
	return true;
}

/* Copies it, sRGB-encoded, into the framebuffer that is bound. */
static bool copy_accumulator(struct sm_renderer *renderer, struct sm_error *error)
{
	struct gpu *gpu = &renderer->gpu;
	struct program_key key = {.kind = PROGRAM_COPY};
	if (program_use(&gpu->programs, &gpu->gl, key, error) == NULL)
		return false;
	gpu_fill_viewport(gpu, renderer->accumulator.color);
	return true;
}

/* Adding lights up takes linear light, which blending has on sRGB framebuffers alone. */
static bool draw_by_accumulator(
	struct surface_pass *pass, const struct sm_view *view, struct sm_error *error)
{
	struct gpu *gpu = &pass->renderer->gpu;
	struct picture *accumulator = &pass->renderer->accumulator;
	pass->flags = 0;
	if (!picture_resize(accumulator, &gpu->gl, STORAGE_ACCUMULATOR, view->width, view->height,
		    GL_SRGB8_ALPHA8, error) ||
		!draw_lights(pass, 0, (uint32_t)pass->scene->light_count, accumulator->framebuffer,
			error))
		return false;
	gpu->gl.BindFramebuffer(GL_FRAMEBUFFER, view->framebuffer);
	return copy_accumulator(pass->renderer, error);
}

static bool draw_view(struct surface_pass *pass, const struct sm_view *view, struct sm_error *error)
{
	struct sm_renderer *renderer = pass->renderer;
	struct gpu *gpu = &renderer->gpu;
	struct gl *gl = &gpu->gl;
	uint32_t light_count = (uint32_t)pass->scene->light_count, light = view->visibility_of;
	if (!reserve_lights(renderer, light_count))
		return error_no_memory(error);
	if (!gpu_scene_update(&gpu->scene, gl, pass->scene, &gpu->stats.uploaded_bytes, error))
		return false;
	if (!draw_order_find(&renderer->order, pass->scene, pass->world_to_clip))
		return error_no_memory(error);
	gl->BindFramebuffer(GL_FRAMEBUFFER, view->framebuffer);
	if (light != SM_NONE) {
		pass->flags = FLAG_VISIBILITY;
		find_only_light(pass, light);
		return draw_lights(pass, light, light + 1, view->framebuffer, error);
	}
	uint32_t shown = find_lights(pass, light_count);
	if (!gl_framebuffer_is_srgb(gl, view->framebuffer))
		pass->flags = FLAG_ENCODE_SRGB;
	if (pass->flags & FLAG_ENCODE_SRGB && shown > 1)
		return draw_by_accumulator(pass, view, error);
	return draw_lights(pass, 0, light_count, view->framebuffer, error);
}

bool frame_draw(struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_view *view, struct sm_error *error)
{
	struct gl *gl = &renderer->gpu.gl;
	struct local_scene *local = &renderer->local;
	mat4 world_to_clip;
	if (!check_view(renderer, scene, view, error) ||
		!local_scene_find(local, scene, &view->camera, error) ||
		!camera_world_to_clip(&local->camera, local->scene, view->width, view->height,
			world_to_clip, error))
		return false;
	struct surface_pass pass = {.renderer = renderer,
		.scene = local->scene,
		.world_to_clip = world_to_clip,
		.width = view->width,
		.height = view->height,
		.alone = view->alone};
	bool drawn = draw_view(&pass, view, error);
	sparse_pass_end_frame(renderer);
	deferred_pass_end_frame(renderer);
	for (size_t i = 0; i < renderer->light_capacity; i++)
		renderer->lights[i].sampling = SM_SAMPLING_DENSE;
	/* A failure may have been anywhere. */
	gpu_restore_state(&renderer->gpu);
	gl->BindFramebuffer(GL_FRAMEBUFFER, view->framebuffer);
	gl->Viewport(0, 0, (GLsizei)view->width, (GLsizei)view->height);
	return drawn;
}
