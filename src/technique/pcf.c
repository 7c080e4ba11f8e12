/* SPDX-License-Identifier: MIT */
#include "technique/depth_map.h"

/* Reeves, Salesin & Cook 1987. */
struct pcf {
	struct depth_map map;
};

static bool pcf_init(void *state, struct gpu *gpu, const struct sm_shadow_options *options,
	struct sm_error *error)
{
	struct pcf *pcf = state;
	return depth_map_init(&pcf->map, gpu, options->map_size, DEPTH_MAP_LINEAR, error);
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
	return depth_map_draw(&pcf->map, gpu, scene, frame, DEPTH_OF_CASTERS, error);
}

static uint32_t pcf_surface_flags(const void *state)
{
	(void)state;
	return FLAG_HARD;
}

static void pcf_bind(const void *state, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	const struct pcf *pcf = state;
	depth_map_bind(&pcf->map, gpu, frame, program);
}

const struct technique technique_pcf = {
	.name = "pcf",
	.summary = "percentage-closer filtering: comparisons at the four nearest texels, blended",
	.state_size = sizeof(struct pcf),
	.init = pcf_init,
	.finish = pcf_finish,
	.prepare = pcf_prepare,
	.surface_flags = pcf_surface_flags,
	.bind = pcf_bind,
};
