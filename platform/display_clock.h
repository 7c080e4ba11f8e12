/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_DISPLAY_CLOCK_H
#define PLATFORM_DISPLAY_CLOCK_H

#include "kms_mode.h"

/**
 * Counts the vertical blanks of a display since its first frame, by the times at which page-flip
 * events say that frames appeared. The drivers' own counts would be no better: they jump when
 * blanks were switched off in between, and virtual displays have none.
 *
 * Zero, with a refresh, is a clock that has not started.
 */
struct display_clock {
	struct refresh refresh;
	uint64_t tick; /* of the frame that is shown, from which on */
	uint64_t kept; /* so many ticks more it stays */
	int64_t time;  /* ns of the monotonic clock at which the tick was */
	bool started;
	bool waits; /* the driver waits for vertical blanks; virtual ones do not */
};

/** A new rate from here on; the time that the ticks stand for stays. */
void display_clock_set_refresh(struct display_clock *clock, struct refresh refresh);

/** A frame has appeared. waits: the driver has waited for a vertical blank to show it. Returns the
 *  ticks since the frame before, 0 for the first. */
uint64_t display_clock_flip(struct display_clock *clock, bool waits, int64_t time);

/** The frame that is shown stays for the next tick too, and for those that are over by `now`. */
void display_clock_keep(struct display_clock *clock, int64_t now);

/** Length of a tick, ns. */
int64_t display_clock_period(const struct display_clock *clock);

/** ns of the monotonic clock from which on the next frame may be shown: drivers that do not wait
 *  for the vertical blank leave that to us. */
int64_t display_clock_next(const struct display_clock *clock);

#endif
