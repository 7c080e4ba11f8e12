/* SPDX-License-Identifier: MIT */
#include "app/progress.h"
#include "app/stopwatch.h"
#include <stdio.h>
#include <unistd.h>

static const double patience = 2000; /* ms */

void progress_start(struct progress *progress, uint32_t total, bool quiet)
{
	*progress = (struct progress){
		.start = stopwatch_now(),
		.total = total,
		.enabled = !quiet && total > 1 && isatty(STDERR_FILENO),
	};
}

void progress_update(struct progress *progress, uint32_t done)
{
	static const char bar[] = "########################################";
	const int width = sizeof(bar) - 1;
	if (!progress->enabled || stopwatch_now() - progress->start < patience)
		return;
	/* total > 1: enabled says so. */
	int filled = (int)((uint64_t)done * (uint64_t)width / progress->total);
	fprintf(stderr, "\r[%-*.*s] %u of %u", width, filled, bar, done, progress->total);
	fflush(stderr);
	progress->shown = true;
}

void progress_finish(struct progress *progress)
{
	if (progress->shown)
		fputs("\r\033[K", stderr);
	progress->shown = false;
}
