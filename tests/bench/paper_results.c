/* SPDX-License-Identifier: MIT */
#include "paper_results.h"
#include <math.h>
#include <stdio.h>

static struct paper_error error_of(double rmse, double bias)
{
	return (struct paper_error){rmse, bias};
}

struct paper_result paper_nothing(void)
{
	struct paper_error none = error_of(NAN, NAN);
	return (struct paper_result){.hard = none,
		.linear = none,
		.sinusoid = none,
		.half = {none, NAN},
		.fixed12 = {none, NAN},
		.thin = none,
		.thick = none,
		.snapping_coarse = NAN,
		.snapping_fine = NAN};
}

/* The time above hard shadows goes with the silhouette edges: 1 ms for each 1000. */
static struct paper_scene scene_of(int i)
{
	static const uint64_t silhouette_edges[] = {4000, 1000, 3000, 2000};
	struct paper_scene scene = {.wanted = 5700,
		.triangles = 10000 * (uint64_t)(i + 1),
		.edges = 15000 * (uint64_t)(i + 1),
		.silhouette_edges = silhouette_edges[i],
		.fins = 2 * silhouette_edges[i],
		.many_maps_ms = 100,
		.aliasing = {.04, .01},
		.popping = {.04, .01}};
	double extra = (double)silhouette_edges[i] / 1000;
	snprintf(scene.name, sizeof(scene.name), "scene, %d", i);
	for (int map = 0; map < PAPER_MAPS; map++) {
		scene.ms[PAPER_HARD][map] = 10;
		scene.ms[PAPER_SMOOTHIE][map] = 10 + extra;
		scene.ms[PAPER_BICUBIC][map] = 20;
	}
	for (int w = 0; w < PAPER_WIDTHS; w++)
		scene.width_ms[w] = 10 + w * .4;
	scene.penumbra_map_ms = 10 + 2 * extra;
	return scene;
}

static void add_meshes(struct paper_result *result, const char *shape, double ns)
{
	for (uint64_t edges = 1000; edges <= 1000000; edges *= 10) {
		struct paper_mesh *mesh = &result->meshes[result->mesh_count++];
		*mesh = (struct paper_mesh){.edges = edges,
			.silhouette_edges = edges / 10,
			.fins = edges / 5,
			.ms = ns * 1e-6 * (double)edges};
		snprintf(mesh->shape, sizeof(mesh->shape), "%s", shape);
	}
}

struct paper_result paper_ideal(void)
{
	struct paper_result result = paper_nothing();
	for (int i = 0; i < 4; i++)
		result.scenes[result.scene_count++] = scene_of(i);
	add_meshes(&result, "urchin", 5);
	add_meshes(&result, "debris", 50);
	for (uint32_t map = 256; map <= 8192; map *= 2)
		result.sizes[result.size_count++] = (struct paper_size){.map = map,
			.shadow_map = 10,
			.buffers = map < 4096 ? 1 : 5,
			.hard_frame = 20,
			.smoothie_frame = 30};
	result.size_edges = 130000;
	result.hard = error_of(.27, 0);
	result.linear = error_of(.23, -.1);
	result.sinusoid = error_of(.22, -.1);
	result.half = (struct paper_precision){error_of(.2301, -.1), .0002};
	result.fixed12 = (struct paper_precision){error_of(.2302, -.1), .0003};
	result.thin = error_of(.2, -.1);
	result.thick = error_of(.4, -.3);
	result.snapping_coarse = 4;
	result.snapping_fine = 2;
	result.picture = 1024;
	result.rounds = 15;
	return result;
}
