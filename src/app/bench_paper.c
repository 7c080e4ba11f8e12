/* SPDX-License-Identifier: MIT */
#include "app/bench_paper.h"
#include "app/bench_output.h"
#include "app/bench_paper_part.h"
#include "app/output.h"
#include "app/stopwatch.h"
#include "base/log.h"
#include "bench/gnuplot.h"
#include "bench/paper_report.h"
#include "bench/report.h"
#include "platform.h"
#include "process/worker.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* What children leave for their parent. */
struct board {
	struct paper_result result;
	_Atomic uint32_t steps;
};

/* All that a run holds. */
struct paper {
	const struct paper_options *options;
	struct board *board; /* shared */
	struct paper_result result;
	uint32_t total; /* steps */
};

/* What a child does. */
struct job {
	const char *name;
	bool (*work)(const struct paper_part *part, struct sm_error *error);
	uint32_t (*steps)(const struct paper_options *options);
};

/* A job on its way. */
struct errand {
	const struct job *job;
	struct paper_part part;
};

/* One for each of the paper's, and a last one as large and with more silhouettes. */
static const struct {
	uint32_t triangles; /* as the paper rounds them */
	const char *model, *source, *name;
} scenes[] = {
	{5700, "spot.glb", "builtin:knot:5700", "generated knot, 5.7k"},
	{9400, NULL, "builtin:primitives", "built-in primitives"},
	{26000, NULL, "builtin:urchin:26000", "generated urchin, 26k"},
	{39000, "sheen-chair.glb", "builtin:knot:39000", "generated knot, 39k"},
	{51000, NULL, "builtin:urchin:51000", "generated urchin, 51k"},
	{51000, NULL, "builtin:debris:51000", "generated debris, 51k"},
};
_Static_assert(COUNT(scenes) <= PAPER_SCENES_MAX, "room for every scene");

static size_t scene_count(const struct paper_options *options)
{
	return options->tiny ? 1 : COUNT(scenes);
}

/* Whether a model is wanted for a scene; its path in 4096 bytes. */
static bool model_path(const struct paper_options *options, size_t scene, char *path)
{
	const char *model = scenes[scene].model;
	return options->models != NULL && model != NULL &&
	       snprintf(path, 4096, "%s/%s", options->models, model) < 4096;
}

static void warn_of_missing_models(const struct paper_options *options)
{
	char path[4096];
	for (size_t i = 0; i < scene_count(options); i++)
		if (model_path(options, i, path) && access(path, R_OK) != 0)
			log_warning("%s is not there: %s stands for it", path, scenes[i].name);
}

/* A model where there is one, or what stands for it; says what the scene is called. */
static const char *scene_source(const struct paper_part *part, char path[4096])
{
	bool there = model_path(part->options, part->scene, path) && access(path, R_OK) == 0;
	const char *model = scenes[part->scene].model;
	struct paper_scene *scene = &part->result->scenes[part->scene];
	snprintf(scene->name, sizeof(scene->name), "%s", there ? model : scenes[part->scene].name);
	scene->wanted = scenes[part->scene].triangles;
	return there ? path : scenes[part->scene].source;
}

bool paper_stage_load(
	struct stage *stage, const char *source, uint32_t side, struct sm_error *error)
{
	static const char *const settings[] = {"motion.turns=light", "motion.period=3600"};
	*stage = (struct stage){0};
	if (!stage_load(stage, source, settings, 2, error))
		return false;
	stage_set_size(stage, side, side);
	return true;
}

void paper_step(void *data)
{
	const struct paper_part *part = data;
	++*part->steps;
}

struct platform *paper_open(const struct paper_part *part, struct sm_error *error)
{
	return platform_create(part->options->device, part->options->debug, error);
}

static void note_fact(void *data, const char *key, const char *value)
{
	struct paper_result *result = data;
	if (strcmp(key, "renderer") == 0)
		snprintf(result->renderer, sizeof(result->renderer), "%s", value);
	else if (strcmp(key, "version") == 0)
		snprintf(result->driver, sizeof(result->driver), "%s", value);
}

static bool describe_driver(const struct paper_part *part, struct sm_error *error)
{
	struct platform *platform = paper_open(part, error);
	struct sm_renderer *renderer = platform != NULL ? sm_renderer_create_with(platform_get_proc,
								  &part->options->driver, error)
							: NULL;
	if (renderer != NULL)
		sm_renderer_describe(renderer, note_fact, part->result);
	bool described = renderer != NULL;
	sm_renderer_destroy(renderer);
	platform_destroy(platform);
	return described;
}

static uint32_t no_steps(const struct paper_options *options)
{
	(void)options;
	return 0;
}

static bool time_scene(const struct paper_part *part, struct sm_error *error)
{
	char path[4096];
	return paper_time_scene(part, scene_source(part, path), error);
}

static bool look_at_scene(const struct paper_part *part, struct sm_error *error)
{
	char path[4096];
	return paper_look_at_scene(part, scene_source(part, path), error);
}

/* First, of each scene, and then of all. */
static const struct job driver_job = {"driver", describe_driver, no_steps};
static const struct job scene_jobs[] = {
	{"times", time_scene, paper_time_scene_steps},
	{"pictures", look_at_scene, paper_look_at_scene_steps},
};
static const struct job jobs[] = {
	{"meshes", paper_time_meshes, paper_time_meshes_steps},
	{"sizes of maps", paper_time_sizes, paper_time_sizes_steps},
	{"errors", paper_look_closer, paper_look_closer_steps},
};

static bool run_errand(void *data, struct sm_error *error)
{
	const struct errand *errand = data;
	return errand->job->work(&errand->part, error);
}

static void watch(void *data)
{
	const struct paper *paper = data;
	const struct paper_options *options = paper->options;
	if (options->progress != NULL)
		options->progress(options->progress_data, paper->board->steps, paper->total);
}

static bool run_jobs(struct paper *paper, const struct job *job, size_t count, size_t scene,
	struct sm_error *error)
{
	for (size_t i = 0; i < count; i++) {
		struct errand errand = {&job[i],
			{paper->options, &paper->board->result, &paper->board->steps, scene}};
		struct worker worker = {job[i].name, run_errand, &errand, watch, paper};
		if (!worker_run(&worker, error))
			return false;
	}
	return true;
}

static bool measure_all(struct paper *paper, struct sm_error *error)
{
	struct paper_result *result = &paper->board->result;
	if (!run_jobs(paper, &driver_job, 1, 0, error))
		return false;
	for (size_t scene = 0; scene < scene_count(paper->options); scene++) {
		if (!run_jobs(paper, scene_jobs, COUNT(scene_jobs), scene, error))
			return false;
		result->scene_count++;
	}
	return run_jobs(paper, jobs, COUNT(jobs), 0, error);
}

static uint32_t count_steps(const struct paper_options *options)
{
	uint32_t of_scene = 0, of_all = 0;
	for (size_t i = 0; i < COUNT(scene_jobs); i++)
		of_scene += scene_jobs[i].steps(options);
	for (size_t i = 0; i < COUNT(jobs); i++)
		of_all += jobs[i].steps(options);
	return (uint32_t)scene_count(options) * of_scene + of_all;
}

static void print_csv(FILE *file, const void *data)
{
	paper_csv_write(data, file);
}

static void print_markdown(FILE *file, const void *data)
{
	paper_markdown_write(data, file);
}

/* What gnuplot made; copied, a temporary file being no place to stay. */
static void print_picture(FILE *file, const void *data)
{
	FILE *picture = *(FILE *const *)data;
	char bytes[4096];
	size_t size;
	while ((size = fread(bytes, 1, sizeof(bytes), picture)) > 0)
		fwrite(bytes, 1, size, file);
}

/* Tables are good without plots: where there is no gnuplot, it is said, and no failure. */
static bool write_plot(const struct paper_result *result, const struct paper_options *options,
	enum paper_plot plot, bool svg, struct sm_error *error)
{
	char name[64];
	struct sm_error problem;
	FILE *script = tmpfile(), *picture = NULL;
	if (script == NULL)
		return error_set(error, SM_ERROR_MACHINE, "no temporary file for a plot");
	snprintf(name, sizeof(name), "%s.%s", paper_plot_name(plot), svg ? "svg" : "png");
	paper_plot_write(result, plot, svg, script);
	bool drawn = gnuplot_run(script, &picture, &problem);
	fclose(script);
	if (!drawn) {
		log_warning("%s is not drawn: %s", name, problem.text);
		return true;
	}
	bool written = bench_output_file(options->out, name, print_picture, &picture, error);
	fclose(picture);
	return written;
}

static bool write_all(const struct paper *paper, struct sm_error *error)
{
	const struct paper_result *result = &paper->result;
	const struct paper_options *options = paper->options;
	bool written = true;
	for (int i = 0; i < 2 * PAPER_PLOTS && written; i++)
		written = write_plot(result, options, i / 2, i % 2 == 0, error);
	return written && bench_output_file(options->out, "paper.csv", print_csv, result, error) &&
	       bench_output_file(options->out, "paper.md", print_markdown, result, error);
}

/* What is wrong with the folder shall show before minutes have gone. */
static bool prepare(const struct paper_options *options, struct sm_error *error)
{
	char path[4096];
	if (snprintf(path, sizeof(path), "%s/paper.csv", options->out) >= (int)sizeof(path))
		return error_set(error, SM_ERROR_INPUT, "--out: the name is too long");
	return report_make_folder(options->out, error) && output_check(path, error);
}

/* Nothing was measured yet. */
static void result_init(struct paper_result *result)
{
	static const struct paper_error none = {NAN, NAN};
	result->hard = result->linear = result->sinusoid = none;
	result->half = result->fixed12 = (struct paper_precision){none, NAN};
	result->thin = result->thick = none;
	result->snapping_coarse = result->snapping_fine = NAN;
}

/* Measures, and keeps what came before a failure too: that took its time. */
static bool measure_and_write(struct paper *paper, struct sm_error *error)
{
	const struct paper_options *options = paper->options;
	double start = stopwatch_now();
	bool measured = measure_all(paper, error);
	paper->result = paper->board->result;
	if (paper->result.scene_count == 0)
		return measured;
	paper->result.seconds = (stopwatch_now() - start) / 1000;
	run_facts_init(&paper->result.facts, options->argc, options->argv);
	bool written = write_all(paper, measured ? error : NULL);
	run_facts_finish(&paper->result.facts);
	return measured && written;
}

bool paper_run(const struct paper_options *options, struct sm_error *error)
{
	struct paper paper = {.options = options, .board = worker_share(sizeof(*paper.board))};
	if (paper.board == NULL)
		return error_no_memory(error);
	result_init(&paper.board->result);
	paper.total = count_steps(options);
	warn_of_missing_models(options);
	bool done = prepare(options, error) && measure_and_write(&paper, error);
	worker_unshare(paper.board, sizeof(*paper.board));
	return done;
}
