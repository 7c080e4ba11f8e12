/* SPDX-License-Identifier: MIT */
#include "app/bench_timing.h"
#include "app/memory_parts.h"
#include "app/offscreen.h"
#include "app/stopwatch.h"
#include "base/array.h"
#include "bench/statistics.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The ms of a pass, or of its parts if it comes more than once, in each frame. */
struct pass_clock {
	const char *names[PASSES_MAX];
	double *ms[PASSES_MAX]; /* owned: [pass_rounds] */
	size_t count;
	uint32_t round, rounds;
	double begin;
	bool out_of_memory;
};

/* One that is timed. */
struct contender {
	struct sm_renderer *renderer;
	double *wall, *cpu; /* owned: [rounds] ms */
	struct pass_clock passes;
};

/* All that a measurement holds. */
struct bench {
	const struct timing_request *request;
	struct offscreen target;
	struct contender *contenders; /* owned: [request->count] */
};

static void begin_pass(void *data, const char *pass)
{
	struct pass_clock *clock = data;
	(void)pass;
	clock->begin = stopwatch_now();
}

/* Passes beyond the last that there is room for are not told apart from nothing. */
static double *pass_ms(struct pass_clock *clock, const char *pass)
{
	size_t i = 0;
	while (i < clock->count && strcmp(clock->names[i], pass) != 0)
		i++;
	if (i == PASSES_MAX)
		return NULL;
	if (i == clock->count) {
		clock->ms[i] = array_zalloc(clock->rounds, sizeof(double));
		if (clock->ms[i] == NULL) {
			clock->out_of_memory = true;
			return NULL;
		}
		clock->names[i] = pass;
		clock->count++;
	}
	return &clock->ms[i][clock->round];
}

static void end_pass(void *data, const char *pass)
{
	struct pass_clock *clock = data;
	glFinish();
	double *ms = pass_ms(clock, pass);
	if (ms != NULL)
		*ms += stopwatch_now() - clock->begin;
}

static bool draw(const struct bench *bench, struct contender *contender, struct sm_error *error)
{
	const struct timing_request *request = bench->request;
	struct sm_view view = {
		.camera = request->camera,
		.framebuffer = bench->target.framebuffer,
		.width = request->width,
		.height = request->height,
		.visibility_of = SM_NONE,
	};
	bool drawn = sm_renderer_draw(contender->renderer, request->scene, &view, error);
	glFinish();
	if (request->progress != NULL)
		request->progress(request->progress_data);
	return drawn;
}

static bool time_frame(const struct bench *bench, struct contender *contender, uint32_t round,
	struct sm_error *error)
{
	double wall = stopwatch_now(), cpu = stopwatch_processor_time();
	bool drawn = draw(bench, contender, error);
	contender->cpu[round] = stopwatch_processor_time() - cpu;
	contender->wall[round] = stopwatch_now() - wall;
	return drawn;
}

static bool time_passes(const struct bench *bench, struct contender *contender, uint32_t round,
	struct sm_error *error)
{
	struct sm_pass_observer observer = {&contender->passes, begin_pass, end_pass};
	contender->passes.round = round;
	sm_renderer_set_pass_observer(contender->renderer, &observer);
	bool drawn = draw(bench, contender, error);
	sm_renderer_set_pass_observer(contender->renderer, NULL);
	return drawn && (!contender->passes.out_of_memory || error_no_memory(error));
}

static bool warm(const struct bench *bench, struct contender *contender, uint32_t round,
	struct sm_error *error)
{
	(void)round;
	return draw(bench, contender, error);
}

/* One frame of each contender a round, forth and back, so that none always follows the same one. */
static bool take_turns(const struct bench *bench, uint32_t rounds,
	bool (*frame)(const struct bench *bench, struct contender *contender, uint32_t round,
		struct sm_error *error),
	struct sm_error *error)
{
	size_t count = bench->request->count;
	for (uint32_t round = 0; round < rounds; round++)
		for (size_t turn = 0; turn < count; turn++) {
			size_t place = (round + turn) % count;
			size_t which = round % 2 == 0 ? place : count - 1 - place;
			if (!frame(bench, &bench->contenders[which], round, error))
				return false;
		}
	return true;
}

static bool contender_init(struct contender *contender, const struct timing_request *request,
	const struct sm_shadow_options *shadow, struct sm_error *error)
{
	contender->passes.rounds = request->pass_rounds;
	contender->wall = array_zalloc(request->rounds, sizeof(double));
	contender->cpu = array_zalloc(request->rounds, sizeof(double));
	if (contender->wall == NULL || contender->cpu == NULL)
		return error_no_memory(error);
	contender->renderer = sm_renderer_create_with(platform_get_proc, &request->driver, error);
	/* Frame by frame the same is timed: all of it, as if it were new. */
	static const char kept[] = "-frame,-light,-static,-points";
	return contender->renderer != NULL &&
	       sm_renderer_set_skips(contender->renderer, kept, error) &&
	       sm_renderer_set_skips(contender->renderer, request->skips, error) &&
	       sm_renderer_set_shadows(contender->renderer, shadow, error);
}

static void contender_finish(struct contender *contender)
{
	sm_renderer_destroy(contender->renderer);
	free(contender->wall);
	free(contender->cpu);
	for (size_t i = 0; i < contender->passes.count; i++)
		free(contender->passes.ms[i]);
}

static bool init(struct bench *bench, struct sm_error *error)
{
	const struct timing_request *request = bench->request;
	bench->contenders = array_zalloc(request->count, sizeof(*bench->contenders));
	if (bench->contenders == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < request->count; i++)
		if (!contender_init(&bench->contenders[i], request, &request->shadow[i], error))
			return false;
	return offscreen_init(
		&bench->target, OFFSCREEN_PICTURE, request->width, request->height, 1, error);
}

static void finish(struct bench *bench)
{
	for (size_t i = 0; bench->contenders != NULL && i < bench->request->count; i++)
		contender_finish(&bench->contenders[i]);
	free(bench->contenders);
	offscreen_finish(&bench->target);
}

static struct time_summary sum_up(const struct contender *contender, uint32_t rounds)
{
	statistics_sort(contender->wall, rounds);
	return (struct time_summary){
		.median = statistics_percentile(contender->wall, rounds, 0.5),
		.p10 = statistics_percentile(contender->wall, rounds, 0.1),
		.p90 = statistics_percentile(contender->wall, rounds, 0.9),
		.cpu = statistics_median(contender->cpu, rounds),
	};
}

static void sum_up_passes(struct pass_clock *clock, struct pass_time passes[PASSES_MAX])
{
	for (size_t i = 0; i < clock->count; i++) {
		snprintf(passes[i].name, sizeof(passes[i].name), "%s", clock->names[i]);
		passes[i].ms = statistics_median(clock->ms[i], clock->rounds);
	}
}

static bool weigh(const struct sm_renderer *renderer, const struct sm_scene *scene,
	struct timing *timing, struct sm_error *error)
{
	struct memory_parts parts;
	sm_renderer_get_memory(renderer, scene, &timing->memory);
	bool listed = memory_parts_find(&parts, renderer, scene, error) &&
		      memory_parts_format(&parts, timing->owners, sizeof(timing->owners), error);
	memory_parts_finish(&parts);
	return listed;
}

static bool sum_up_all(const struct bench *bench, struct timing *timings, struct sm_error *error)
{
	const struct timing_request *request = bench->request;
	for (size_t i = 0; i < request->count; i++) {
		timings[i] =
			(struct timing){.time = sum_up(&bench->contenders[i], request->rounds)};
		sum_up_passes(&bench->contenders[i].passes, timings[i].passes);
		sm_renderer_get_stats(bench->contenders[i].renderer, &timings[i].stats);
		if (!weigh(bench->contenders[i].renderer, request->scene, &timings[i], error))
			return false;
	}
	double base = timings[request->base].time.median;
	for (size_t i = 0; i < request->count; i++)
		/* A clock that is too coarse for the base leaves no ratio. */
		timings[i].time.ratio = base > 0 ? timings[i].time.median / base : 0;
	return true;
}

bool timing_measure(
	const struct timing_request *request, struct timing *timings, struct sm_error *error)
{
	struct bench bench = {.request = request};
	assert(request->rounds > 0 && request->base < request->count);
	bool measured = init(&bench, error) &&
			take_turns(&bench, TIMING_WARM_FRAMES, warm, error) &&
			take_turns(&bench, request->rounds, time_frame, error) &&
			take_turns(&bench, request->pass_rounds, time_passes, error) &&
			sum_up_all(&bench, timings, error);
	finish(&bench);
	return measured;
}
