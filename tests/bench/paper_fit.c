/* SPDX-License-Identifier: MIT */
#include "bench/paper_fit.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static void correlation_tells_how_far_values_go_together(void **state)
{
	static const struct {
		double x[5], y[5];
		double expected; /* NAN: none */
	} cases[] = {
		{{1, 2, 3, 4, 5}, {10, 20, 30, 40, 50}, 1},
		{{1, 2, 3, 4, 5}, {5, 4, 3, 2, 1}, -1},
		{{1, 2, 3, 4, 5}, {1, -2, 2, -2, 1}, 0},
		{{1, 2, 3, 4, 5}, {1, 3, 2, 5, 4}, .8},
		{{1, 2, NAN, 4, 5}, {1, 2, 100, 4, 5}, 1},
		{{1, 2, NAN, NAN, NAN}, {1, 2, 3, 4, 5}, NAN},
		{{7, 7, 7, 7, 7}, {1, 2, 3, 4, 5}, NAN},
		{{1, 2, 3, 4, 5}, {7, 7, 7, 7, 7}, NAN},
	};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		double got = fit_correlation(cases[i].x, cases[i].y, 5);
		if (isnan(cases[i].expected))
			assert_true(isnan(got));
		else
			assert_true(fabs(got - cases[i].expected) < 1e-12);
	}
}

static void an_exponent_is_found(void **state)
{
	static const double exponents[] = {0, .5, 1, 2};
	(void)state;
	for (size_t i = 0; i < COUNT(exponents); i++) {
		double x[6], y[6];
		for (int k = 0; k < 6; k++) {
			x[k] = pow(10, k);
			y[k] = 3 * pow(x[k], exponents[i]);
		}
		assert_true(fabs(fit_exponent(x, y, 6) - exponents[i]) < 1e-12);
		/* What has no logarithm is passed over. */
		y[0] = 0;
		y[5] = NAN;
		assert_true(fabs(fit_exponent(x, y, 6) - exponents[i]) < 1e-12);
		assert_true(isnan(fit_exponent(x, y, 3)));
	}
}

static void two_shares_are_told_apart(void **state)
{
	static const double a[] = {1000, 2000, 3000, 5000}, b[] = {10, 300, 20, 900};
	double y[4], p, q;
	(void)state;
	for (int i = 0; i < 4; i++)
		y[i] = 2 * a[i] + 50 * b[i];
	assert_true(fit_two(a, b, y, 4, &p, &q));
	assert_true(fabs(p - 2) < 1e-9 && fabs(q - 50) < 1e-9);
}

static void parallel_columns_are_no_two(void **state)
{
	static const double a[] = {1, 2, 3}, b[] = {10, 20, 30}, y[] = {5, 6, 9};
	double p, q;
	(void)state;
	assert_false(fit_two(a, b, y, 3, &p, &q));
	assert_false(fit_two(a, b, y, 0, &p, &q));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(correlation_tells_how_far_values_go_together),
		cmocka_unit_test(an_exponent_is_found),
		cmocka_unit_test(two_shares_are_told_apart),
		cmocka_unit_test(parallel_columns_are_no_two),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
