/* SPDX-License-Identifier: MIT */
#ifndef APP_STOPWATCH_H
#define APP_STOPWATCH_H

#include "app/facts.h"

/** Where a run spends its time, as named laps. */
struct stopwatch {
	double last; /* ms of the monotonic clock */
	size_t count;
	struct {
		const char *name;
		double ms;
	} laps[12];
};

/** Milliseconds of the monotonic clock. */
double stopwatch_now(void);

/** Milliseconds of processor time of the process so far. */
double stopwatch_processor_time(void);

/** Starts with one lap, "process start": the processor time up to here. */
void stopwatch_start(struct stopwatch *stopwatch);

/** Adds the time since the last lap to `name`, a string that stays; at most 12 different ones. */
void stopwatch_lap(struct stopwatch *stopwatch, const char *name);

/** Reports each lap in ms and in per cent of the sum, and the sum as "total". */
void stopwatch_describe(const struct stopwatch *stopwatch, struct facts *facts);

#endif
