/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"

/* Heckbert & Herf 1997, Agrawala et al. 2000: in their plain form. The layers are many times a
 * shadow map's memory. OpenGL ES 3.0 has at least 256 of them. */
struct maps {
	struct disc disc;
	struct depth_map map;
	uint64_t surface_flags;
};

static bool maps_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct maps *maps = state;
	struct depth_ways ways;
	if (!depth_ways_choose(&ways, gpu, error))
		return false;
	disc_init(&maps->disc, options->samples);
	maps->surface_flags = FLAG_MAPS | ways.compare;
	return depth_map_init_layers(&maps->map, gpu, options->map_size, &maps->disc,
		DEPTH_MAP_LINEAR, ways.compares_plainly, error);
}

static void maps_finish(void *state, struct gpu *gpu)
{
	struct maps *maps = state;
	depth_map_finish(&maps->map, gpu);
}

static bool maps_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct maps *maps = state;
	return depth_map_draw(&maps->map, gpu, scene, frame, error);
}

static uint64_t maps_surface_flags(const void *state)
{
	const struct maps *maps = state;
	return maps->surface_flags;
}

/* From the near plane to the far one. */
static float maps_reach(const void *state, const struct light_frame *frame)
{
	(void)state;
	return 2.0f * disc_scale(frame);
}

static struct object_watch *maps_casters(void *state, const struct light_frame *frame, float *reach)
{
	struct maps *maps = state;
	*reach = maps_reach(state, frame);
	return &maps->map.watch;
}

static void maps_list_memory(const void *state, const struct memory_list *list)
{
	const struct maps *maps = state;
	depth_map_list_memory(&maps->map, list);
}

static void maps_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct maps *maps = state;
	depth_map_bind(&maps->map, gpu, frame, program);
}

const struct technique technique_maps = {
	.name = "maps",
	.summary = "shadow maps of many points of the light, averaged (Heckbert & Herf 1997)",
	.samples = {16, 4, 64},
	.state_size = sizeof(struct maps),
	.init = maps_init,
	.finish = maps_finish,
	.prepare = maps_prepare,
	.surface_flags = maps_surface_flags,
	.reach = maps_reach,
	.casters = maps_casters,
	.list_memory = maps_list_memory,
	.bind = maps_bind,
};
