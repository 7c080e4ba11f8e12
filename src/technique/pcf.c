/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"

/* Reeves, Salesin & Cook 1987; over 4x4 texels the bicubic filter of Chan & Durand 2003, Figure
 * 7. */
struct pcf {
	struct depth_map map;
	uint64_t surface_flags;
};

#define BICUBIC_SAMPLES 16

static bool pcf_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct pcf *pcf = state;
	bool bicubic = options->samples == BICUBIC_SAMPLES;
	struct depth_ways ways;
	if (!depth_ways_choose(&ways, gpu, error))
		return false;
	bool plain = bicubic ? ways.taps_plainly : ways.compares_plainly;
	pcf->surface_flags = bicubic ? FLAG_BICUBIC | ways.taps : FLAG_HARD | ways.compare;
	return depth_map_init(&pcf->map, gpu, options->map_size, DEPTH_MAP_LINEAR, plain, error);
}

static void pcf_finish(void *state, struct gpu *gpu)
{
	struct pcf *pcf = state;
	depth_map_finish(&pcf->map, gpu);
}

static bool pcf_prepare(void *state, struct gpu *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, struct sm_error *error)
{
	struct pcf *pcf = state;
	return depth_map_draw(&pcf->map, gpu, scene, frame, error);
}

static uint64_t pcf_surface_flags(const void *state)
{
	const struct pcf *pcf = state;
	return pcf->surface_flags;
}

/* A texel more on each side. */
static float pcf_reach(const void *state, const struct light_frame *frame)
{
	(void)frame;
	const struct pcf *pcf = state;
	return pcf->surface_flags & FLAG_BICUBIC ? 2.0f / (float)pcf->map.target.size : 0.0f;
}

static struct object_watch *pcf_casters(void *state, const struct light_frame *frame, float *reach)
{
	struct pcf *pcf = state;
	*reach = pcf_reach(state, frame);
	return &pcf->map.watch;
}

static void pcf_list_memory(const void *state, const struct memory_list *list)
{
	const struct pcf *pcf = state;
	depth_map_list_memory(&pcf->map, list);
}

static void pcf_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct pcf *pcf = state;
	depth_map_bind(&pcf->map, gpu, frame, program);
}

const struct technique technique_pcf = {
	.name = "pcf",
	.summary = "percentage-closer filtering: comparisons at the four nearest texels, blended, "
		   "or bicubic over 16",
	.samples = {4, BICUBIC_SAMPLES},
	.state_size = sizeof(struct pcf),
	.init = pcf_init,
	.finish = pcf_finish,
	.prepare = pcf_prepare,
	.surface_flags = pcf_surface_flags,
	.reach = pcf_reach,
	.texels_around = LOOKUP_REACH_LINEAR,
	.casters = pcf_casters,
	.list_memory = pcf_list_memory,
	.bind = pcf_bind,
};
