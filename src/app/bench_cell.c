/* SPDX-License-Identifier: MIT */
#include "app/bench_cell.h"
#include "app/scene_options.h"
#include <math.h>
#include <stdio.h>

/* The light goes round its target, a quarter of a degree a second. */
#define TURNS "motion.turns=light", "motion.period=1440"

static double light_distance(const struct stage *stage)
{
	const struct sm_light_desc *light = &stage->motion.lights[0].rest;
	return hypot(hypot((double)light->position[0] - (double)light->target[0],
			     (double)light->position[1] - (double)light->target[1]),
		(double)light->position[2] - (double)light->target[2]);
}

bool bench_cell_load(const struct bench_cell *cell, struct bench_size size, struct stage *stage,
	struct sm_error *error)
{
	char radius[64];
	const char *settings[] = {TURNS, radius};
	*stage = (struct stage){0};
	if (!stage_load(stage, cell->scene, settings, 2, error))
		return false;
	/* The radius is known only with the distance, and the camera may depend on it. */
	snprintf(radius, sizeof(radius), "light.radius=%.9g", cell->radius * light_distance(stage));
	stage_finish(stage);
	if (!stage_load(stage, cell->scene, settings, 3, error))
		return false;
	if (stage->motion.lights[0].light != 0) {
		stage_finish(stage);
		return error_set(error, SM_ERROR_INPUT,
			"%.300s: its [motion] is of another light than the first, which is the one "
			"that is measured",
			cell->scene);
	}
	stage_set_size(stage, size.width, size.height);
	return true;
}

struct sm_shadow_options bench_cell_shadow(const struct bench_cell *cell, size_t technique)
{
	return (struct sm_shadow_options){
		.technique = cell->options->techniques[technique].technique,
		.samples = cell->options->techniques[technique].samples,
		.precision = cell->options->techniques[technique].precision,
		.map_size = cell->map,
	};
}

static uint32_t count_triangles(const struct sm_scene *scene)
{
	size_t triangles = 0;
	for (uint32_t mesh = 0; mesh < sm_scene_mesh_count(scene); mesh++) {
		struct sm_mesh_stats stats;
		sm_scene_get_mesh_stats(scene, mesh, &stats);
		triangles += stats.triangles;
	}
	return (uint32_t)triangles;
}

bool bench_cell_label(const struct bench_cell *cell, struct sm_error *error)
{
	const struct bench_options *options = cell->options;
	struct stage stage;
	size_t length;
	const char *name = scene_name(cell->scene, &length);
	if (!bench_cell_load(cell, options->error_size, &stage, error))
		return false;
	for (size_t i = 0; i < options->technique_count; i++) {
		struct result *result = &cell->results[i];
		*result = (struct result){
			.radius = cell->radius,
			.map = cell->map,
			.width = options->error_size.width,
			.height = options->error_size.height,
			.time_width = options->time_size.width,
			.time_height = options->time_size.height,
			.triangles = count_triangles(stage.scene),
			.outside_wrong = NAN,
			.flicker = NAN,
		};
		for (int region = 0; region < REGIONS; region++)
			result->error[region] = ERROR_NONE;
		snprintf(result->scene, sizeof(result->scene), "%.*s", (int)length, name);
		snprintf(result->technique, sizeof(result->technique), "%s",
			options->techniques[i].name);
		snprintf(result->precision, sizeof(result->precision), "%s",
			sm_precision_name((size_t)options->techniques[i].precision - 1));
	}
	stage_finish(&stage);
	return true;
}
