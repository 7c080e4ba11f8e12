/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_H
#define BENCH_STRESS_H

#include "bench/stress_random.h"
#include "bench/stress_sweep.h"
#include <stdio.h>

/** What of the numerical stress is run, and where its lines go. Zero takes nothing but
 *  get_proc. */
struct stress_options {
	sm_get_proc get_proc;
	struct sm_driver_options driver;
	const char *technique; /* NULL: all */
	const char *sweep;     /* the only one that is run; NULL: all */
	const char *scene;     /* a scene file that is checked instead of all else; NULL: none */
	enum stress_effort effort;
	uint64_t seed;
	uint32_t random_scenes;
	const char *folder; /* existing, for scenes that break a rule; NULL: none are written */
	stress_rule rule;   /* further, of random scenes; NULL: none */
	FILE *lines;
	/** Of random scenes and sweeps; may be NULL. */
	void (*progress)(void *data, uint32_t done, uint32_t total);
	void *data;
};

/** Runs sweeps and random scenes in the current context. Fails (INPUT) on a name that is not
 *  there, and (MACHINE) when a rule was broken, or without memory. */
bool stress_run(const struct stress_options *options, struct sm_error *error);

#endif
