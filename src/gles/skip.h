/* SPDX-License-Identifier: MIT */
#ifndef GLES_SKIP_H
#define GLES_SKIP_H

#include "base/error.h"

/** What is not done again, or not at all, where the picture is the same without it. */
enum skip {
	SKIP_FRAME,
	SKIP_LIGHT,
	SKIP_STATIC,
	SKIP_POINTS,
	SKIP_CASTER,
	SKIP_TRIANGLE,
	SKIP_RECEIVER,
	SKIP_VOLUME,
	SKIP_VIEW,
	SKIP_DIM,
	SKIP_COUNT,
};

/** Which are off, and how often each was asked for and granted. Zero: all are on. */
struct skips {
	bool off[SKIP_COUNT];
	struct sm_skip_stats stats[SKIP_COUNT];
};

/** NULL past the last. */
const char *skip_name(size_t index);
const char *skip_summary(size_t index);

/** Turns skips off and on, as sm_renderer_set_skips(); on failure nothing has changed. */
bool skips_set(struct skips *skips, const char *list, struct sm_error *error);

/** Whether something is skipped, that could be or not; counts it. One that is off tests nothing. */
bool skip_take(struct skips *skips, enum skip skip, bool could);

/** The same of so many at once, of which some were skipped. */
void skip_count(struct skips *skips, enum skip skip, size_t tested, size_t skipped);

#endif
