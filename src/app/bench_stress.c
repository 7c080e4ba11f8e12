/* SPDX-License-Identifier: MIT */
#include "app/bench_stress.h"
#include "app/progress.h"
#include "bench/report.h"
#include "bench/stress.h"
#include "platform.h"
#include "process/worker.h"
#include <errno.h>
#include <string.h>

#define RANDOM_SCENES 10000
#define QUICK_RANDOM_SCENES 500
#define SEED 1

/* A run in the child that draws. */
struct run {
	const struct bench_options *options;
	struct progress progress;
	bool progresses;
};

static void show_progress(void *data, uint32_t done, uint32_t total)
{
	struct run *run = data;
	if (!run->progresses)
		progress_start(&run->progress, total, run->options->common.verbosity < 0);
	run->progresses = true;
	progress_update(&run->progress, done);
}

static uint32_t random_scenes(const struct bench_options *options)
{
	if (options->random_scenes > 0 || options->sweep != NULL)
		return options->random_scenes;
	return options->quick ? QUICK_RANDOM_SCENES : RANDOM_SCENES;
}

static bool stress(struct run *run, struct sm_error *error)
{
	const struct bench_options *options = run->options;
	struct stress_options stress = {
		.get_proc = platform_get_proc,
		.driver = driver_options_get(&options->driver),
		.technique = options->technique_count > 0 ? options->techniques[0].technique : NULL,
		.sweep = options->sweep,
		.scene = options->scene_count > 0 ? options->scenes[0] : NULL,
		.effort = options->quick ? STRESS_QUICK : STRESS_FULL,
		.seed = options->seed > 0 ? options->seed : SEED,
		.random_scenes = random_scenes(options),
		.folder = options->out,
		.lines = stdout,
		.progress = show_progress,
		.data = run,
	};
	bool held = stress_run(&stress, error);
	progress_finish(&run->progress);
	return held;
}

static bool work(void *data, struct sm_error *error)
{
	struct run *run = data;
	const struct common_options *common = &run->options->common;
	struct platform *platform = platform_create(common->device, common->debug, error);
	bool held = platform != NULL && stress(run, error);
	platform_destroy(platform);
	/* The child ends without what usually writes this out. */
	if (fflush(stdout) != 0 && held)
		return error_set(
			error, SM_ERROR_MACHINE, "cannot write the outcome (%s)", strerror(errno));
	return held;
}

static bool check(const struct bench_options *options, struct sm_error *error)
{
	size_t last = options->technique_count;
	if (options->scene_count > 1)
		return options_error(error, &bench_command, "--stress takes one --scene");
	if (last > 0 && strcmp(options->techniques[0].technique,
				options->techniques[last - 1].technique) != 0)
		return options_error(error, &bench_command, "--stress takes one --technique");
	return true;
}

bool bench_stress(const struct bench_options *options, struct sm_error *error)
{
	struct run run = {.options = options};
	struct worker worker = {.name = "numerical stress", .work = work, .data = &run};
	if (!check(options, error) || !report_make_folder(options->out, error))
		return false;
	/* What was found before a crash shall be seen. */
	setvbuf(stdout, NULL, _IOLBF, BUFSIZ);
	return worker_run(&worker, error);
}
