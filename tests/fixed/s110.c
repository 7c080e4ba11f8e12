/* SPDX-License-Identifier: MIT */
/* Each function of two numbers over all pairs of them, 16.7 million. */
#include "fixed/s110.h"
#include "nearest.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static bool is_right(int result, int64_t n, int64_t d)
{
	return is_nearest(result, n, d, -2048, 2047);
}

static bool sum_is_right(int result, int a, int b)
{
	return is_right(result, (int64_t)a + b, 1);
}

static bool difference_is_right(int result, int a, int b)
{
	return is_right(result, (int64_t)a - b, 1);
}

/* a/1024 b/1024 in steps of 1/1024. */
static bool product_is_right(int result, int a, int b)
{
	return is_right(result, (int64_t)a * b, 1024);
}

static bool quotient_is_right(int result, int a, int b)
{
	if (b == 0)
		return result == (a < 0 ? -2048 : 2047);
	return is_right(result, b < 0 ? (int64_t)a * -1024 : (int64_t)a * 1024, b < 0 ? -b : b);
}

static const struct {
	const char *name;
	int (*function)(int, int);
	bool (*is_right)(int result, int a, int b);
} functions[] = {
	{"add", s110_add, sum_is_right},
	{"subtract", s110_subtract, difference_is_right},
	{"multiply", s110_multiply, product_is_right},
	{"divide", s110_divide, quotient_is_right},
};

static void all_pairs_give_the_nearest_number(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof(functions) / sizeof(functions[0]); i++) {
		for (int a = -2048; a < 2048; a++) {
			for (int b = -2048; b < 2048; b++) {
				int result = functions[i].function(a, b);
				if (!functions[i].is_right(result, a, b))
					fail_msg("%s of %d and %d gives %d", functions[i].name, a,
						b, result);
			}
		}
	}
}

/* n / 1024 to the nearest, halves up, into the range. */
static int nearest_product(int a, int b)
{
	double product = floor((double)a * b / 1024.0 + 0.5);
	return (int)fmin(fmax(product, -2048.0), 2047.0);
}

static void lerp_rounds_each_product_and_the_sum(void **state)
{
	(void)state;
	static const int weights[] = {-2048, -1, 0, 1, 2, 333, 512, 777, 1023, 1024, 1500, 2047};
	for (size_t i = 0; i < sizeof(weights) / sizeof(weights[0]); i++) {
		int t = weights[i], rest = t < -1023 ? 2047 : 1024 - t;
		int first[4096], second[4096];
		for (int a = -2048; a < 2048; a++) {
			first[a + 2048] = nearest_product(a, rest);
			second[a + 2048] = nearest_product(a, t);
		}
		for (int a = -2048; a < 2048; a++) {
			for (int b = -2048; b < 2048; b++) {
				int result = s110_lerp(a, b, t);
				int sum = first[a + 2048] + second[b + 2048];
				if (!is_right(result, sum, 1))
					fail_msg("lerp of %d and %d by %d gives %d", a, b, t,
						result);
			}
		}
	}
}

static void saturation_keeps_what_is_in_range(void **state)
{
	(void)state;
	for (int steps = -5000; steps <= 5000; steps++)
		assert_true(is_right(s110_saturate(steps), steps, 1));
	assert_int_equal(s110_saturate(INT64_MIN), -2048);
	assert_int_equal(s110_saturate(INT64_MAX), 2047);
}

static void reals_round_to_the_nearest_number(void **state)
{
	(void)state;
	for (int a = -2048; a < 2048; a++) {
		assert_true(s110_to_real(a) * 1024.0 == a);
		assert_int_equal(s110_from_real(s110_to_real(a)), a);
		double half_way = (a + 0.5) / 1024.0;
		int above = a == 2047 ? a : a + 1;
		assert_int_equal(s110_from_real(half_way), above);
		assert_int_equal(s110_from_real(nextafter(half_way, -3.0)), a);
		assert_int_equal(s110_from_real(nextafter(half_way, 3.0)), above);
	}
	assert_int_equal(s110_from_real(-1e-300), 0);
	assert_int_equal(s110_from_real(-INFINITY), -2048);
	assert_int_equal(s110_from_real(INFINITY), 2047);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(all_pairs_give_the_nearest_number),
		cmocka_unit_test(lerp_rounds_each_product_and_the_sum),
		cmocka_unit_test(saturation_keeps_what_is_in_range),
		cmocka_unit_test(reals_round_to_the_nearest_number),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
