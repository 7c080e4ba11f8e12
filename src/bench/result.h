/* SPDX-License-Identifier: MIT */
#ifndef BENCH_RESULT_H
#define BENCH_RESULT_H

#include "base/error.h"
#include <math.h>
#include <stddef.h>

/** Pixels that an error is of: all that face the light, and these by how much of it they truly
 *  see. */
enum region { REGION_ALL, REGION_LIT, REGION_UMBRA, REGION_PENUMBRA, REGIONS };

/** Of technique minus reference, linear visibility in [0, 1]. NAN without
 * pixels. */
struct error_summary {
	uint64_t pixels;
	double rmse;
	double bias;          /* mean signed error */
	double p95, p99, max; /* of its absolute value */
};

/** An error that is seen as a wrong shadow, and not as a wrong shade. */
#define ERROR_WRONG 0.1

/** Of no pixels. */
#define ERROR_NONE ((struct error_summary){0, NAN, NAN, NAN, NAN, NAN})

/** How many threads the driver draws with. */
enum thread_choice { THREADS_DEFAULT, THREADS_NONE, THREAD_CHOICES };

/** Of frames, milliseconds. All 0: not measured. */
struct time_summary {
	double median, p10, p90; /* wall clock */
	double cpu;              /* of the process and all its threads, median */
	double ratio;            /* of the medians, to "hard" in the same rounds */
	double ratio_pcss;       /* and to pcss-16 */
};

#define PASSES_MAX 8

/** Of all owners that there are, with room. */
#define RESULT_MEMORY_MAX 2000

/** A pass, by the name that sm_pass_observer is told; median ms of frames that wait for GL after
 *  each. */
struct pass_time {
	char name[24];
	double ms;
};

/** One technique on one scene: a row of results.csv. */
struct result {
	char scene[128];    /* without folder, "builtin:" and extension */
	char technique[32]; /* with its samples where it has choices: "pcss-16" */
	char precision[16];
	double radius;          /* of the light, as a share of its distance */
	uint32_t map;           /* texels a side */
	uint32_t width, height; /* of the picture the error is of */
	uint32_t time_width, time_height;
	uint32_t triangles;
	char machine[160]; /* what times depend on: processor and driver, see run_facts_machine() */
	struct error_summary error[REGIONS];
	double outside_wrong; /* pixels outside the penumbra with an error above ERROR_WRONG;
				 NAN: not measured */
	double flicker; /* mean |change of v - change of reference| a frame, under a slow light;
			   NAN: not measured */
	struct time_summary time[THREAD_CHOICES];
	struct pass_time passes[PASSES_MAX];   /* ends with an empty name */
	uint64_t geometry_bytes, target_bytes; /* as sm_memory */
	uint64_t peak_bytes;                   /* resident, of a process that draws this alone */
	char memory[RESULT_MEMORY_MAX]; /* "KIND: OWNER=BYTES;...", as sm_renderer_list_memory() */
};

/** Results in the order they were made. Zero is empty. */
struct result_list {
	struct result *items; /* owned */
	size_t count, capacity;
};

/** Copies *result to the end. Fails (MACHINE) when out of memory. */
bool result_list_add(struct result_list *list, const struct result *result, struct sm_error *error);

/** Frees what the list holds. */
void result_list_finish(struct result_list *list);

#endif
