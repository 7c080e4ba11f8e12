/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"

struct hard {
	struct depth_map map;
};

static bool hard_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct hard *hard = state;
	return depth_map_init(&hard->map, gpu, options->map_size, DEPTH_MAP_NEAREST, false, error);
}

static void hard_finish(void *state, struct gpu *gpu)
{
	struct hard *hard = state;
	depth_map_finish(&hard->map, gpu);
}

static bool hard_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct hard *hard = state;
	return depth_map_draw(&hard->map, gpu, scene, frame, error);
}

static uint64_t hard_surface_flags(const void *state)
{
	(void)state;
	return FLAG_HARD;
}

static struct object_watch *hard_casters(void *state, const struct light_frame *frame, float *reach)
{
	(void)frame;
	struct hard *hard = state;
	*reach = 0.0f;
	return &hard->map.watch;
}

static void hard_list_memory(const void *state, const struct memory_list *list)
{
	const struct hard *hard = state;
	depth_map_list_memory(&hard->map, list);
}

static void hard_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct hard *hard = state;
	depth_map_bind(&hard->map, gpu, frame, program);
}

const struct technique technique_hard = {
	.name = "hard",
	.summary = "an ordinary shadow map (Williams 1978), compared at the nearest texel",
	.state_size = sizeof(struct hard),
	.init = hard_init,
	.finish = hard_finish,
	.prepare = hard_prepare,
	.surface_flags = hard_surface_flags,
	.texels_around = LOOKUP_REACH_NEAREST,
	.casters = hard_casters,
	.list_memory = hard_list_memory,
	.bind = hard_bind,
};
