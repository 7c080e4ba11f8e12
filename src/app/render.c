/* SPDX-License-Identifier: MIT */
#include "app/driver_options.h"
#include "app/facts.h"
#include "app/offscreen.h"
#include "app/output.h"
#include "app/program_store.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/scene_options.h"
#include "app/sequence.h"
#include "app/stopwatch.h"
#include "base/array.h"
#include "load/motion.h"
#include "page/png.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <getopt.h>
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
	FLAG_SIZE = FLAG_OWN_OF_SCENES,
	FLAG_VISIBILITY,
	FLAG_FRAMES,
	FLAG_FPS,
	FLAG_STATS,
};

static const struct flag flags[] = {
	{'o', "output", "FILE",
		"PNG to write, - for standard output; default: SCENE's name + .png"},
	{FLAG_SIZE, "size", "WxH", "pixels of the picture"},
	SCENE_FLAGS,
	{FLAG_VISIBILITY, "visibility", "[=LIGHT]",
		"16-bit grey: the share of a light (0) that arrives"},
	{FLAG_FRAMES, "frames", "N|A:B", "write N numbered pictures, or those from A to B"},
	{FLAG_FPS, "fps", "F", "frames a second of the scene's time, with --frames; default: 25"},
	{FLAG_STATS, "stats", NULL, "print times and counts"},
	DRIVER_FLAGS,
	SKIP_FLAG,
	RENDER_DEVICE_FLAG,
	COMMON_FLAGS,
};

struct render_options {
	struct common_options common;
	struct scene_options scene;
	struct driver_options driver;
	char *output;                /* owned */
	uint32_t width, height;      /* 0: not given */
	bool is_sequence;            /* of numbered pictures */
	uint32_t first, last;        /* frames, counted from 1, both drawn */
	uint32_t rate, rate_divisor; /* frames a second; rate 0: not given */
	uint32_t visibility_of;
	bool stats;
};

/* All that a run holds, in the order it is made. */
struct render {
	struct stage stage;
	struct platform *platform;
	struct program_store programs;
	struct sm_renderer *renderer;
	struct offscreen target;
	uint8_t *pixels; /* R,G,B,A of the whole target */
	struct stopwatch stopwatch;
};

static bool read_flag(
	struct render_options *options, int id, const char *value, struct sm_error *error)
{
	switch (id) {
	case 'o':
		free(options->output);
		options->output = strdup(value);
		return options->output != NULL || error_no_memory(error);
	case FLAG_SIZE:
		return options_size(value, &options->width, &options->height) ||
		       options_error(error, &render_command,
			       "--size %.40s: WIDTHxHEIGHT in pixels is wanted, each 1 or more",
			       value);
	case FLAG_VISIBILITY:
		options->visibility_of = 0;
		return value == NULL ||
		       options_number(value, 0, SM_NONE - 1, &options->visibility_of) ||
		       options_error(error, &render_command,
			       "--visibility=%.40s: a light's number, from 0, is wanted", value);
	case FLAG_FRAMES:
		options->is_sequence = true;
		return options_range(value, 1000000, &options->first, &options->last) ||
		       options_error(error, &render_command,
			       "--frames %.40s: a number from 1 to 1000000 is wanted, or two: 3:5 "
			       "for the third to the fifth",
			       value);
	case FLAG_FPS:
		return options_rate(value, &options->rate, &options->rate_divisor) ||
		       options_error(error, &render_command,
			       "--fps %.40s: a number or ratio from 0.001 to 1000 is wanted, such "
			       "as 25 or 60000/1001",
			       value);
	case FLAG_STATS:
		options->stats = true;
		return true;
	default:
		if (scene_options_has(id))
			return scene_options_flag(
				&options->scene, &render_command, id, value, error);
		if (driver_options_has(id))
			return driver_options_flag(&options->driver, id, value, error);
		options_common(&options->common, id, value);
		return true;
	}
}

static bool check_options(const struct render_options *options, struct sm_error *error)
{
	const char *conflict = NULL;
	if (options->rate > 0 && !options->is_sequence)
		conflict = "--fps needs --frames";
	else if (options->visibility_of != SM_NONE && options->scene.samples > 1)
		conflict = "--visibility has one sample a pixel: --samples 4 does not go with it";
	else if (options->is_sequence && strcmp(options->output, "-") == 0)
		conflict = "--frames writes several files: -o - does not go with it";
	return conflict == NULL || options_error(error, &render_command, "%s", conflict);
}

/* "models/horse.3ds" and "builtin:horse" give "horse.png". */
static char *default_output(const char *scene)
{
	size_t length;
	const char *name = scene_name(scene, &length);
	char *output = array_alloc(length + sizeof(".png"), 1);
	if (output != NULL)
		sprintf(output, "%.*s.png", (int)length, name);
	return output;
}

static bool read_options(
	struct render_options *options, int argc, char **argv, struct sm_error *error)
{
	*options = (struct render_options){
		.common = options_defaults(),
		.first = 1,
		.last = 1,
		.rate_divisor = 1,
		.visibility_of = SM_NONE,
	};
	if (!scene_options_init(&options->scene, argc, error))
		return false;
	int id;
	while ((id = options_next(&render_command, argc, argv, error)) >= 0)
		if (!read_flag(options, id, optarg, error))
			return false;
	if (id == FLAG_FAILED)
		return false;
	if (options->common.help)
		return true;
	if (!scene_options_argument(&options->scene, &render_command, argc, argv, error))
		return false;
	if (options->output == NULL)
		options->output = default_output(options->scene.scene);
	return options->output != NULL ? check_options(options, error) : error_no_memory(error);
}

static void finish_options(struct render_options *options)
{
	free(options->output);
	driver_options_finish(&options->driver);
	scene_options_finish(&options->scene);
}

static bool is_same_file(const char *a, const char *b)
{
	struct stat file_a, file_b;
	return stat(a, &file_a) == 0 && stat(b, &file_b) == 0 && file_a.st_dev == file_b.st_dev &&
	       file_a.st_ino == file_b.st_ino;
}

/* The name of frame `number`, from 1, in PATH_MAX bytes. */
static bool output_path(
	const struct render_options *options, uint32_t number, char *path, struct sm_error *error)
{
	bool fits = options->is_sequence
			    ? sequence_path(options->output, number, path, PATH_MAX)
			    : snprintf(path, PATH_MAX, "%s", options->output) < PATH_MAX;
	return fits || error_set(error, SM_ERROR_INPUT, "-o: the name is too long");
}

/* What can be known before the work starts need not wait for its end. */
static bool check_output(const struct render_options *options, struct sm_error *error)
{
	char path[PATH_MAX];
	if (!output_path(options, options->first, path, error))
		return false;
	if (is_same_file(path, options->scene.scene))
		return error_set(
			error, SM_ERROR_INPUT, "%.300s would be written over itself", path);
	return output_check(path, error);
}

static bool load_stage(
	struct stage *stage, const struct render_options *options, struct sm_error *error)
{
	if (!scene_options_load(&options->scene, stage, error))
		return false;
	if (options->width > 0)
		stage_set_size(stage, options->width, options->height);
	uint32_t lights = sm_scene_light_count(stage->scene);
	if (options->visibility_of != SM_NONE && options->visibility_of >= lights)
		return error_set(error, SM_ERROR_INPUT, "--visibility=%u: %.300s has %u light%s",
			options->visibility_of, options->scene.scene, lights,
			lights == 1 ? "" : "s");
	return true;
}

static bool init_target(
	struct render *render, const struct render_options *options, struct sm_error *error)
{
	const struct stage_output *output = &render->stage.output;
	bool picture = options->visibility_of == SM_NONE;
	if (!offscreen_init(&render->target, picture ? OFFSCREEN_PICTURE : OFFSCREEN_VISIBILITY,
		    output->width, output->height, picture ? output->samples : 1, error))
		return false;
	render->pixels = array_alloc(output->height, 4 * (size_t)output->width);
	return render->pixels != NULL || error_no_memory(error);
}

static bool start(
	struct render *render, const struct render_options *options, struct sm_error *error)
{
	if (!load_stage(&render->stage, options, error))
		return false;
	stopwatch_lap(&render->stopwatch, "load scene");
	render->platform = platform_create(options->common.device, options->common.debug, error);
	if (render->platform == NULL)
		return false;
	stopwatch_lap(&render->stopwatch, "open device");
	render->renderer = driver_options_renderer(&options->driver, error);
	if (render->renderer == NULL || !init_target(render, options, error) ||
		!sm_renderer_set_shadows(render->renderer, &render->stage.shadow, error))
		return false;
	program_store_init(&render->programs);
	sm_renderer_set_program_store(render->renderer, &render->programs.calls);
	glFinish();
	stopwatch_lap(&render->stopwatch, "create renderer");
	return true;
}

static bool write_frame(struct render *render, const struct render_options *options,
	const char *path, struct sm_error *error)
{
	const struct offscreen *target = &render->target;
	struct png png;
	bool encoded = options->visibility_of == SM_NONE
			       ? png_init_picture(
					 &png, render->pixels, target->width, target->height, error)
			       : png_init_visibility(&png, render->pixels, target->width,
					 target->height, error);
	bool written = encoded && output_write(path, png.bytes, png.size, error);
	png_finish(&png);
	return written;
}

/* Puts the scene at the time of frame `number`, from 1. */
static bool set_time(struct stage *stage, const struct render_options *options, uint32_t number,
	struct sm_error *error)
{
	uint32_t rate = options->rate > 0 ? options->rate : 25;
	return stage_set_time(stage, motion_time(number, rate, options->rate_divisor), error);
}

/* Into pixels, unless that is the picture that they hold. */
static bool draw_frame(struct render *render, const struct render_options *options, bool first,
	struct sm_error *error)
{
	struct sm_view view = {
		.camera = render->stage.camera,
		.framebuffer = render->target.framebuffer,
		.width = render->target.width,
		.height = render->target.height,
		.visibility_of = options->visibility_of,
		.alone = true, /* frame k is the same, whoever draws it */
	};
	if (sm_renderer_is_current(render->renderer, render->stage.scene, &view))
		return true;
	if (!sm_renderer_draw(render->renderer, render->stage.scene, &view, error))
		return false;
	glFinish();
	stopwatch_lap(&render->stopwatch, first ? "first frame" : "further frames");
	offscreen_resolve(&render->target);
	if (!offscreen_read(&render->target, render->pixels, error))
		return false;
	stopwatch_lap(&render->stopwatch, "read back");
	return true;
}

static bool render_frame(struct render *render, const struct render_options *options,
	uint32_t number, struct sm_error *error)
{
	char path[PATH_MAX];
	if (!output_path(options, number, path, error) ||
		!set_time(&render->stage, options, number, error) ||
		!draw_frame(render, options, number == options->first, error) ||
		!write_frame(render, options, path, error))
		return false;
	stopwatch_lap(&render->stopwatch, "write PNG");
	return true;
}

static bool render_frames(
	struct render *render, const struct render_options *options, struct sm_error *error)
{
	struct progress progress;
	bool rendered = true;
	progress_start(
		&progress, options->last - options->first + 1, options->common.verbosity < 0);
	for (uint32_t number = options->first; number <= options->last && rendered; number++) {
		rendered = render_frame(render, options, number, error);
		progress_update(&progress, number - options->first + 1);
	}
	progress_finish(&progress);
	return rendered;
}

static void print_stats(const struct render *render, FILE *file)
{
	struct facts facts;
	struct sm_frame_stats stats;
	sm_renderer_get_stats(render->renderer, &stats);
	facts_begin(&facts, file, false);
	stopwatch_describe(&render->stopwatch, &facts);
	facts_format(&facts, "draw calls", "%" PRIu32, stats.draw_calls);
	facts_format(&facts, "lights", "%" PRIu32, stats.lights);
	facts_format(&facts, "lights drawn hard by auto", "%" PRIu32, stats.hard_lights);
	facts_format(&facts, "lights drawn sparsely", "%" PRIu32, stats.sparse_lights);
	facts_format(&facts, "lights drawn deferred", "%" PRIu32, stats.deferred_lights);
	facts_format(&facts, "triangles", "%" PRIu64, stats.triangles);
	facts_format(&facts, "silhouette edges", "%" PRIu64, stats.silhouette_edges);
	facts_format(&facts, "silhouette edges left out", "%" PRIu64, stats.edges_left_out);
	facts_format(&facts, "fins left out", "%" PRIu64, stats.fins_left_out);
	facts_format(&facts, "fin vertices", "%" PRIu64, stats.fin_vertices);
	facts_format(&facts, "fin bytes", "%" PRIu64, stats.fin_bytes);
	facts_format(&facts, "uploaded bytes", "%" PRIu64, stats.uploaded_bytes);
	facts_format(&facts, "silhouette time", "%.3f ms", stats.silhouette_ms);
	driver_options_describe_skips(render->renderer, &facts);
	facts_format(&facts, "programs compiled", "%" PRIu32, stats.programs_compiled);
	facts_format(&facts, "programs loaded", "%" PRIu32, stats.programs_loaded);
	facts_end(&facts);
}

static void finish(struct render *render)
{
	free(render->pixels);
	offscreen_finish(&render->target);
	sm_renderer_destroy(render->renderer);
	program_store_finish(&render->programs);
	platform_destroy(render->platform);
	stage_finish(&render->stage);
}

static bool render_scene(const struct render_options *options, struct sm_error *error)
{
	struct render render = {0};
	stopwatch_start(&render.stopwatch);
	report_set_verbosity(options->common.debug ? 2 : options->common.verbosity);
	bool rendered = check_output(options, error) && start(&render, options, error) &&
			render_frames(&render, options, error);
	if (rendered && options->stats)
		print_stats(&render, strcmp(options->output, "-") == 0 ? stderr : stdout);
	finish(&render);
	return rendered;
}

static bool run(int argc, char **argv, struct sm_error *error)
{
	struct render_options options;
	bool done = read_options(&options, argc, argv, error);
	if (done && options.common.help)
		options_help(&render_command);
	else if (done)
		done = render_scene(&options, error);
	finish_options(&options);
	return done;
}

const struct command render_command = {
	.name = "render",
	.arguments = "SCENE [-o FILE] [flags]",
	.summary = "Draw a model, a scene file or builtin:NAME into a PNG file.",
	.flags = flags,
	.flag_count = sizeof(flags) / sizeof(flags[0]),
	.run = run,
};
