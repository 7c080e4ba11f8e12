/* SPDX-License-Identifier: MIT */
/* What a frame costs outside GL: events, bookkeeping, commit, and the copy of 64x48 pixels to a
 * dumb buffer. The fake device's own work, which is counted along, stands for the kernel's. Fails
 * where a frame takes more than 0.3 ms of processor time, or allocates. */
#include "display.h"
#include "allocations.h"
#include "fake_drm.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { FRAMES = 20000, WARM_UP = 100 };
static const double limit = 0.3; /* ms */

static const struct {
	const char *name;
	struct fake_abilities can;
	struct display_options options;
} cases[] = {
	{"atomic", {0}, {0}},
	{"atomic, with damage", {.damage = true}, {0}},
	{"legacy", {.no_atomic = true}, {0}},
	{"legacy, no universal planes", {.no_atomic = true, .no_universal_planes = true}, {0}},
	{"atomic, no vertical blanks", {.no_blanks = true}, {0}},
	{"without vsync", {.async_flip = true}, {.async = true}},
};

static double thread_time(void)
{
	struct timespec time;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
	return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

/* One frame, from the wait for the last to the commit. */
static bool show(struct display *display, struct sm_error *error)
{
	static uint8_t rgba[64 * 48 * 4];
	struct display_target target;
	for (;;) {
		struct pollfd fds[DISPLAY_POLL_MAX];
		int64_t timeout;
		if (!display_update(display, error))
			return false;
		if (display_wants_frame(display, true))
			break;
		size_t count = display_poll(display, fds, &timeout);
		fake_world_poll(fds, count, timeout);
	}
	rgba[rand() % sizeof(rgba)]++;
	return display_begin(display, &target, error) && display_end(display, rgba, error);
}

/* times: [FRAMES], ms. Returns the allocations, or -1. */
static long measure(struct display *display, double *times, struct sm_error *error)
{
	for (int i = 0; i < WARM_UP; i++)
		if (!show(display, error))
			return -1;
	if (allocations == 0) /* of the start: they are not counted */
		return -1;
	allocations = 0;
	for (int i = 0; i < FRAMES; i++) {
		double start = thread_time();
		if (!show(display, error))
			return -1;
		times[i] = thread_time() - start;
	}
	return (long)allocations;
}

static int compare(const void *a, const void *b)
{
	double first = *(const double *)a, second = *(const double *)b;
	return (first > second) - (first < second);
}

static bool run(size_t index, double *times)
{
	struct sm_error error = {.text = "the allocations are not counted"};
	fake_world_reset();
	fake_drm_init(0, &cases[index].can);
	struct display *display = display_create(&cases[index].options, &error);
	long count = display != NULL ? measure(display, times, &error) : -1;
	display_destroy(display);
	fake_drm_finish();
	if (count < 0) {
		fprintf(stderr, "%s: %s\n", cases[index].name, error.text);
		return false;
	}
	qsort(times, FRAMES, sizeof(*times), compare);
	double p99 = times[FRAMES / 100 * 99];
	printf("%-28s %9.4f %9.4f %9.4f %12ld\n", cases[index].name, times[FRAMES / 2], p99,
		times[FRAMES - 1], count);
	return p99 <= limit && count == 0;
}

int main(void)
{
	static double times[FRAMES];
	bool passed = true;
	printf("%d frames: ms of processor time each, at most %.1f for 99 %%\n\n", FRAMES, limit);
	printf("%-28s %9s %9s %9s %12s\n", "", "median", "p99", "max", "allocations");
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		passed = run(i, times) && passed;
	return passed ? EXIT_SUCCESS : EXIT_FAILURE;
}
