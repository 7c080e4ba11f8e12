/* SPDX-License-Identifier: MIT */
/* Percentiles of numbers, against values computed by hand. */
#include "bench/statistics.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static void test_percentiles_are_linear_between_neighbours(void **state)
{
	(void)state;
	static const struct {
		double values[10];
		size_t count;
		double p0, p10, median, p90, p100;
	} cases[] = {
		{{0}, 0, 0, 0, 0, 0, 0},
		{{7}, 1, 7, 7, 7, 7, 7},
		{{1, 3}, 2, 1, 1.2, 2, 2.8, 3},
		{{1, 2, 10}, 3, 1, 1.2, 2, 8.4, 10},
		{{-4, -2, 2, 4}, 4, -4, -3.4, 0, 3.4, 4},
		{{5, 5, 5, 5, 5}, 5, 5, 5, 5, 5, 5},
		{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 10, 0, .9, 4.5, 8.1, 9},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		const double shares[] = {0, .1, .5, .9, 1};
		const double wanted[] = {
			cases[i].p0, cases[i].p10, cases[i].median, cases[i].p90, cases[i].p100};
		for (size_t k = 0; k < COUNT(shares); k++) {
			double found =
				statistics_percentile(cases[i].values, cases[i].count, shares[k]);
			if (fabs(found - wanted[k]) > 1e-12)
				fail_msg("case %zu at %g: %g, not %g", i, shares[k], found,
					wanted[k]);
		}
	}
}

static void test_a_median_needs_no_order(void **state)
{
	(void)state;
	double odd[] = {9, 1, 5}, even[] = {8, 2, 1, 100}, one[] = {-3};
	assert_float_equal(statistics_median(odd, 3), 5, 0);
	assert_float_equal(statistics_median(even, 4), 5, 0);
	assert_float_equal(statistics_median(one, 1), -3, 0);
	assert_float_equal(statistics_median(NULL, 0), 0, 0);
}

static void test_sorting_keeps_every_number(void **state)
{
	(void)state;
	double values[] = {3, -1, 3, 0, INFINITY, -INFINITY, 1e-300};
	static const double sorted[] = {-INFINITY, -1, 0, 1e-300, 3, 3, INFINITY};
	statistics_sort(values, COUNT(values));
	assert_memory_equal(values, sorted, sizeof(sorted));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_percentiles_are_linear_between_neighbours),
		cmocka_unit_test(test_a_median_needs_no_order),
		cmocka_unit_test(test_sorting_keeps_every_number),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
