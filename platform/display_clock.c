/* SPDX-License-Identifier: MIT */
#include "display_clock.h"

int64_t display_clock_period(const struct display_clock *clock)
{
	/* Both are 1 or more, says mode_refresh(). */
	return (int64_t)(UINT64_C(1000000000) * clock->refresh.denominator /
			 clock->refresh.numerator);
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
	uint64_t steps = 0;
	/* period > 0: rates end well below 1 GHz. */
	if (clock->started && time > clock->time)
		steps = (uint64_t)((time - clock->time + period / 2) / period);
	clock->tick += steps;
	clock->time = time;
	clock->waits = waits;
	clock->started = true;
	return steps;
}

int64_t display_clock_next(const struct display_clock *clock)
{
	return clock->waits || !clock->started ? clock->time
					       : clock->time + display_clock_period(clock);
}
