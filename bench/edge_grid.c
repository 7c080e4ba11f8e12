/* SPDX-License-Identifier: MIT */
/* How long it takes to find silhouettes and list them by tiles, against their number. */
#include "scene/edge_grid.h"
#include "base/processor_time.h"
#include "bench/statistics.h"
#include "load/stage.h"
#include "technique/gather.h"
#include <getopt.h>
#include <stdio.h>

#define ROUNDS 25
#define MAP_SIZE 512

/* What one search takes, and what it finds. */
struct measurement {
	double chains, all; /* ms */
};

/* The chains alone. */
static bool find_chains(struct edge_chains *chains, const struct sm_scene *scene,
	const struct light_frame *frame, uint32_t screen)
{
	edge_chains_clear(chains);
	for (size_t i = 0; i < scene->object_count; i++) {
		struct caster_view view;
		if (!scene->objects[i].casts)
			continue;
		if (!edge_chains_see(chains, scene, &scene->objects[i], frame, &view) ||
			!edge_chains_add(chains, &view, screen, 1))
			return false;
	}
	return true;
}

static bool measure(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, uint32_t tiles, struct measurement *found)
{
	const struct edge_grid_options options = {tiles, MAP_SIZE, 8, GATHER_ROOM};
	double chains[ROUNDS], all[ROUNDS];
	for (int round = 0; round < ROUNDS; round++) {
		double start = processor_ms();
		if (!find_chains(&grid->chains, scene, frame, MAP_SIZE << 8))
			return false;
		chains[round] = processor_ms() - start;
		edge_keep_forget(&grid->keep);
		start = processor_ms();
		if (!edge_grid_find(grid, scene, frame, &options))
			return false;
		all[round] = processor_ms() - start;
	}
	*found = (struct measurement){
		statistics_median(chains, ROUNDS), statistics_median(all, ROUNDS)};
	return true;
}

static bool run(const char *source, float radius, uint32_t tiles)
{
	struct stage stage;
	struct sm_error error;
	struct edge_grid grid = {0};
	struct light_frame frame;
	struct measurement found;
	if (!stage_load(&stage, source, NULL, 0, &error)) {
		fprintf(stderr, "bench-edge-grid: %s\n", error.text);
		return false;
	}
	struct sm_light_desc light = stage.scene->lights[0].desc;
	light.radius = radius * glm_vec3_distance(light.position, light.target);
	light_frame_fit(&frame, &light, stage.scene);
	bool done = measure(&grid, stage.scene, &frame, tiles, &found);
	if (done)
		printf("%-24s %4.2f %7zu %5u %8zu %8zu %8zu %6.1f %8.3f %8.3f %7.0f\n", source,
			(double)radius, grid.edge_count, grid.tiles, grid.run_count,
			grid.vertex_count, grid.dropped, (double)grid.mean_list, found.chains,
			found.all, (double)edge_grid_bytes(&grid) / 1024.0);
	edge_grid_finish(&grid);
	stage_finish(&stage);
	return done;
}

int main(int argc, char **argv)
{
	static const char *const defaults[] = {"builtin:cylinder", "builtin:boxes", "builtin:fence",
		"builtin:knot", "builtin:urchin", "builtin:debris", "builtin:debris:6000",
		"builtin:debris:20000", "builtin:debris:60000", "builtin:debris:200000",
		"builtin:urchin:80000", "builtin:urchin:1000000"};
	if (getopt(argc, argv, "") != -1) {
		fputs("usage: bench-edge-grid [SCENE]...\n"
		      "Times the search for silhouettes and their lists for the scene's first "
		      "light,\nof radii .03 and .10 of its distance, on 128 and 64 tiles a side.\n",
			stderr);
		return 2;
	}
	size_t given = (size_t)(argc - optind);
	size_t count = given > 0 ? given : sizeof(defaults) / sizeof(defaults[0]);
	printf("%-24s %4s %7s %5s %8s %8s %8s %6s %8s %8s %7s\n", "scene", "R/d", "edges", "tiles",
		"runs", "vertices", "dropped", "list", "chains", "all, ms", "KiB");
	for (size_t i = 0; i < count; i++) {
		const char *source = given > 0 ? argv[(size_t)optind + i] : defaults[i];
		for (int k = 0; k < 4; k++)
			if (!run(source, k / 2 ? .10f : .03f, k % 2 ? 64 : 128))
				return 2;
		fflush(stdout);
	}
	return 0;
}
