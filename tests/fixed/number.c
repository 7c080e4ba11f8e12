/* SPDX-License-Identifier: MIT */
/* The interface of the exact passes, in both precisions, against integers and doubles. */
#include "fixed/number.h"
#include "nearest.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static bool is_right(uint32_t result, int64_t n, int64_t d)
{
	return is_nearest(result, n, d, 0, 2047);
}

static void fixed12_pairs_give_the_nearest_number(void **state)
{
	(void)state;
	const struct number_model *model = &number_fixed12;
	for (uint32_t a = 0; a <= model->largest; a++) {
		for (uint32_t b = 0; b <= model->largest; b++) {
			assert_true(is_right(model->add(a, b), a + b, 1));
			assert_true(is_right(model->mul(a, b), (int64_t)a * b, 1024));
			if (b > 0)
				assert_true(is_right(model->div(a, b), (int64_t)a * 1024, b));
		}
		assert_int_equal(model->div(a, 0), 2047);
	}
}

/* Whole ranges at first, then ever longer steps up to 22 bits. */
static uint32_t next_integer(uint32_t n)
{
	return n + 1 + n / 97;
}

#define INTEGER_END (1u << 22)

static void fixed12_ratios_are_of_the_integers(void **state)
{
	(void)state;
	for (uint32_t d = 1; d < INTEGER_END; d = next_integer(d))
		for (uint32_t n = 0; n < INTEGER_END; n = next_integer(n))
			assert_true(is_right(number_fixed12.ratio(n, d), (int64_t)n * 1024, d));
	/* Half-way, and beside it. */
	for (uint32_t k = 0; k < 2048; k++) {
		uint32_t tie = 1024 * (2 * k + 1);
		for (uint32_t n = tie - 1; n <= tie + 1; n++)
			assert_true(is_right(
				number_fixed12.ratio(n, 2097152), (int64_t)n * 1024, 2097152));
	}
}

static void fixed12_is_scaled_to_integers(void **state)
{
	(void)state;
	for (uint32_t a = 0; a <= 1024; a++) {
		assert_int_equal(number_fixed12.rest(a), 1024 - a);
		assert_int_equal(number_fixed12.index(a), a);
		assert_true(
			is_nearest(number_fixed12.bytes(a), a * INT64_C(65535), 1024, 0, 65535));
		if (a < 1024)
			assert_int_equal(number_fixed12.weight(a), a);
	}
}

static void half_ratios_are_of_the_rounded_integers(void **state)
{
	(void)state;
	for (uint32_t d = 1; d < INTEGER_END; d = next_integer(d)) {
		for (uint32_t n = 0; n < INTEGER_END; n = next_integer(n)) {
			double exact = nearest_half(ldexp(n, -21)) / nearest_half(ldexp(d, -21));
			uint16_t result = (uint16_t)number_half.ratio(n, d);
			assert_true(value_of_half(result) == nearest_half(exact));
		}
	}
}

static void half_is_scaled_to_integers(void **state)
{
	(void)state;
	for (uint16_t a = 0; a <= 0x3C00; a++) {
		double value = value_of_half(a);
		uint16_t rest = (uint16_t)number_half.rest(a);
		assert_true(value_of_half(rest) == nearest_half(1.0 - value));
		assert_true(number_half.index(a) == floor(1024.0 * value + 0.5));
		assert_true(number_half.bytes(a) == floor(65535.0 * value + 0.5));
	}
	for (uint32_t f = 0; f < 1024; f++)
		assert_true(value_of_half((uint16_t)number_half.weight(f)) == f / 1024.0);
}

/* The others are functions of half.h (half.c tests these), which know signs as well. */
static void half_operations_are_those_of_half(void **state)
{
	(void)state;
	for (uint16_t a = 0; a <= 0x7BFF; a += 3) {
		for (uint16_t b = 0; b <= 0x7BFF; b += 101) {
			double x = value_of_half(a), y = value_of_half(b);
			uint16_t sum = (uint16_t)number_half.add(a, b);
			uint16_t product = (uint16_t)number_half.mul(a, b);
			uint16_t quotient = (uint16_t)number_half.div(a, b);
			assert_true(value_of_half(sum) == nearest_half(x + y));
			assert_true(value_of_half(product) == nearest_half(x * y));
			assert_true(value_of_half(quotient) ==
				    (y > 0.0 ? nearest_half(x / y) : 65504.0));
		}
	}
}

/* A share of what is at most 1 is never above 1: the largest is that of 1 and 1, since no operation
 * falls as an operand grows. */
static void blends_stay_between(void **state)
{
	(void)state;
	const struct number_model *models[] = {&number_fixed12, &number_half};
	for (size_t i = 0; i < 2; i++) {
		const struct number_model *model = models[i];
		for (uint32_t t = 0; t <= model->one; t++) {
			assert_true(model->lerp(model->one, model->one, t) <= model->one);
			assert_int_equal(model->lerp(0, 0, t), 0);
			assert_int_equal(model->lerp(0, model->one, t), t);
			assert_int_equal(model->lerp(model->one, 0, t), model->rest(t));
			uint32_t other = model->one / 3;
			assert_int_equal(model->lerp(t, other, 0), t);
			assert_int_equal(model->lerp(other, t, model->one), t);
			assert_int_equal(model->lerp(other, t, other),
				model->add(model->mul(other, model->rest(other)),
					model->mul(t, other)));
		}
	}
}

static void reals_become_the_nearest_number(void **state)
{
	(void)state;
	for (uint32_t i = 0; i <= 3000000; i++) {
		double x = i / 1234567.0;
		assert_true(is_right(number_fixed12.from_real(x), (int64_t)i * 1024, 1234567));
		uint16_t half = (uint16_t)number_half.from_real(x);
		assert_true(value_of_half(half) == nearest_half(x));
	}
	assert_int_equal(number_fixed12.from_real(1.0), number_fixed12.one);
	assert_int_equal(number_half.from_real(1.0), number_half.one);
	assert_int_equal(number_fixed12.from_real(1e9), number_fixed12.largest);
	assert_int_equal(number_half.from_real(1e9), number_half.largest);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(fixed12_pairs_give_the_nearest_number),
		cmocka_unit_test(fixed12_ratios_are_of_the_integers),
		cmocka_unit_test(fixed12_is_scaled_to_integers),
		cmocka_unit_test(half_ratios_are_of_the_rounded_integers),
		cmocka_unit_test(half_is_scaled_to_integers),
		cmocka_unit_test(half_operations_are_those_of_half),
		cmocka_unit_test(blends_stay_between),
		cmocka_unit_test(reals_become_the_nearest_number),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
