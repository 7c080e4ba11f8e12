/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"
#include "technique/disc.h"

/* Fernando 2005. */
struct pcss {
	struct depth_map map;
	struct disc disc;
	uint64_t surface_flags;
};

static bool pcss_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct pcss *pcss = state;
	struct depth_ways ways;
	if (!depth_ways_choose(&ways, gpu, error))
		return false;
	disc_init(&pcss->disc, options->samples);
	pcss->surface_flags = FLAG_PCSS | ways.plain | ways.compare;
	return depth_map_init(&pcss->map, gpu, options->map_size, DEPTH_MAP_LINEAR, true, error);
}

static void pcss_finish(void *state, struct gpu *gpu)
{
	struct pcss *pcss = state;
	depth_map_finish(&pcss->map, gpu);
}

static bool pcss_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct pcss *pcss = state;
	return depth_map_draw(&pcss->map, gpu, scene, frame, error);
}

static uint64_t pcss_surface_flags(const void *state)
{
	const struct pcss *pcss = state;
	return pcss->surface_flags;
}

/* The region that is searched from the far plane. Off a spot's axis the disc looks longer. */
static float pcss_reach(const void *state, const struct light_frame *frame)
{
	(void)state;
	float corner = frame->parallel ? 0.0f : 2.0f * frame->half_extent * frame->half_extent;
	return 2.0f * disc_scale(frame) * sqrtf(1.0f + corner);
}

static struct object_watch *pcss_casters(void *state, const struct light_frame *frame, float *reach)
{
	struct pcss *pcss = state;
	*reach = pcss_reach(state, frame);
	return &pcss->map.watch;
}

static void pcss_list_memory(const void *state, const struct memory_list *list)
{
	const struct pcss *pcss = state;
	depth_map_list_memory(&pcss->map, list);
}

static void pcss_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct pcss *pcss = state;
	depth_map_bind(&pcss->map, gpu, frame, program);
	disc_bind(&pcss->disc, gpu, frame, program);
}

const struct technique technique_pcss = {
	.name = "pcss",
	.summary = "percentage-closer soft shadows: filtered as wide as the blockers found say "
		   "(Fernando 2005)",
	.samples = {16, 32},
	.state_size = sizeof(struct pcss),
	.init = pcss_init,
	.finish = pcss_finish,
	.prepare = pcss_prepare,
	.surface_flags = pcss_surface_flags,
	.reach = pcss_reach,
	.texels_around = LOOKUP_REACH_LINEAR,
	.casters = pcss_casters,
	.list_memory = pcss_list_memory,
	.bind = pcss_bind,
};
