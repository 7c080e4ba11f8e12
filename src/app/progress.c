/* SPDX-License-Identifier: MIT */
#include "app/progress.h"
#include "app/stopwatch.h"
#include <stdio.h>
#include <unistd.h>

static const double patience = 2000, interval = 100; /* ms */

void progress_start(struct progress *progress, uint32_t total, bool quiet)
{
	*progress = (struct progress){
		.start = stopwatch_now(),
		.total = total,
		.enabled = !quiet && total > 1 && isatty(STDERR_FILENO),
	};
}

/* At the speed so far. */
static uint32_t seconds_left(const struct progress *progress, uint32_t done)
{
	double ms = stopwatch_now() - progress->start;
	/* done > 0: the caller asks only then. */
	return (uint32_t)(ms / 1000 * (progress->total - done) / done + 0.5);
}

static void print_time_left(const struct progress *progress, uint32_t done)
{
	uint32_t seconds = seconds_left(progress, done);
	uint32_t hours = seconds / 3600, minutes = seconds / 60 % 60;
	if (hours > 0)
		fprintf(stderr, ", %u:%02u:%02u left", hours, minutes, seconds % 60);
	else
		fprintf(stderr, ", %u:%02u left", minutes, seconds % 60);
}

void progress_update(struct progress *progress, uint32_t done)
{
	static const char bar[] = "########################################";
	const int width = sizeof(bar) - 1;
	double now = stopwatch_now();
	if (!progress->enabled || now - progress->start < patience ||
		(progress->shown && now - progress->last < interval))
		return;
	progress->last = now;
	/* total > 1: enabled says so. */
	int filled = (int)((uint64_t)done * (uint64_t)width / progress->total);
	fprintf(stderr, "\r[%-*.*s] %u of %u", width, filled, bar, done, progress->total);
	if (done > 0 && done <= progress->total)
		print_time_left(progress, done);
	fputs("\033[K", stderr);
	fflush(stderr);
	progress->shown = true;
}

void progress_finish(struct progress *progress)
{
	if (progress->shown)
		fputs("\r\033[K", stderr);
	progress->shown = false;
}
