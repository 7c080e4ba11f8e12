/* SPDX-License-Identifier: MIT */
#include "app/bench_cell.h"
#include "app/bench_output.h"
#include "app/bench_paper.h"
#include "app/bench_stress.h"
#include "app/offscreen.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/scene_options.h"
#include "base/log.h"
#include "bench/compare.h"
#include "bench/contents.h"
#include "bench/report.h"
#include "bench/run_facts.h"
#include "platform.h"
#include "process/worker.h"
#include "ref/reference.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What children leave for their parent, which opens no device: so that it stays small, and each
 * child can choose how the driver starts. */
struct board {
	_Atomic uint32_t steps;                      /* of the whole run, done */
	struct result results[BENCH_TECHNIQUES_MAX]; /* of a cell */
	size_t fact_size;
	char facts[16384]; /* of the driver: key, 0, value, 0, and so on */
};

/* All that a run holds. */
struct bench {
	const struct bench_options *options;
	struct board *board; /* shared */
	struct run_facts facts;
	struct result_list results;
	struct result_list earlier; /* of the run to compare with */
	struct progress progress;
	char cache[PATH_MAX];
};

/* What a child is to do with a cell. */
struct job {
	const struct bench *bench;
	const struct bench_cell *cell;
	enum thread_choice threads;
	size_t technique;
};

static void watch(void *data)
{
	struct bench *bench = data;
	progress_update(&bench->progress, bench->board->steps);
}

static bool run_job(struct bench *bench, struct job *job, const char *what,
	bool (*work)(void *data, struct sm_error *error), struct sm_error *error)
{
	char name[400];
	snprintf(name, sizeof(name), "%.300s: %s", job->cell->scene, what);
	struct worker worker = {name, work, job, watch, bench};
	job->bench = bench;
	return worker_run(&worker, error);
}

static void note_fact(void *data, const char *key, const char *value)
{
	struct board *board = data;
	size_t room = sizeof(board->facts) - board->fact_size;
	int size = snprintf(board->facts + board->fact_size, room, "%s%c%s", key, '\0', value);
	if (size >= 0 && (size_t)size < room)
		board->fact_size += (size_t)size + 1;
}

static bool check_size(struct bench_size size, struct sm_error *error)
{
	struct offscreen target;
	bool fits = offscreen_init(&target, OFFSCREEN_PICTURE, size.width, size.height, 1, error);
	offscreen_finish(&target);
	return fits;
}

static bool check_techniques(
	const struct bench *bench, struct sm_renderer *renderer, struct sm_error *error)
{
	const struct bench_options *options = bench->options;
	for (size_t map = 0; map < options->map_count; map++)
		for (size_t i = 0; i < options->technique_count; i++) {
			struct bench_cell cell = {.options = options, .map = options->maps[map]};
			struct sm_shadow_options shadow = bench_cell_shadow(&cell, i);
			if (!sm_renderer_set_shadows(renderer, &shadow, error))
				return false;
		}
	return check_size(options->time_size, error) && check_size(options->error_size, error);
}

static bool check_driver(void *data, struct sm_error *error)
{
	const struct bench *bench = ((struct job *)data)->bench;
	const struct common_options *common = &bench->options->common;
	struct platform *platform = platform_create(common->device, common->debug, error);
	struct sm_renderer *renderer =
		platform != NULL ? driver_options_renderer(&bench->options->driver, error) : NULL;
	bool checked = renderer != NULL && check_techniques(bench, renderer, error);
	if (checked) {
		platform_describe(platform, note_fact, bench->board);
		sm_renderer_describe(renderer, note_fact, bench->board);
	}
	sm_renderer_destroy(renderer);
	platform_destroy(platform);
	return checked;
}

static bool check_scene(void *data, struct sm_error *error)
{
	return bench_cell_label(((struct job *)data)->cell, error);
}

static bool measure_error(void *data, struct sm_error *error)
{
	const struct bench_cell *cell = ((struct job *)data)->cell;
	return bench_cell_label(cell, error) &&
	       (!reference_is_built() || bench_accuracy(cell, error));
}

static bool measure_times(void *data, struct sm_error *error)
{
	const struct job *job = data;
	return bench_cost_times(job->cell, job->threads, error);
}

static bool measure_memory(void *data, struct sm_error *error)
{
	const struct job *job = data;
	return bench_cost_memory(job->cell, job->technique, error);
}

static struct bench_cell cell_at(const struct bench *bench, size_t scene, size_t radius, size_t map)
{
	return (struct bench_cell){
		.options = bench->options,
		.scene = bench->options->scenes[scene],
		.radius = bench->options->radii[radius],
		.map = bench->options->maps[map],
		.pictures = radius == 0 && map == 0, /* a run of hours would leave thousands */
		.cache = bench->cache,
		.results = bench->board->results,
		.steps = &bench->board->steps,
	};
}

/* Results tell scenes apart by their names. */
static bool check_names(const struct bench_options *options, struct sm_error *error)
{
	for (size_t i = 0; i < options->scene_count; i++)
		for (size_t j = 0; j < i; j++) {
			size_t length, other_length;
			const char *name = scene_name(options->scenes[i], &length);
			const char *other = scene_name(options->scenes[j], &other_length);
			if (length == other_length && strncmp(name, other, length) == 0)
				return error_set(error, SM_ERROR_INPUT,
					"--scene %.200s: results would have it under the name of "
					"%.200s",
					options->scenes[i], options->scenes[j]);
		}
	return true;
}

/* What is wrong shall show at once, and not when hours have gone. */
static bool check_inputs(struct bench *bench, struct sm_error *error)
{
	for (size_t scene = 0; scene < bench->options->scene_count; scene++) {
		struct bench_cell cell = cell_at(bench, scene, 0, 0);
		struct job job = {.cell = &cell};
		if (!run_job(bench, &job, "reading it", check_scene, error) ||
			(scene == 0 && !run_job(bench, &job, "driver", check_driver, error)))
			return false;
	}
	return true;
}

static enum thread_choice last_threads(const struct bench_options *options)
{
	return options->quick ? THREADS_DEFAULT : THREADS_NONE;
}

static bool measure_cell(struct bench *bench, const struct bench_cell *cell, struct sm_error *error)
{
	struct job job = {.cell = cell};
	if (!run_job(bench, &job, "error", measure_error, error))
		return false;
	if (bench->options->errors)
		return true;
	for (; job.threads <= last_threads(bench->options); job.threads++)
		if (!run_job(bench, &job, "time", measure_times, error))
			return false;
	for (; job.technique < bench->options->technique_count; job.technique++)
		if (!run_job(bench, &job, bench->options->techniques[job.technique].name,
			    measure_memory, error))
			return false;
	return true;
}

static struct report report_of(const struct bench *bench)
{
	return (struct report){bench->options->out, &bench->results, &bench->facts, output_write};
}

/* A picture that an earlier run left in the folder is none of this one's. */
static void remove_picture(const struct bench *bench, const struct result *result,
	void (*find_name)(const struct result *result, char name[FILE_NAME_MAX]))
{
	char name[FILE_NAME_MAX], path[PATH_MAX];
	find_name(result, name);
	if (snprintf(path, sizeof(path), "%s/%s", bench->options->out, name) < (int)sizeof(path))
		unlink(path);
}

/* Writes all there is so far: a run that is stopped keeps what is finished. */
static bool keep_cell(struct bench *bench, const struct bench_cell *cell, struct sm_error *error)
{
	size_t first = bench->results.count;
	for (size_t i = 0; i < bench->options->technique_count; i++) {
		struct result *result = &bench->board->results[i];
		run_facts_machine(&bench->facts, result->machine, sizeof(result->machine));
		if (!reference_is_built() || !cell->pictures)
			remove_picture(bench, result, difference_file_name);
		if (!reference_is_built())
			remove_picture(bench, result, sheet_file_name);
		if (!result_list_add(&bench->results, result, error))
			return false;
	}
	progress_finish(&bench->progress);
	const struct report report = report_of(bench);
	return report_write_data(&report, error) &&
	       bench_output_rows(stdout, &bench->results, first, error);
}

static int verbosity_of(const struct bench_options *options)
{
	return options->common.debug ? 2 : options->common.verbosity;
}

static size_t cell_count(const struct bench_options *options)
{
	return options->scene_count * options->radius_count * options->map_count;
}

static bool measure_all(struct bench *bench, struct sm_error *error)
{
	const struct bench_options *options = bench->options;
	/* What drivers warn of was said when they were tried; each child would repeat it. */
	if (verbosity_of(options) == 0)
		report_set_verbosity(-1);
	for (size_t i = 0; i < cell_count(options); i++) {
		struct bench_cell cell = cell_at(bench,
			i / options->map_count / options->radius_count,
			i / options->map_count % options->radius_count, i % options->map_count);
		if (!measure_cell(bench, &cell, error) || !keep_cell(bench, &cell, error))
			return false;
	}
	return true;
}

static uint32_t cost_steps(const struct bench_options *options)
{
	uint32_t steps = BENCH_COST_MEMORY_STEPS * (uint32_t)options->technique_count;
	for (enum thread_choice i = THREADS_DEFAULT; i <= last_threads(options); i++)
		steps += bench_cost_times_steps(options, i);
	return steps;
}

static uint32_t total_steps(const struct bench_options *options)
{
	uint32_t cell = (reference_is_built() ? bench_accuracy_steps(options) : 0) +
			(options->errors ? 0 : cost_steps(options));
	return cell * (uint32_t)cell_count(options);
}

/* What changes times, if it is set. */
static void add_environment(struct run_facts *facts)
{
	static const char *const names[] = {
		"LP_NUM_THREADS", "GALLIUM_DRIVER", "LIBGL_ALWAYS_SOFTWARE"};
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		if (getenv(names[i]) != NULL)
			run_facts_add(facts, names[i], "%s", getenv(names[i]));
}

static bool add_facts(struct bench *bench, struct sm_error *error)
{
	const struct bench_options *options = bench->options;
	const struct board *board = bench->board;
	for (const char *key = board->facts; key < board->facts + board->fact_size;) {
		const char *value = key + strlen(key) + 1;
		run_facts_driver(&bench->facts, key, value);
		key = value + strlen(value) + 1;
	}
	run_facts_add(&bench->facts, "rounds", "%u", options->rounds);
	if (reference_is_built())
		run_facts_add(&bench->facts, "reference samples", "%u", options->samples);
	else
		log_warning("this build has no reference (Embree): errors are not measured");
	add_environment(&bench->facts);
	return !bench->facts.failed || error_no_memory(error);
}

static bool start(struct bench *bench, int argc, char **argv, struct sm_error *error)
{
	const struct bench_options *options = bench->options;
	bench->board = worker_share(sizeof(*bench->board));
	if (bench->board == NULL)
		return error_no_memory(error);
	if (snprintf(bench->cache, sizeof(bench->cache), "%s/references", options->out) >=
		(int)sizeof(bench->cache))
		return error_set(error, SM_ERROR_INPUT, "--out: the name is too long");
	run_facts_init(&bench->facts, argc, argv);
	if (options->compare != NULL &&
		!bench_output_read(&bench->earlier, options->compare, error))
		return false;
	if (!check_names(options, error) || !check_inputs(bench, error) ||
		!bench_output_prepare(options->out, error) || !add_facts(bench, error))
		return false;
	bench_output_head(stdout);
	progress_start(&bench->progress, total_steps(options), options->common.verbosity < 0);
	return true;
}

static bool conclude(const struct bench *bench, struct sm_error *error)
{
	const struct report report = report_of(bench);
	report_set_verbosity(verbosity_of(bench->options));
	if (bench->options->compare != NULL)
		compare_print(&bench->earlier, &bench->results, stdout);
	return report_write(&report, error);
}

static void finish(struct bench *bench)
{
	progress_finish(&bench->progress);
	result_list_finish(&bench->results);
	result_list_finish(&bench->earlier);
	run_facts_finish(&bench->facts);
	worker_unshare(bench->board, sizeof(*bench->board));
}

static void show_progress(void *data, uint32_t done, uint32_t total)
{
	struct progress *progress = data;
	progress->total = total;
	progress_update(progress, done);
}

static bool run_paper(
	const struct bench_options *options, int argc, char **argv, struct sm_error *error)
{
	struct progress progress;
	struct paper_options paper = {
		.out = options->out,
		.models = options->models,
		.device = options->common.device,
		.driver = driver_options_get(&options->driver),
		.debug = options->common.debug,
		.argc = argc,
		.argv = argv,
		.progress = show_progress,
		.progress_data = &progress,
	};
	progress_start(&progress, UINT32_MAX, options->common.verbosity < 0);
	bool done = paper_run(&paper, error);
	progress_finish(&progress);
	return done;
}

static bool run_results(
	const struct bench_options *options, int argc, char **argv, struct sm_error *error)
{
	struct bench bench = {.options = options};
	bool done = start(&bench, argc, argv, error) && measure_all(&bench, error) &&
		    conclude(&bench, error);
	finish(&bench);
	return done;
}

static bool run(const struct bench_options *options, int argc, char **argv, struct sm_error *error)
{
	if (options->common.help) {
		options_help(&bench_command);
		return true;
	}
	report_set_verbosity(verbosity_of(options));
	if (options->stress)
		return bench_stress(options, error);
	return options->paper ? run_paper(options, argc, argv, error)
			      : run_results(options, argc, argv, error);
}

bool bench_run(int argc, char **argv, struct sm_error *error)
{
	struct bench_options options;
	bool done =
		bench_options_read(&options, argc, argv, error) && run(&options, argc, argv, error);
	bench_options_finish(&options);
	return done;
}
