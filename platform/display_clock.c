/* SPDX-License-Identifier: MIT */
#include "display_clock.h"

int64_t display_clock_period(const struct display_clock *clock)
{
	/* Both are 1 or more, says mode_refresh(); broken modes may blank faster than times are. */
	uint64_t period =
		UINT64_C(1000000000) * clock->refresh.denominator / clock->refresh.numerator;
	return period > 0 ? (int64_t)period : 1;
}

void display_clock_set_refresh(struct display_clock *clock, struct refresh refresh)
{
	if (clock->started) {
		double seconds =
			(double)clock->tick * clock->refresh.denominator / clock->refresh.numerator;
		clock->tick = (uint64_t)(seconds * refresh.numerator / refresh.denominator + 0.5);
	}
	clock->refresh = refresh;
}

uint64_t display_clock_flip(struct display_clock *clock, bool waits, int64_t time)
{
	int64_t period = display_clock_period(clock);
	int64_t elapsed = clock->started && time > clock->time ? time - clock->time : 0;
	uint64_t steps;
	if (waits) {
		/* Times of blanks: whole periods apart, but for the clock's own deviation. */
		steps = (uint64_t)((elapsed + period / 2) / period);
		clock->time = time;
	} else {
		/* At any time: what is left over of a period counts for the next frame. One that
		 * waited by itself may be early by a trifle. */
		steps = (uint64_t)((elapsed + period / 8) / period);
		clock->time = clock->started ? clock->time + (int64_t)steps * period : time;
	}
	clock->tick += steps;
	clock->kept = 0;
	clock->waits = waits;
	clock->started = true;
	return steps;
}

void display_clock_keep(struct display_clock *clock, int64_t now)
{
	int64_t passed = (now - clock->time) / display_clock_period(clock);
	clock->kept++;
	if (passed > (int64_t)clock->kept)
		clock->kept = (uint64_t)passed;
}

int64_t display_clock_next(const struct display_clock *clock)
{
	int64_t period = display_clock_period(clock);
	int64_t kept = (int64_t)clock->kept * period;
	return clock->time + kept + (clock->waits || !clock->started ? 0 : period);
}
