/* SPDX-License-Identifier: MIT */
#include "app/progress.h"
#include "app/stopwatch.h"
#include <stdio.h>
#include <sys/ioctl.h>
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

static int print_counts(const struct progress *progress, uint32_t done, char *text, size_t size)
{
	if (done == 0 || done > progress->total)
		return snprintf(text, size, " %u of %u", done, progress->total);
	uint32_t seconds = seconds_left(progress, done);
	uint32_t hours = seconds / 3600, minutes = seconds / 60 % 60;
	if (hours > 0)
		return snprintf(text, size, " %u of %u, %u:%02u:%02u left", done, progress->total,
			hours, minutes, seconds % 60);
	return snprintf(text, size, " %u of %u, %u:%02u left", done, progress->total, minutes,
		seconds % 60);
}

/* Of the terminal as it is now. */
static int columns(void)
{
	struct winsize size;
	return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/* A line that wraps could not be taken back: the bar gets what the counts leave, and the last
 * column stays free. */
static void print_line(const struct progress *progress, uint32_t done)
{
	static const char bar[] = "########################################";
	char counts[80];
	int room = columns() - 1, used = print_counts(progress, done, counts, sizeof(counts));
	int width = room - used - 2;
	if (width > (int)sizeof(bar) - 1)
		width = (int)sizeof(bar) - 1;
	/* total > 1: enabled says so. */
	int filled = width > 0 ? (int)((uint64_t)done * (uint64_t)width / progress->total) : 0;
	if (width > 0)
		fprintf(stderr, "\r[%-*.*s]%s\033[K", width, filled, bar, counts);
	else
		fprintf(stderr, "\r%.*s\033[K", room, counts + 1);
}

void progress_update(struct progress *progress, uint32_t done)
{
	double now = stopwatch_now();
	if (!progress->enabled || now - progress->start < patience ||
		(progress->shown && now - progress->last < interval))
		return;
	progress->last = now;
	print_line(progress, done);
	fflush(stderr);
	progress->shown = true;
}

void progress_finish(struct progress *progress)
{
	if (progress->shown)
		fputs("\r\033[K", stderr);
	progress->shown = false;
}
