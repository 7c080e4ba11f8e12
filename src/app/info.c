/* SPDX-License-Identifier: MIT */
#include "app/driver_options.h"
#include "app/facts.h"
#include "app/info_memory.h"
#include "app/report.h"
#include "load/stage.h"
#include "platform.h"
#include <getopt.h>
#include <stdio.h>
#include <string.h>

enum {
	FLAG_JSON = FLAG_OWN_OF_SCENES,
	FLAG_MEMORY,
};

static const struct flag flags[] = {
	{FLAG_JSON, "json", NULL, "print one JSON object"},
	{FLAG_MEMORY, "memory", NULL, "draw SCENE once and tell whose its memory is"},
	SCENE_FLAGS,
	DRIVER_FLAGS,
	RENDER_DEVICE_FLAG,
	COMMON_FLAGS,
};

struct info_options {
	struct common_options common;
	struct driver_options driver;
	struct scene_options scene; /* scene.scene NULL: about the driver */
	bool json, memory;
	bool drawn; /* flags are given of how the scene is drawn */
};

static bool take_flag(struct info_options *options, int id, struct sm_error *error)
{
	switch (id) {
	case FLAG_JSON:
		options->json = true;
		return true;
	case FLAG_MEMORY:
		options->memory = true;
		return true;
	default:
		options->drawn |= scene_options_has(id);
		if (scene_options_has(id))
			return scene_options_flag(
				&options->scene, &info_command, id, optarg, error);
		if (driver_options_has(id))
			return driver_options_flag(&options->driver, id, optarg, error);
		options_common(&options->common, id, optarg);
		return true;
	}
}

static bool read_options(
	struct info_options *options, int argc, char **argv, struct sm_error *error)
{
	*options = (struct info_options){.common = options_defaults()};
	if (!scene_options_init(&options->scene, argc, error))
		return false;
	int id;
	while ((id = options_next(&info_command, argc, argv, error)) >= 0)
		if (!take_flag(options, id, error))
			return false;
	if (id == FLAG_FAILED)
		return false;
	if (optind + 1 < argc)
		return options_error(error, &info_command, "one SCENE is wanted, not also %.200s",
			argv[optind + 1]);
	options->scene.scene = argv[optind]; /* argv ends with NULL */
	if (options->memory && options->scene.scene == NULL && !options->common.help)
		return options_error(error, &info_command, "--memory: SCENE is missing");
	if (options->drawn && !options->memory)
		return options_error(
			error, &info_command, "flags of how SCENE is drawn are for --memory alone");
	return true;
}

static struct sm_mesh_stats sum_meshes(const struct sm_scene *scene)
{
	struct sm_mesh_stats sum = {0};
	for (uint32_t mesh = 0; mesh < sm_scene_mesh_count(scene); mesh++) {
		struct sm_mesh_stats stats;
		sm_scene_get_mesh_stats(scene, mesh, &stats);
		sum.triangles += stats.triangles;
		sum.repeated_triangles += stats.repeated_triangles;
		sum.degenerate_triangles += stats.degenerate_triangles;
		sum.vertices += stats.vertices;
		sum.welded_vertices += stats.welded_vertices;
		sum.edges += stats.edges;
		sum.open_edges += stats.open_edges;
		sum.non_manifold_edges += stats.non_manifold_edges;
		sum.inverted_edges += stats.inverted_edges;
		sum.closed_parts += stats.closed_parts;
		sum.open_parts += stats.open_parts;
		sum.turned_triangles += stats.turned_triangles;
		sum.edge_bytes += stats.edge_bytes;
		sum.plane_bytes += stats.plane_bytes;
	}
	return sum;
}

static double bytes_per_edge(const struct sm_mesh_stats *stats, size_t bytes)
{
	/* Degenerate triangles alone have no edges. */
	return stats->edges > 0 ? (double)bytes / (double)stats->edges : 0;
}

/** By its number, as --animation takes it; is_alone: the object is the only one with any. */
static void add_clip(struct facts *facts, const struct stage_clip *clip, bool is_alone)
{
	char key[80];
	snprintf(key, sizeof(key), "animation %zu%s%.40s", clip->number, is_alone ? "" : " of ",
		is_alone ? "" : clip->object);
	facts_format(facts, key, "%.60s, %.3f s, %zu nodes, %zu morphs", clip->name, clip->seconds,
		clip->nodes, clip->morphs);
}

static void add_clips(struct facts *facts, const struct stage_clips *clips)
{
	const struct stage_clip *list = clips->clips;
	bool is_alone = true;
	facts_format(facts, "skins", "%zu", clips->skins);
	facts_format(facts, "bones", "%zu", clips->bones);
	facts_format(facts, "morph targets", "%zu", clips->targets);
	facts_format(facts, "animations", "%zu", clips->clip_count);
	for (size_t i = 1; i < clips->clip_count; i++)
		is_alone = is_alone && strcmp(list[i].object, list[0].object) == 0;
	for (size_t i = 0; i < clips->clip_count; i++)
		add_clip(facts, &list[i], is_alone);
}

static void add_scene(struct facts *facts, const struct sm_scene *scene)
{
	struct sm_mesh_stats stats = sum_meshes(scene);
	facts_format(facts, "meshes", "%u", sm_scene_mesh_count(scene));
	facts_format(facts, "objects", "%u", sm_scene_object_count(scene));
	facts_format(facts, "lights", "%u", sm_scene_light_count(scene));
	facts_format(facts, "triangles", "%zu", stats.triangles);
	facts_format(facts, "repeated triangles", "%zu", stats.repeated_triangles);
	facts_format(facts, "degenerate triangles", "%zu", stats.degenerate_triangles);
	facts_format(facts, "vertices", "%zu", stats.vertices);
	facts_format(facts, "welded vertices", "%zu", stats.welded_vertices);
	facts_format(facts, "edges", "%zu", stats.edges);
	facts_format(facts, "open edges", "%zu", stats.open_edges);
	facts_format(facts, "non-manifold edges", "%zu", stats.non_manifold_edges);
	facts_format(facts, "inverted edges", "%zu", stats.inverted_edges);
	facts_format(facts, "closed parts", "%zu", stats.closed_parts);
	facts_format(facts, "open parts", "%zu", stats.open_parts);
	facts_format(facts, "turned triangles", "%zu", stats.turned_triangles);
	facts_format(facts, "bytes per edge", "%.1f", bytes_per_edge(&stats, stats.edge_bytes));
	facts_format(facts, "bytes per edge with planes", "%.1f",
		bytes_per_edge(&stats, stats.edge_bytes + stats.plane_bytes));
}

static bool describe_scene(const struct info_options *options, struct sm_error *error)
{
	/* The ground is put below the scene's meshes, and is none of them. */
	static const char *const settings[] = {"ground.show=no"};
	struct stage stage = {0};
	struct facts facts;
	if (!stage_load(&stage, options->scene.scene, settings, 1, error))
		return false;
	facts_begin(&facts, stdout, options->json);
	add_scene(&facts, stage.scene);
	add_clips(&facts, &stage.clips);
	facts_end(&facts);
	stage_finish(&stage);
	return true;
}

static bool describe_driver(const struct info_options *options, struct sm_error *error)
{
	struct facts facts;
	struct platform *platform =
		platform_create(options->common.device, options->common.debug, error);
	struct sm_renderer *renderer =
		platform != NULL ? driver_options_renderer(&options->driver, error) : NULL;
	if (renderer != NULL) {
		facts_begin(&facts, stdout, options->json);
		facts_add(&facts, "smoothie", sm_version());
		platform_describe(platform, facts_sink, &facts);
		sm_renderer_describe(renderer, facts_sink, &facts);
		facts_end(&facts);
	}
	bool described = renderer != NULL;
	sm_renderer_destroy(renderer);
	platform_destroy(platform);
	return described;
}

static bool describe(const struct info_options *options, struct sm_error *error)
{
	if (options->memory)
		return info_memory(
			&options->common, &options->driver, &options->scene, options->json, error);
	return options->scene.scene != NULL ? describe_scene(options, error)
					    : describe_driver(options, error);
}

static bool run(int argc, char **argv, struct sm_error *error)
{
	struct info_options options;
	bool done = read_options(&options, argc, argv, error);
	if (done && options.common.help) {
		options_help(&info_command);
	} else if (done) {
		report_set_verbosity(options.common.debug ? 2 : options.common.verbosity);
		done = describe(&options, error);
	}
	scene_options_finish(&options.scene);
	driver_options_finish(&options.driver);
	return done;
}

const struct command info_command = {
	.name = "info",
	.arguments = "[SCENE] [flags]",
	.summary = "Tell what the driver can do, how a scene's meshes are built, or what it takes.",
	.flags = flags,
	.flag_count = sizeof(flags) / sizeof(flags[0]),
	.run = run,
};
