/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_RANDOM_H
#define BENCH_STRESS_RANDOM_H

#include "bench/stress_check.h"

/** The scene of that number among those of a seed, with a technique of its own (or this one): the
 *  same on any machine. A scene file can say it. probe: tells which options a technique takes.
 *  Fails (MACHINE) without memory, and leaves the scene empty. */
bool stress_random_scene(struct stress_scene *scene, uint64_t seed, uint32_t number,
	const char *technique, struct stress_probe *probe, struct sm_error *error);

/** A further rule, for tests: whether the scene keeps it. */
typedef bool (*stress_rule)(const struct stress_scene *scene);

/** stress_check_scene(), and: four times as large it looks the same, and it keeps the rule (may be
 *  NULL). */
bool stress_random_check(struct stress_probe *probe, const struct stress_scene *scene,
	stress_rule rule, struct stress_fault *fault);

#endif
