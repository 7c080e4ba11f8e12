/* SPDX-License-Identifier: MIT */
#include "app/bench_paper_part.h"
#include "app/bench_timing.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

#define CONTENDERS_MAX (PAPER_TECHNIQUES * PAPER_MAPS + 2)
#define LARGEST (PAPER_MAPS - 1)
#define BICUBIC_SAMPLES 16
#define MANY_MAPS 16

/* What is timed of a scene in turns, and where its median goes. */
struct contenders {
	struct sm_shadow_options shadow[CONTENDERS_MAX];
	double *ms[CONTENDERS_MAX];
	size_t count;
};

/* Whether this build has the technique, with that choice of samples; 0: any. */
static bool is_known(const char *technique, uint32_t samples)
{
	size_t i = 0, choice = 0;
	while (sm_technique_name(i) != NULL && strcmp(sm_technique_name(i), technique) != 0)
		i++;
	if (sm_technique_name(i) == NULL)
		return false;
	while (samples > 0 && sm_technique_samples(i, choice) > 0 &&
		sm_technique_samples(i, choice) != samples)
		choice++;
	return samples == 0 || sm_technique_samples(i, choice) == samples;
}

static void add(struct contenders *contenders, struct sm_shadow_options shadow, double *ms)
{
	*ms = NAN;
	if (!is_known(shadow.technique, shadow.samples))
		return;
	contenders->shadow[contenders->count] = shadow;
	contenders->ms[contenders->count++] = ms;
}

/* Returns which of them is the smoothie with the largest map. */
static size_t add_techniques(struct contenders *contenders, struct paper_scene *scene)
{
	static const struct sm_shadow_options techniques[PAPER_TECHNIQUES] = {
		[PAPER_HARD] = {.technique = "hard"},
		[PAPER_SMOOTHIE] = {.technique = "smoothie"},
		[PAPER_BICUBIC] = {.technique = "pcf", .samples = BICUBIC_SAMPLES},
	};
	size_t smoothie = 0;
	for (int i = 0; i < PAPER_TECHNIQUES; i++)
		for (int map = 0; map < PAPER_MAPS; map++) {
			struct sm_shadow_options shadow = techniques[i];
			shadow.map_size = paper_maps[map];
			if (i == PAPER_SMOOTHIE)
				smoothie = contenders->count;
			add(contenders, shadow, &scene->ms[i][map]);
		}
	add(contenders,
		(struct sm_shadow_options){
			.technique = "maps", .map_size = paper_maps[1], .samples = MANY_MAPS},
		&scene->many_maps_ms);
	add(contenders,
		(struct sm_shadow_options){
			.technique = "penumbra-map", .map_size = paper_maps[LARGEST]},
		&scene->penumbra_map_ms);
	return smoothie;
}

static void add_widths(struct contenders *contenders, struct paper_scene *scene)
{
	for (int w = 0; w < PAPER_WIDTHS; w++)
		add(contenders,
			(struct sm_shadow_options){.technique = "smoothie",
				.map_size = paper_maps[PAPER_WIDTH_MAP],
				.width = (float)paper_widths[w]},
			&scene->width_ms[w]);
}

static uint32_t scene_rounds(const struct paper_options *options)
{
	return options->tiny ? 1 : 15;
}

/* Where a processor draws, wide fins of many silhouettes take a second. */
static uint32_t width_rounds(const struct paper_options *options)
{
	return options->tiny ? 1 : 5;
}

static uint32_t scene_side(const struct paper_options *options)
{
	return options->tiny ? 64 : 1024;
}

/* Without the ground that comes with a scene. */
static bool count_edges(struct paper_scene *scene, const char *source, struct sm_error *error)
{
	static const char *const settings[] = {"ground.show=no"};
	struct stage stage = {0};
	if (!stage_load(&stage, source, settings, 1, error))
		return false;
	for (uint32_t mesh = 0; mesh < sm_scene_mesh_count(stage.scene); mesh++) {
		struct sm_mesh_stats stats;
		sm_scene_get_mesh_stats(stage.scene, mesh, &stats);
		scene->triangles += stats.triangles;
		scene->edges += stats.edges;
		scene->open_edges += stats.open_edges;
		scene->odd_edges += stats.non_manifold_edges;
	}
	stage_finish(&stage);
	return true;
}

static bool time_contenders(const struct paper_part *part, const struct contenders *contenders,
	const struct stage *stage, uint32_t rounds, struct timing timings[CONTENDERS_MAX],
	struct sm_error *error)
{
	struct timing_request request = {
		.scene = stage->scene,
		.camera = stage->camera,
		.width = stage->output.width,
		.height = stage->output.height,
		.shadow = contenders->shadow,
		.count = contenders->count,
		.rounds = rounds,
		.driver = part->options->driver,
		.progress = paper_step,
		.progress_data = (void *)part,
	};
	if (!timing_measure(&request, timings, error))
		return false;
	for (size_t i = 0; i < contenders->count; i++)
		*contenders->ms[i] = timings[i].time.median;
	return true;
}

static bool time_techniques(
	const struct paper_part *part, const struct stage *stage, struct sm_error *error)
{
	struct paper_scene *scene = &part->result->scenes[part->scene];
	struct contenders contenders = {.count = 0};
	struct timing timings[CONTENDERS_MAX];
	uint32_t rounds = scene_rounds(part->options);
	size_t smoothie = add_techniques(&contenders, scene);
	if (!time_contenders(part, &contenders, stage, rounds, timings, error))
		return false;
	scene->silhouette_edges = timings[smoothie].stats.silhouette_edges;
	scene->fins = timings[smoothie].stats.fin_vertices / 4;
	part->result->picture = stage->output.width;
	part->result->rounds = rounds;
	return true;
}

static bool time_widths(
	const struct paper_part *part, const struct stage *stage, struct sm_error *error)
{
	struct contenders contenders = {.count = 0};
	struct timing timings[CONTENDERS_MAX];
	add_widths(&contenders, &part->result->scenes[part->scene]);
	return time_contenders(
		part, &contenders, stage, width_rounds(part->options), timings, error);
}

bool paper_time_scene(const struct paper_part *part, const char *source, struct sm_error *error)
{
	struct stage stage = {0};
	struct platform *platform = NULL;
	bool timed = count_edges(&part->result->scenes[part->scene], source, error) &&
		     paper_stage_load(&stage, source, scene_side(part->options), error) &&
		     (platform = paper_open(part, error)) != NULL &&
		     time_techniques(part, &stage, error) && time_widths(part, &stage, error);
	platform_destroy(platform);
	stage_finish(&stage);
	return timed;
}

uint32_t paper_time_scene_steps(const struct paper_options *options)
{
	struct contenders techniques = {.count = 0}, widths = {.count = 0};
	struct paper_scene scene;
	add_techniques(&techniques, &scene);
	add_widths(&widths, &scene);
	return (uint32_t)techniques.count * (TIMING_WARM_FRAMES + scene_rounds(options)) +
	       (uint32_t)widths.count * (TIMING_WARM_FRAMES + width_rounds(options));
}

/* NAN: there is no such pass. */
static double pass_ms(const struct timing *timing, const char *name)
{
	for (int i = 0; i < PASSES_MAX && timing->passes[i].name[0] != '\0'; i++)
		if (strcmp(timing->passes[i].name, name) == 0)
			return timing->passes[i].ms;
	return NAN;
}

static const char *const shapes[] = {"urchin", "debris"};

/* Edges of the meshes; 0 past the last. */
static uint32_t mesh_edges(const struct paper_options *options, size_t i)
{
	static const uint32_t edges[] = {
		1000, 2000, 5000, 10000, 20000, 50000, 100000, 200000, 500000, 1000000};
	size_t count = options->tiny ? 2 : COUNT(edges);
	return i < count ? edges[i] : 0;
}
_Static_assert(COUNT(shapes) * 10 <= PAPER_MESHES_MAX, "room for every mesh");

static uint32_t mesh_rounds(const struct paper_options *options)
{
	return options->tiny ? 1 : 5;
}

static bool time_mesh(const struct paper_part *part, const char *shape, uint32_t edges,
	struct paper_mesh *mesh, struct sm_error *error)
{
	/* Frames are for the silhouettes' sake alone. */
	const uint32_t side = 64;
	struct sm_shadow_options shadow = {.technique = "smoothie", .map_size = 1024};
	struct stage stage;
	struct timing timing;
	char source[64];
	snprintf(source, sizeof(source), "builtin:%s:%u", shape, edges / 3 * 2);
	if (!paper_stage_load(&stage, source, side, error))
		return false;
	struct timing_request request = {
		.scene = stage.scene,
		.camera = stage.camera,
		.width = side,
		.height = side,
		.shadow = &shadow,
		.count = 1,
		.rounds = 1,
		.pass_rounds = mesh_rounds(part->options),
		.driver = part->options->driver,
		.progress = paper_step,
		.progress_data = (void *)part,
	};
	bool timed = timing_measure(&request, &timing, error);
	if (timed) {
		struct paper_scene counts = {0};
		timed = count_edges(&counts, source, error);
		*mesh = (struct paper_mesh){.edges = counts.edges,
			.silhouette_edges = timing.stats.silhouette_edges,
			.fins = timing.stats.fin_vertices / 4,
			.ms = pass_ms(&timing, "silhouettes")};
		snprintf(mesh->shape, sizeof(mesh->shape), "%s", shape);
	}
	stage_finish(&stage);
	return timed;
}

static bool time_shape(const struct paper_part *part, const char *shape, struct sm_error *error)
{
	struct paper_result *result = part->result;
	uint32_t edges;
	for (size_t i = 0; (edges = mesh_edges(part->options, i)) != 0; i++) {
		if (!time_mesh(part, shape, edges, &result->meshes[result->mesh_count], error))
			return false;
		result->mesh_count++;
	}
	return true;
}

bool paper_time_meshes(const struct paper_part *part, struct sm_error *error)
{
	struct platform *platform = paper_open(part, error);
	bool timed = platform != NULL;
	for (size_t shape = 0; shape < COUNT(shapes) && timed; shape++)
		timed = time_shape(part, shapes[shape], error);
	platform_destroy(platform);
	return timed;
}

uint32_t paper_time_meshes_steps(const struct paper_options *options)
{
	uint32_t meshes = 0;
	while (mesh_edges(options, meshes) != 0)
		meshes++;
	return (uint32_t)COUNT(shapes) * meshes * (TIMING_WARM_FRAMES + 1 + mesh_rounds(options));
}

/* Texels a side; 0 past the last. */
static uint32_t map_size(const struct paper_options *options, size_t i)
{
	static const uint32_t sizes[] = {256, 512, 1024, 2048, 4096, 8192};
	size_t count = options->tiny ? 2 : COUNT(sizes);
	return i < count ? sizes[i] : 0;
}
_Static_assert(PAPER_SIZES_MAX >= 6, "room for every size");

static uint32_t size_rounds(const struct paper_options *options)
{
	return options->tiny ? 1 : 9;
}

/* Each size alone: those of two techniques and a map of 8192 take a gigabyte. */
static bool time_size(const struct paper_part *part, const struct stage *stage, uint32_t map,
	struct paper_size *size, struct sm_error *error)
{
	struct sm_shadow_options shadow[] = {
		{.technique = "hard", .map_size = map}, {.technique = "smoothie", .map_size = map}};
	struct timing timings[COUNT(shadow)];
	struct timing_request request = {
		.scene = stage->scene,
		.camera = stage->camera,
		.width = stage->output.width,
		.height = stage->output.height,
		.shadow = shadow,
		.count = COUNT(shadow),
		.rounds = size_rounds(part->options),
		.pass_rounds = size_rounds(part->options),
		.driver = part->options->driver,
		.progress = paper_step,
		.progress_data = (void *)part,
	};
	if (!timing_measure(&request, timings, error))
		return false;
	*size = (struct paper_size){
		.map = map,
		.shadow_map = pass_ms(&timings[0], "shadow map"),
		.buffers = pass_ms(&timings[1], "receiver map") + pass_ms(&timings[1], "smoothies"),
		.hard_frame = timings[0].time.median,
		.smoothie_frame = timings[1].time.median,
	};
	return true;
}

static bool time_all_sizes(
	const struct paper_part *part, const struct stage *stage, struct sm_error *error)
{
	struct paper_result *result = part->result;
	GLint most = 0;
	uint32_t map;
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
	for (size_t i = 0; (map = map_size(part->options, i)) != 0; i++) {
		if (map > (uint32_t)most)
			continue;
		if (!time_size(part, stage, map, &result->sizes[result->size_count], error))
			return false;
		result->size_count++;
	}
	return true;
}

bool paper_time_sizes(const struct paper_part *part, struct sm_error *error)
{
	/* 130,000 edges, as Volokh's. */
	const char *source = part->options->tiny ? "builtin:urchin:1000" : "builtin:urchin:86700";
	struct paper_scene counts = {0};
	struct stage stage = {0};
	struct platform *platform = paper_open(part, error);
	bool timed = platform != NULL && count_edges(&counts, source, error) &&
		     paper_stage_load(&stage, source, scene_side(part->options), error) &&
		     time_all_sizes(part, &stage, error);
	part->result->size_edges = counts.edges;
	platform_destroy(platform);
	stage_finish(&stage);
	return timed;
}

uint32_t paper_time_sizes_steps(const struct paper_options *options)
{
	uint32_t sizes = 0;
	while (map_size(options, sizes) != 0)
		sizes++;
	return 2 * sizes * (TIMING_WARM_FRAMES + 2 * size_rounds(options));
}
