/* SPDX-License-Identifier: MIT */
#include "display_state.h"
#include <time.h>

static int64_t read_clock(clockid_t clock)
{
	struct timespec time;
	clock_gettime(clock, &time);
	return time.tv_sec * SECOND + time.tv_nsec;
}

int64_t display_now(void)
{
	return read_clock(CLOCK_MONOTONIC);
}

int64_t display_thread_time(void)
{
	return read_clock(CLOCK_THREAD_CPUTIME_ID);
}

/* Without a word yet: a seat manager takes a device away before it says that it takes the seat. */
void display_lose_master(struct display *display)
{
	display->mode_set = false;
	display->lost_master = true;
	display->told_loss = false;
	display->next_take = display_now() + SECOND;
}

uint64_t display_tick(const struct display *display)
{
	const struct display_clock *clock = &display->clock;
	return clock->started ? clock->tick + 1 + clock->kept : 0;
}

void display_keep(struct display *display)
{
	display_clock_keep(&display->clock, display_now());
}
