/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_CELL_H
#define APP_BENCH_CELL_H

#include "app/bench_options.h"
#include "bench/result.h"
#include "load/stage.h"

/** One scene at one radius of its light and one size of shadow map, and what is found of each
 *  technique there. */
struct bench_cell {
	const struct bench_options *options; /**< not owned */
	const char *scene;
	double radius; /**< as a share of the light's distance */
	uint32_t map;
	bool pictures;           /**< whether its differences are written */
	const char *cache;       /**< folder of references, not owned */
	struct result *results;  /**< [technique_count], shared with children, not owned */
	_Atomic uint32_t *steps; /**< shared: counted on as work is done, not owned */
};

/** Loads the scene with a light of that radius, for pictures of that size. At time i its light has
 *  turned by i times a quarter of a degree about its target. Fails as stage_load(), and (INPUT)
 *  without a light. */
bool bench_cell_load(const struct bench_cell *cell, struct bench_size size, struct stage *stage,
	struct sm_error *error);

/** How a technique draws its shadows here. */
struct sm_shadow_options bench_cell_shadow(const struct bench_cell *cell, size_t technique);

/** Fills in what results say of scene and set-up. */
bool bench_cell_label(const struct bench_cell *cell, struct sm_error *error);

/** bench_accuracy.c: fills in error and flicker. In a process that may open a device. */
bool bench_accuracy(const struct bench_cell *cell, struct sm_error *error);
/** How many steps that counts. */
uint32_t bench_accuracy_steps(const struct bench_options *options);

/** bench_cost.c: fills in times with that choice of threads, and with the default the passes. In a
 *  process that may open a device. */
bool bench_cost_times(
	const struct bench_cell *cell, enum thread_choice threads, struct sm_error *error);
/** Fills in the memory that a technique takes. In a process that does nothing else. */
bool bench_cost_memory(const struct bench_cell *cell, size_t technique, struct sm_error *error);
/** How many steps one choice of threads counts, and one technique's memory. */
uint32_t bench_cost_times_steps(const struct bench_options *options, enum thread_choice threads);
#define BENCH_COST_MEMORY_STEPS 3

#endif
