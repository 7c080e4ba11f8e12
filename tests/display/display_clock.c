/* SPDX-License-Identifier: MIT */
/* Vertical blanks are counted right, whether or not the driver waits for them. */
#include "display_clock.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#define MS INT64_C(1000000)
#define START (1000000 * MS)

static struct display_clock clock_of(uint32_t hz)
{
	return (struct display_clock){.refresh = {hz, 1}};
}

static void blanks_are_counted_by_their_times(void **state)
{
	(void)state;
	static const struct {
		int64_t time; /* ms, of a display that is 1 % slower than it says */
		uint64_t steps;
	} flips[] = {{0, 0}, {101, 1}, {202, 1}, {505, 3}, {505 + 101 * 40, 40}};
	struct display_clock clock = clock_of(10);
	uint64_t tick = 0;
	assert_int_equal(display_clock_next(&clock), 0);
	for (size_t i = 0; i < sizeof(flips) / sizeof(flips[0]); i++) {
		int64_t time = START + flips[i].time * MS;
		assert_int_equal(display_clock_flip(&clock, true, time), flips[i].steps);
		tick += flips[i].steps;
		assert_int_equal(clock.tick, tick);
		assert_int_equal(display_clock_next(&clock), time);
	}
}

/* Each blank is a bit late: that must not add up to one that was missed. */
static void a_slow_display_misses_no_blank(void **state)
{
	(void)state;
	struct display_clock clock = clock_of(100);
	for (int i = 0; i <= 1000; i++)
		display_clock_flip(&clock, true, START + i * (10 * MS + MS / 100));
	assert_int_equal(clock.tick, 1000);
}

static void what_is_kept_is_counted(void **state)
{
	(void)state;
	for (int waits = 0; waits < 2; waits++) {
		struct display_clock clock = clock_of(100);
		int64_t first = START + (waits ? 0 : 10 * MS);
		display_clock_flip(&clock, waits, START);
		for (int i = 1; i <= 5; i++) {
			display_clock_keep(&clock, START);
			assert_int_equal(clock.kept, i);
			assert_int_equal(display_clock_next(&clock), first + i * 10 * MS);
		}
		/* A pause leaves ticks out. */
		display_clock_keep(&clock, START + 1000 * MS);
		assert_int_equal(clock.kept, 100);
		assert_int_equal(display_clock_flip(&clock, waits, START + 1010 * MS), 101);
		assert_int_equal(clock.kept, 0);
		assert_int_equal(clock.tick, 101);
	}
}

static void without_blanks_nothing_is_lost(void **state)
{
	(void)state;
	struct display_clock clock = clock_of(100);
	assert_int_equal(display_clock_flip(&clock, false, START), 0);
	assert_int_equal(display_clock_next(&clock), START + 10 * MS);
	/* Early by a trifle, late by the time of drawing. */
	assert_int_equal(display_clock_flip(&clock, false, START + 10 * MS - MS / 2), 1);
	assert_int_equal(display_clock_flip(&clock, false, START + 28 * MS), 1);
	assert_int_equal(display_clock_next(&clock), START + 30 * MS);
	assert_int_equal(display_clock_flip(&clock, false, START + 61 * MS), 4);
	/* An hour. */
	assert_int_equal(display_clock_flip(&clock, false, START + 3600060 * MS), 360000);
	assert_int_equal(clock.tick, 360006);
	/* Clocks do not run backwards, but drivers do. */
	assert_int_equal(display_clock_flip(&clock, false, START), 0);
}

/* A frame begins when the next may be shown, and takes its time. */
static void drawing_does_not_slow_the_clock(void **state)
{
	(void)state;
	static const struct {
		int64_t drawing; /* ms */
		uint64_t frames; /* in a second of ticks */
	} cases[] = {{0, 100}, {1, 100}, {5, 100}, {8, 100}, {12, 50}, {18, 50}, {23, 34}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct display_clock clock = clock_of(100);
		int64_t now = START;
		uint64_t frames = 0;
		display_clock_flip(&clock, false, now);
		for (; clock.tick < 100; frames++) {
			if (now < display_clock_next(&clock))
				now = display_clock_next(&clock);
			now += cases[i].drawing * MS;
			display_clock_flip(&clock, false, now);
		}
		assert_int_equal(frames, cases[i].frames);
		int64_t ahead = (int64_t)clock.tick * 10 * MS - (now - START);
		assert_true(ahead <= 0 && ahead > -30 * MS);
	}
}

static void frames_that_do_not_wait_advance_it_too(void **state)
{
	(void)state;
	struct display_clock clock = clock_of(100);
	for (int i = 0; i <= 1000; i++)
		display_clock_flip(&clock, false, START + i * MS);
	assert_int_equal(clock.tick, 100);
}

static void a_new_rate_keeps_the_time(void **state)
{
	(void)state;
	struct display_clock clock = clock_of(60);
	display_clock_set_refresh(&clock, (struct refresh){50, 1});
	assert_int_equal(clock.tick, 0);
	clock = clock_of(60);
	display_clock_flip(&clock, true, START);
	display_clock_flip(&clock, true, START + 10000 * MS);
	display_clock_set_refresh(&clock, (struct refresh){24000, 1001});
	assert_int_equal(clock.tick, 240); /* 239.76 */
	assert_int_equal(display_clock_period(&clock), 41708333);
	display_clock_set_refresh(&clock, (struct refresh){UINT32_MAX, 1});
	assert_int_equal(display_clock_period(&clock), 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(blanks_are_counted_by_their_times),
		cmocka_unit_test(a_slow_display_misses_no_blank),
		cmocka_unit_test(what_is_kept_is_counted),
		cmocka_unit_test(without_blanks_nothing_is_lost),
		cmocka_unit_test(drawing_does_not_slow_the_clock),
		cmocka_unit_test(frames_that_do_not_wait_advance_it_too),
		cmocka_unit_test(a_new_rate_keeps_the_time),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
