/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_TIMING_H
#define APP_BENCH_TIMING_H

#include "bench/result.h"

/** What to time: ways to make the shadows of one scene, in turns. */
struct timing_request {
	const struct sm_scene *scene;
	struct sm_camera camera;
	uint32_t width, height;                 /* pixels */
	const struct sm_shadow_options *shadow; /* [count] */
	size_t count;
	size_t base; /* the one that ratios are to */
	struct sm_driver_options driver;
	const char *skips;    /* as sm_renderer_set_skips(), of what is skipped within a frame */
	uint32_t rounds;      /* frames of each, 1 or more */
	uint32_t pass_rounds; /* further frames of each, whose passes are timed; 0: none */
	/** Hears of every frame; may be NULL. */
	void (*progress)(void *data);
	void *progress_data;
};

struct timing {
	struct time_summary time;
	struct pass_time passes[PASSES_MAX];
	struct sm_frame_stats stats;    /* of the last frame */
	struct sm_memory memory;        /* after it */
	char owners[RESULT_MEMORY_MAX]; /* whose it is, as of a result */
};

/** Draws of each before anything is timed, so that no frame compiles. */
#define TIMING_WARM_FRAMES 2

/**
 * Times whole frames in the current context, each until the GL has finished. One frame of each way
 * is drawn in a round, and rounds start with another each time: so a machine whose speed drifts is
 * equally fast for all.
 *
 * timings: [count], filled. Fails as sm_renderer_draw() and offscreen_init() do, (MACHINE) for lack
 * of memory.
 */
bool timing_measure(
	const struct timing_request *request, struct timing *timings, struct sm_error *error);

#endif
