/* SPDX-License-Identifier: MIT */
#ifndef BENCH_STRESS_CHECK_H
#define BENCH_STRESS_CHECK_H

#include "bench/stress_probe.h"
#include "bench/stress_scene.h"

/** A technique with one of its choices of samples. */
struct stress_way {
	const char *technique;
	uint32_t samples; /* 0: it has no choice */
	char name[48];    /* "pcss-16", or the technique's */
};

/** False past the last one. only: a technique's name, or NULL for all. */
bool stress_way_at(size_t index, const char *only, struct stress_way *way);

/** Draws a subject in every way that has rules: the picture, and the visibility of its first and
 *  its last light; *seen (may be NULL) is that of the first, empty without lights. Also follows
 *  the silhouettes of all casters: at each vertex as many edges start as end. False: *fault says
 *  which rule was broken. */
bool stress_check(struct stress_probe *probe, const struct stress_subject *subject,
	struct stress_picture *seen, struct stress_fault *fault);

/** Builds a scene and checks it. */
bool stress_check_scene(struct stress_probe *probe, const struct stress_scene *scene,
	struct stress_picture *seen, struct stress_fault *fault);

#endif
