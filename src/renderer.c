/* SPDX-License-Identifier: MIT */
#include "renderer.h"
#include "base/log.h"
#include "deferred_pass.h"
#include "gles/probe.h"
#include "sparse_pass.h"
#include <stdlib.h>
#include <string.h>

struct sm_renderer *sm_renderer_create(sm_get_proc get_proc, struct sm_error *error)
{
	static const struct sm_driver_options all;
	return sm_renderer_create_with(get_proc, &all, error);
}

struct sm_renderer *sm_renderer_create_with(
	sm_get_proc get_proc, const struct sm_driver_options *options, struct sm_error *error)
{
	struct sm_renderer *renderer = calloc(1, sizeof(*renderer));
	if (renderer == NULL) {
		error_no_memory(error);
		return NULL;
	}
	static const struct sm_shadow_options defaults;
	if (gpu_init(&renderer->gpu, get_proc, options, error) &&
		shadow_set_init(&renderer->shadows, &defaults, &renderer->gpu.caps, error))
		return renderer;
	sm_renderer_destroy(renderer);
	return NULL;
}

void sm_renderer_destroy(struct sm_renderer *renderer)
{
	if (renderer == NULL)
		return;
	shadow_set_finish(&renderer->shadows, &renderer->gpu);
	picture_finish(&renderer->accumulator, &renderer->gpu.gl);
	sparse_pass_finish(renderer);
	deferred_pass_finish(renderer);
	if (renderer->gpu.gl.GetError != NULL)
		averted_parts_finish(&renderer->averted, &renderer->gpu.gl);
	gpu_finish(&renderer->gpu);
	local_scene_finish(&renderer->local);
	draw_order_finish(&renderer->order);
	free(renderer->lights);
	free(renderer->needs);
	free(renderer);
}

void sm_renderer_set_program_store(
	struct sm_renderer *renderer, const struct sm_program_store *store)
{
	struct gpu *gpu = &renderer->gpu;
	program_binaries_init(&gpu->programs.binaries, store, &gpu->caps, sm_version());
}

bool sm_renderer_set_shadows(struct sm_renderer *renderer, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct shadow_set set;
	if (!shadow_set_init(&set, options, &renderer->gpu.caps, error))
		return false;
	shadow_set_finish(&renderer->shadows, &renderer->gpu);
	sparse_pass_finish(renderer);
	deferred_pass_finish(renderer);
	renderer->current = (struct frame_key){0};
	renderer->shadows = set;
	return true;
}

const char *sm_technique_name(size_t index)
{
	const struct technique *technique = technique_at(index);
	return technique != NULL ? technique->name : NULL;
}

const char *sm_technique_summary(size_t index)
{
	const struct technique *technique = technique_at(index);
	return technique != NULL ? technique->summary : NULL;
}

const char *sm_need_name(size_t index)
{
	return need_name(index);
}

const char *sm_way_name(size_t need, size_t index)
{
	const struct driver_way *way =
		need < DRIVER_NEEDS ? way_at((enum driver_need)need, index) : NULL;
	return way != NULL ? way->name : NULL;
}

uint32_t sm_technique_samples(size_t index, size_t choice)
{
	const struct technique *technique = technique_at(index);
	return technique != NULL && choice < SAMPLE_CHOICES_MAX ? technique->samples[choice] : 0;
}

const char *sm_precision_name(size_t index)
{
	static const char *const names[] = {"float", "half", "fixed12"};
	return index < sizeof(names) / sizeof(names[0]) ? names[index] : NULL;
}

static bool check_drawn(struct gl *gl, bool drawn, struct sm_error *error)
{
	const char *problem = gl_take_error(gl);
	if (drawn && problem != NULL)
		return error_set(error, SM_ERROR_MACHINE, "drawing failed: %s", problem);
	return drawn;
}

static struct frame_key key_of(const struct sm_scene *scene, const struct sm_view *view)
{
	return (struct frame_key){scene->id, scene->version, *view};
}

static bool is_same_view(const struct sm_view *a, const struct sm_view *b)
{
	/* The camera is floats alone, without padding. */
	return memcmp(&a->camera, &b->camera, sizeof(a->camera)) == 0 &&
	       a->framebuffer == b->framebuffer && a->width == b->width && a->height == b->height &&
	       a->visibility_of == b->visibility_of && a->alone == b->alone;
}

bool sm_renderer_is_current(
	struct sm_renderer *renderer, const struct sm_scene *scene, const struct sm_view *view)
{
	const struct frame_key *current = &renderer->current, key = key_of(scene, view);
	bool same = current->scene == key.scene && current->version == key.version &&
		    is_same_view(&current->view, &key.view);
	return skip_take(&renderer->gpu.skips, SKIP_FRAME, same);
}

/* What was kept for later frames. */
static void forget(struct sm_renderer *renderer)
{
	renderer->gpu.failures++;
	shadow_set_forget(&renderer->shadows);
	for (size_t i = 0; i < renderer->light_capacity; i++)
		renderer->lights[i].points = (struct points_key){0};
}

bool sm_renderer_draw(struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_view *view, struct sm_error *error)
{
	struct gl *gl = &renderer->gpu.gl;
	renderer->gpu.stats = (struct sm_frame_stats){0};
	gl_take_error(gl);
	bool drawn = check_drawn(gl, frame_draw(renderer, scene, view, error), error);
	/* Of what GL refused nobody knows which part is there. */
	if (!drawn)
		forget(renderer);
	renderer->current = drawn ? key_of(scene, view) : (struct frame_key){0};
	return drawn;
}

bool sm_renderer_copy_to_screen(
	struct sm_renderer *renderer, const struct sm_screen *screen, struct sm_error *error)
{
	struct gl *gl = &renderer->gpu.gl;
	gl_take_error(gl);
	return check_drawn(gl, screen_draw(&renderer->gpu, screen, error), error);
}

void sm_renderer_get_stats(const struct sm_renderer *renderer, struct sm_frame_stats *stats)
{
	*stats = renderer->gpu.stats;
	stats->programs_compiled = renderer->gpu.programs.compiled;
	stats->programs_loaded = renderer->gpu.programs.loaded;
}

const char *sm_skip_name(size_t index)
{
	return skip_name(index);
}

const char *sm_skip_summary(size_t index)
{
	return skip_summary(index);
}

bool sm_renderer_set_skips(struct sm_renderer *renderer, const char *skips, struct sm_error *error)
{
	return skips_set(&renderer->gpu.skips, skips, error);
}

void sm_renderer_set_threads(struct sm_renderer *renderer, uint32_t count)
{
	struct workers *workers = &renderer->gpu.workers;
	workers_finish(workers);
	workers->most = count;
}

void sm_renderer_get_skip_stats(
	const struct sm_renderer *renderer, size_t index, struct sm_skip_stats *stats)
{
	*stats = renderer->gpu.skips.stats[index];
}

void sm_renderer_set_pass_observer(
	struct sm_renderer *renderer, const struct sm_pass_observer *observer)
{
	static const struct sm_pass_observer none;
	renderer->gpu.gl.observer = observer != NULL ? *observer : none;
}

void sm_renderer_describe(struct sm_renderer *renderer, sm_fact fact, void *data)
{
	caps_describe(&renderer->gpu.caps, fact, data);
	probe_describe(&renderer->gpu, fact, data);
	ways_describe(&renderer->gpu, fact, data);
	for (size_t i = 0; technique_at(i) != NULL; i++) {
		char key[64], value[200];
		size_t used =
			(size_t)snprintf(value, sizeof(value), "%s", technique_at(i)->summary);
		for (size_t j = 0; sm_technique_samples(i, j) > 0; j++)
			used += (size_t)snprintf(value + used, sizeof(value) - used, "%s%u",
				j == 0 ? "; samples: " : ", ", sm_technique_samples(i, j));
		snprintf(key, sizeof(key), "technique %s", technique_at(i)->name);
		fact(data, key, value);
	}
}

void sm_set_log(sm_log log, void *data)
{
	log_set_sink(log, data);
}

const char *sm_version(void)
{
	return SM_VERSION;
}
