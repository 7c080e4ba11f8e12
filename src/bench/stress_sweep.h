/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_SWEEP_H
#define BENCH_STRESS_SWEEP_H

#include "bench/stress_check.h"

/** What a picture is held against. */
enum stress_truth {
	STRESS_BASE, /* the picture of the sweep's base: mean |change| */
	STRESS_LIT,  /* nothing throws a shadow: mean of 1 - v */
	STRESS_DARK, /* nothing is lit: mean of v */
};

#define STRESS_VALUES_MAX 16

/** One quantity that goes from one extreme to another, in a scene that is changed by it. */
struct stress_sweep {
	const char *name, *summary;
	size_t count, quick; /* values in all, and how many of them a quick run takes */
	double values[STRESS_VALUES_MAX];
	bool (*make)(struct stress_scene *scene, double value, struct sm_error *error);
	enum stress_truth truth;
	double base; /* value of the picture with STRESS_BASE */
	/* The error's bound is constant + slope * value, for values in [from, to]; pictures need
	 * only be valid beside. */
	double constant, slope, from, to;
	const char *unbound; /* a technique that the bound is not for; may be NULL */
	bool spot_only;      /* a directional light has no such quantity */
	bool is_large;       /* once for each technique, and only where there is the memory */
	bool of_map;         /* values are texels a side: no more of them than the driver can */
	bool is_optional;    /* for techniques that take the options it sets */
};

/** NULL past the last one. */
const struct stress_sweep *stress_sweep_at(size_t index);

/** How much is done: what fits a test, or all. */
enum stress_effort { STRESS_QUICK, STRESS_FULL };

/** What came of a sweep. */
struct stress_outcome {
	uint32_t checks, failures;
	uint32_t left_out; /* for lack of memory */
	/* Where error / bound was greatest, among values with a bound; bound 0: there was none. */
	double error, bound, value;
	char worst[64]; /* the light and the way of that */
};

/** Is told of each broken rule. place: "scale 0.001, spot, pcf". */
struct stress_listener {
	void *data;
	void (*fault)(void *data, const char *place, const struct stress_scene *scene,
		const struct stress_fault *fault);
};

/** Goes through the values of a sweep, each with both kinds of light and all ways of a technique,
 *  or of every one (NULL). Adds to *outcome. Fails (MACHINE) without memory. */
bool stress_sweep_run(const struct stress_sweep *sweep, struct stress_probe *probe,
	const char *technique, enum stress_effort effort, const struct stress_listener *listener,
	struct stress_outcome *outcome, struct sm_error *error);

#endif
