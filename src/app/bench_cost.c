/* SPDX-License-Identifier: MIT */
/* What a technique costs: time and memory. */
#include "app/bench_cell.h"
#include "app/bench_timing.h"
#include "base/array.h"
#include "platform.h"
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

/* What all times are a ratio to; timed with the rest even if nobody asked for it. */
static const char base_name[] = "hard";

static size_t base_index(const struct bench_options *options)
{
	size_t i = 0;
	while (i < options->technique_count &&
		strcmp(options->techniques[i].technique, base_name) != 0)
		i++;
	return i;
}

static size_t contender_count(const struct bench_options *options)
{
	return options->technique_count + (base_index(options) == options->technique_count);
}

static uint32_t pass_rounds(const struct bench_options *options)
{
	return options->rounds / 3 + 1;
}

static void count_frame(void *data)
{
	const struct bench_cell *cell = data;
	++*cell->steps;
}

/* The median time of pcss-16; 0: it was not timed. */
static double pcss_median(const struct bench_options *options, const struct timing *timings)
{
	for (size_t i = 0; i < options->technique_count; i++)
		if (strcmp(options->techniques[i].name, "pcss-16") == 0)
			return timings[i].time.median;
	return 0;
}

static void keep(
	const struct bench_cell *cell, enum thread_choice threads, const struct timing *timings)
{
	double pcss = pcss_median(cell->options, timings);
	for (size_t i = 0; i < cell->options->technique_count; i++) {
		cell->results[i].time[threads] = timings[i].time;
		if (pcss > 0)
			cell->results[i].time[threads].ratio_pcss = timings[i].time.median / pcss;
		if (threads == THREADS_DEFAULT)
			memcpy(cell->results[i].passes, timings[i].passes,
				sizeof(timings[i].passes));
	}
}

static bool measure(const struct bench_cell *cell, const struct stage *stage,
	enum thread_choice threads, struct sm_error *error)
{
	const struct bench_options *options = cell->options;
	struct sm_shadow_options shadow[BENCH_TECHNIQUES_MAX + 1];
	struct timing timings[BENCH_TECHNIQUES_MAX + 1];
	struct timing_request request = {
		.scene = stage->scene,
		.camera = stage->camera,
		.width = options->time_size.width,
		.height = options->time_size.height,
		.shadow = shadow,
		.count = contender_count(options),
		.base = base_index(options),
		.driver = driver_options_get(&options->driver),
		.skips = options->driver.skips,
		.rounds = options->rounds,
		.pass_rounds = threads == THREADS_DEFAULT ? pass_rounds(options) : 0,
		.progress = count_frame,
		.progress_data = (void *)cell,
	};
	for (size_t i = 0; i < options->technique_count; i++)
		shadow[i] = bench_cell_shadow(cell, i);
	if (request.base == options->technique_count)
		shadow[request.base] =
			(struct sm_shadow_options){.technique = base_name, .map_size = cell->map};
	if (!timing_measure(&request, timings, error))
		return false;
	keep(cell, threads, timings);
	return true;
}

bool bench_cost_times(
	const struct bench_cell *cell, enum thread_choice threads, struct sm_error *error)
{
	const struct common_options *common = &cell->options->common;
	struct stage stage = {0};
	/* llvmpipe reads it when its device is opened. */
	if (threads == THREADS_NONE && setenv("LP_NUM_THREADS", "0", 1) != 0)
		return error_no_memory(error);
	struct platform *platform = platform_create(common->device, common->debug, error);
	bool measured = platform != NULL &&
			bench_cell_load(cell, cell->options->time_size, &stage, error) &&
			measure(cell, &stage, threads, error);
	platform_destroy(platform);
	stage_finish(&stage);
	return measured;
}

uint32_t bench_cost_times_steps(const struct bench_options *options, enum thread_choice threads)
{
	uint32_t rounds = TIMING_WARM_FRAMES + options->rounds +
			  (threads == THREADS_DEFAULT ? pass_rounds(options) : 0);
	return rounds * (uint32_t)contender_count(options);
}

static uint64_t peak_bytes(void)
{
	struct rusage usage;
	return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}

/* The memory of a renderer that has drawn as often as takes all that it keeps. */
static bool weigh(const struct bench_cell *cell, size_t technique, const struct stage *stage,
	struct sm_error *error)
{
	struct sm_shadow_options shadow = bench_cell_shadow(cell, technique);
	struct timing_request request = {
		.scene = stage->scene,
		.camera = stage->camera,
		.width = cell->options->time_size.width,
		.height = cell->options->time_size.height,
		.shadow = &shadow,
		.count = 1,
		.driver = driver_options_get(&cell->options->driver),
		.skips = cell->options->driver.skips,
		.rounds = 1,
	};
	struct timing timing;
	if (!timing_measure(&request, &timing, error))
		return false;
	cell->results[technique].geometry_bytes = timing.memory.geometry;
	cell->results[technique].target_bytes = timing.memory.targets;
	memcpy(cell->results[technique].memory, timing.owners, sizeof(timing.owners));
	cell->results[technique].peak_bytes = peak_bytes();
	return true;
}

bool bench_cost_memory(const struct bench_cell *cell, size_t technique, struct sm_error *error)
{
	const struct common_options *common = &cell->options->common;
	struct stage stage = {0};
	struct platform *platform = platform_create(common->device, common->debug, error);
	bool weighed = platform != NULL &&
		       bench_cell_load(cell, cell->options->time_size, &stage, error) &&
		       weigh(cell, technique, &stage, error);
	*cell->steps += BENCH_COST_MEMORY_STEPS;
	platform_destroy(platform);
	stage_finish(&stage);
	return weighed;
}
