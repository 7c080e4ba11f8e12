/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_BASE_H
#define BENCH_STRESS_BASE_H

#include "bench/stress_scene.h"

/** The objects of the scene that sweeps change. */
enum stress_base_object { STRESS_FLOOR, STRESS_BLOCK, STRESS_BALL };

/** A block above a floor and a ball that touches it, under one light; all lengths are multiples of
 *  1/16, so that the scene can be moved by 10^6 without rounding. Fails (MACHINE). */
bool stress_base_init(struct stress_scene *scene, enum sm_light_type type, struct sm_error *error);

#endif
