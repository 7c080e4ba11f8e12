/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "scene/penumbra.h"
#include "technique/technique.h"
#include <stdlib.h>

enum pick { PICK_HARD, PICK_SOFT, PICKS };

static const struct technique *const picks[PICKS] = {
	[PICK_HARD] = &technique_hard, [PICK_SOFT] = &technique_gather};

/* Frames after which the one that is not drawn gives its memory back: what comes and goes, or
 * wavers, does so in less, and making it anew takes a frame. */
#define IDLE_FRAMES_MAX 600

/* One of two techniques, whichever shows the light's radius at less cost. */
struct choice {
	struct sm_shadow_options options;
	void *states[PICKS]; /* owned; NULL: not in use */
	enum pick pick;      /* that the last frame was drawn with */
	uint32_t idle;       /* frames since the other one was */
	uint64_t scene;      /* that the last frame was of; 0: it does not count */
};

static bool auto_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	(void)gpu;
	(void)error;
	struct choice *choice = state;
	choice->options = *options;
	return true;
}

static void give_back(struct choice *choice, struct gpu *gpu, enum pick pick)
{
	if (choice->states[pick] != NULL)
		picks[pick]->finish(choice->states[pick], gpu);
	free(choice->states[pick]);
	choice->states[pick] = NULL;
}

static void auto_finish(void *state, struct gpu *gpu)
{
	for (enum pick pick = 0; pick < PICKS; pick++)
		give_back(state, gpu, pick);
}

static bool take(struct choice *choice, struct gpu *gpu, enum pick pick, struct sm_error *error)
{
	if (choice->states[pick] != NULL)
		return true;
	choice->states[pick] = calloc(1, picks[pick]->state_size);
	if (choice->states[pick] == NULL)
		return error_no_memory(error);
	if (picks[pick]->init(choice->states[pick], gpu, &choice->options, error))
		return true;
	give_back(choice, gpu, pick);
	return false;
}

static bool auto_choose(
	void *state, struct gpu *gpu, const struct sm_scene *scene, const struct light_frame *frame)
{
	struct choice *choice = state;
	float texels = penumbra_texels(scene, frame, choice->options.map_size);
	/* What another scene had does not count in this one. */
	bool shown = choice->pick == PICK_SOFT && choice->scene == scene->id;
	enum pick pick = penumbra_shows(texels, shown) ? PICK_SOFT : PICK_HARD;
	bool changed = pick != choice->pick;
	choice->idle = changed ? 0 : choice->idle + 1;
	choice->pick = pick;
	choice->scene = scene->id;
	if (choice->idle == IDLE_FRAMES_MAX)
		give_back(choice, gpu, pick == PICK_HARD ? PICK_SOFT : PICK_HARD);
	gpu->stats.hard_lights += pick == PICK_HARD;
	return changed;
}

static void auto_leave(void *state)
{
	struct choice *choice = state;
	choice->scene = 0;
	for (enum pick pick = 0; pick < PICKS; pick++)
		if (choice->states[pick] != NULL && picks[pick]->leave != NULL)
			picks[pick]->leave(choice->states[pick]);
}

static bool auto_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct choice *choice = state;
	return take(choice, gpu, choice->pick, error) &&
	       picks[choice->pick]->prepare(choice->states[choice->pick], gpu, scene, frame, error);
}

static uint64_t auto_surface_flags(const void *state)
{
	const struct choice *choice = state;
	return picks[choice->pick]->surface_flags(choice->states[choice->pick]);
}

static const struct screen_grid *auto_soft_grid(const void *state)
{
	const struct choice *choice = state;
	const struct technique *technique = picks[choice->pick];
	return technique->soft_grid != NULL ? technique->soft_grid(choice->states[choice->pick])
					    : NULL;
}

static const float *auto_farthest(const void *state)
{
	const struct choice *choice = state;
	const struct technique *technique = picks[choice->pick];
	return technique->farthest != NULL ? technique->farthest(choice->states[choice->pick])
					   : NULL;
}

static enum sm_sampling auto_sampling(void *state, const struct sm_scene *scene,
	const struct light_frame *frame, const struct technique_view *view)
{
	struct choice *choice = state;
	const struct technique *technique = picks[choice->pick];
	return technique->sampling != NULL
		       ? technique->sampling(choice->states[choice->pick], scene, frame, view)
		       : SM_SAMPLING_DENSE;
}

static struct object_watch *auto_casters(void *state, const struct light_frame *frame, float *reach)
{
	struct choice *choice = state;
	void *picked = choice->states[choice->pick];
	return picked != NULL ? picks[choice->pick]->casters(picked, frame, reach) : NULL;
}

static void auto_list_memory(const void *state, const struct memory_list *list)
{
	const struct choice *choice = state;
	for (enum pick pick = 0; pick < PICKS; pick++) {
		if (choice->states[pick] == NULL)
			continue;
		memory_list_processor(list, "states of techniques", picks[pick]->state_size);
		if (picks[pick]->list_memory != NULL)
			picks[pick]->list_memory(choice->states[pick], list);
	}
}

static void auto_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct choice *choice = state;
	picks[choice->pick]->bind(choice->states[choice->pick], gpu, frame, program);
}

const struct technique technique_auto = {
	.name = "auto",
	.summary = "gather where a penumbra is wider than a texel of the map, else hard: for each "
		   "light and frame",
	.options = OPTION_SAMPLING,
	.state_size = sizeof(struct choice),
	.reads_receivers = true,
	.init = auto_init,
	.finish = auto_finish,
	.choose = auto_choose,
	.leave = auto_leave,
	.prepare = auto_prepare,
	.surface_flags = auto_surface_flags,
	.soft_grid = auto_soft_grid,
	.needs_parts = true,
	.farthest = auto_farthest,
	.soft_is_all = true,
	.sampling = auto_sampling,
	.fits_screen = true,
	.casters = auto_casters,
	.list_memory = auto_list_memory,
	.bind = auto_bind,
};
