/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_SHRINK_H
#define BENCH_STRESS_SHRINK_H

#include "bench/stress_random.h"

/** Makes a scene that fails stress_random_check() as simple as it can be and still fail in the same
 *  way: objects, lights and triangles are dropped, numbers rounded, options left out, sizes halved.
 *  fault: of the scene, and then of the simpler one. What fails for lack of memory stays as it is.
 */
void stress_shrink(struct stress_scene *scene, struct stress_probe *probe, stress_rule rule,
	struct stress_fault *fault);

#endif
