/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_DISPLAY_CLOCK_H
#define PLATFORM_DISPLAY_CLOCK_H

#include "kms_mode.h"

/** Counts the vertical blanks of a display since its first frame, from what page-flip events tell.
 *  Zero, with a refresh, is a clock that has not started. */
struct display_clock {
	struct refresh refresh;
	uint64_t tick;  /* of the frame that is shown */
	int64_t time;   /* ns of the monotonic clock at which it appeared */
	uint32_t count; /* the driver's own, then */
	bool started;
	bool counts; /* the driver counts and waits for vertical blanks; virtual ones do not */
};

/** A new rate from here on; the time that the ticks stand for stays. */
void display_clock_set_refresh(struct display_clock *clock, struct refresh refresh);

/**
 * A frame has appeared. count: of vertical blanks by the driver, 0: it has none.
 * by_time: its counts before and after have nothing in common, as when a mode was set.
 * Returns the ticks since the frame before, 0 for the first.
 */
uint64_t display_clock_flip(
	struct display_clock *clock, uint32_t count, int64_t time, bool by_time);

/** Length of a tick, ns. */
int64_t display_clock_period(const struct display_clock *clock);

/** ns of the monotonic clock from which on the next frame may be shown: drivers that do not wait
 *  for the vertical blank leave that to us. */
int64_t display_clock_next(const struct display_clock *clock);

#endif
