/* SPDX-License-Identifier: MIT */
#include "app/stopwatch.h"
#include <assert.h>
#include <string.h>
#include <time.h>

static double read_clock(clockid_t clock)
{
	struct timespec time;
	clock_gettime(clock, &time);
	return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

double stopwatch_now(void)
{
	return read_clock(CLOCK_MONOTONIC);
}

double stopwatch_processor_time(void)
{
	return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}

/* Before main() runs the dynamic linker, which computes: its processor time is its duration, and
 * finer than the 10 ms of the start time in /proc. */
void stopwatch_start(struct stopwatch *stopwatch)
{
	*stopwatch = (struct stopwatch){
		.last = stopwatch_now(),
		.count = 1,
		.laps = {{"process start", stopwatch_processor_time()}},
	};
}

void stopwatch_lap(struct stopwatch *stopwatch, const char *name)
{
	double now = stopwatch_now();
	size_t lap = 0;
	while (lap < stopwatch->count && strcmp(stopwatch->laps[lap].name, name) != 0)
		lap++;
	assert(lap < sizeof(stopwatch->laps) / sizeof(stopwatch->laps[0]));
	if (lap == stopwatch->count)
		stopwatch->count++;
	stopwatch->laps[lap].name = name;
	stopwatch->laps[lap].ms += now - stopwatch->last;
	stopwatch->last = now;
}

void stopwatch_describe(const struct stopwatch *stopwatch, struct facts *facts)
{
	double total = 0;
	for (size_t i = 0; i < stopwatch->count; i++)
		total += stopwatch->laps[i].ms;
	for (size_t i = 0; i < stopwatch->count; i++) {
		/* total > 0: the process has used processor time to come here. */
		double share = 100 * stopwatch->laps[i].ms / total;
		facts_format(facts, stopwatch->laps[i].name, "%.2f ms (%.1f %%)",
			stopwatch->laps[i].ms, share);
	}
	facts_format(facts, "total", "%.2f ms", total);
}
