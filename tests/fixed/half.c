/* SPDX-License-Identifier: MIT */
/*
 * binary16 against double. Sums, differences and products of two halfs are exact in a double: they
 * are multiples of 2^-24 below 2^17, and have 22 digits. A quotient is not, but rounding it twice
 * does no harm: what lies half-way between two halfs has 12 digits at most, so that a quotient of
 * 11-digit integers that is not there itself is off by more than 2^-24 of it, a double by less than
 * 2^-53 (Figueroa 1995).
 */
#include "fixed/half.h"
#include "nearest.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define SIGN 0x8000
#define MAX 0x7BFF

static double values[0x10000]; /* by bits */

static int set_up(void **state)
{
	(void)state;
	for (unsigned int bits = 0; bits < 0x10000; bits++)
		values[bits] = value_of_half((uint16_t)bits);
	return 0;
}

static double sum(double a, double b)
{
	return a + b;
}

static double difference(double a, double b)
{
	return a - b;
}

static double product(double a, double b)
{
	return a * b;
}

static double quotient(double a, double b)
{
	if (b == 0.0)
		return signbit(a) == signbit(b) ? INFINITY : -INFINITY;
	return a / b;
}

enum operation { ADD, SUBTRACT, MULTIPLY, DIVIDE, OPERATIONS };

static const struct {
	const char *name;
	uint16_t (*function)(uint16_t, uint16_t);
	double (*truth)(double, double);
} operations[OPERATIONS] = {
	[ADD] = {"add", half_add, sum},
	[SUBTRACT] = {"subtract", half_subtract, difference},
	[MULTIPLY] = {"multiply", half_multiply, product},
	[DIVIDE] = {"divide", half_divide, quotient},
};

static void check(enum operation operation, uint16_t a, uint16_t b)
{
	uint16_t result = operations[operation].function(a, b);
	double truth = nearest_half(operations[operation].truth(values[a], values[b]));
	if (!is_same(values[result], truth))
		fail_msg("%s of 0x%04x and 0x%04x gives 0x%04x, not %a", operations[operation].name,
			a, b, result, truth);
}

/* The ends of what subnormal, normal and power of two are, and a spread of all there is. */
static size_t list_operands(uint16_t *list)
{
	static const uint16_t ends[] = {0x0000, 0x0001, 0x0002, 0x0003, 0x01FF, 0x0200, 0x03FF,
		0x0400, 0x0401, 0x07FF, 0x0800, 0x2BFF, 0x2C00, 0x3800, 0x3BFE, 0x3BFF, 0x3C00,
		0x3C01, 0x3C02, 0x3FFF, 0x4000, 0x4001, 0x4200, 0x7800, 0x7BFE, 0x7BFF};
	size_t count = 0;
	for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); i++) {
		list[count++] = ends[i];
		list[count++] = ends[i] | SIGN;
	}
	for (uint16_t bits = 517; bits <= MAX; bits += 1031)
		list[count++] = bits;
	return count;
}

static void each_number_works_with_a_spread_of_others(void **state)
{
	(void)state;
	uint16_t others[128];
	size_t count = list_operands(others);
	for (size_t i = 0; i < count; i++) {
		for (uint16_t a = 0; a <= MAX; a++) {
			for (enum operation operation = 0; operation < OPERATIONS; operation++) {
				check(operation, a, others[i]);
				check(operation, a | SIGN, others[i]);
			}
			check(SUBTRACT, others[i], a);
			check(DIVIDE, others[i], a);
		}
	}
}

/* Exponents as they are stored, from 0, which is that of subnormals. */
static void check_digits(enum operation operation, unsigned int a, unsigned int b)
{
	for (unsigned int i = 0; i < 1024; i++)
		for (unsigned int j = 0; j < 1024; j++)
			check(operation, (uint16_t)(a << 10 | i), (uint16_t)(b << 10 | j));
}

static void all_digits_work_with_all_others(void **state)
{
	(void)state;
	/* As far apart as still matters, and one more. */
	for (unsigned int apart = 0; apart <= 14; apart++) {
		check_digits(ADD, 16, 16 - apart);
		check_digits(SUBTRACT, 16, 16 - apart);
	}
	static const unsigned int factors[][2] = {
		{15, 15}, {15, 14}, {8, 7}, {4, 6}, {0, 15}, {0, 20}, {30, 15}, {22, 23}};
	for (size_t i = 0; i < sizeof(factors) / sizeof(factors[0]); i++)
		check_digits(MULTIPLY, factors[i][0], factors[i][1]);
	static const unsigned int quotients[][2] = {
		{15, 15}, {15, 0}, {0, 0}, {0, 8}, {4, 18}, {1, 20}, {30, 15}, {30, 14}};
	for (size_t i = 0; i < sizeof(quotients) / sizeof(quotients[0]); i++)
		check_digits(DIVIDE, quotients[i][0], quotients[i][1]);
}

static void lerp_rounds_each_step(void **state)
{
	(void)state;
	uint16_t others[128];
	size_t count = list_operands(others);
	for (size_t i = 0; i < count; i++) {
		for (size_t j = 0; j < count; j++) {
			for (unsigned int t = 0; t <= HALF_ONE; t += 37) {
				double a = values[others[i]], b = values[others[j]];
				double rest = nearest_half(1.0 - values[t]);
				double truth = nearest_half(
					nearest_half(a * rest) + nearest_half(b * values[t]));
				uint16_t result = half_lerp(others[i], others[j], (uint16_t)t);
				assert_true(is_same(values[result], truth));
			}
		}
	}
}

static void bits_and_reals_are_one(void **state)
{
	(void)state;
	for (uint16_t bits = 0; bits <= MAX; bits++) {
		for (int sign = 0; sign <= 1; sign++) {
			uint16_t signed_bits = sign ? bits | SIGN : bits;
			assert_true(is_same(half_to_real(signed_bits), values[signed_bits]));
			assert_int_equal(half_from_real(values[signed_bits]), signed_bits);
		}
	}
}

static void reals_round_to_the_nearest_number(void **state)
{
	(void)state;
	for (uint16_t bits = 0; bits < MAX; bits++) {
		double tie = (values[bits] + values[bits + 1]) / 2.0;
		uint16_t even = bits % 2 == 0 ? bits : bits + 1;
		assert_int_equal(half_from_real(nextafter(tie, 0.0)), bits);
		assert_int_equal(half_from_real(tie), even);
		assert_int_equal(half_from_real(-tie), even | SIGN);
		assert_int_equal(half_from_real(nextafter(tie, INFINITY)), bits + 1);
	}
	assert_int_equal(half_from_real(1e-300), 0);
	assert_int_equal(half_from_real(65520.0), MAX);
	assert_int_equal(half_from_real(1e300), MAX);
	assert_int_equal(half_from_real(INFINITY), MAX);
	assert_int_equal(half_from_real(-INFINITY), MAX | SIGN);
}

static void integers_come_and_go(void **state)
{
	(void)state;
	for (uint32_t n = 0; n < 1u << 22; n++)
		assert_true(values[half_from_integer(n, -21)] == nearest_half(ldexp(n, -21)));
	static const uint32_t large[] = {1, 0x7FF, 0x800, 0x1001, 0xFFFFFF, 0x3FFFFFFF, 0x7FFFFFFF};
	for (size_t i = 0; i < sizeof(large) / sizeof(large[0]); i++)
		for (int exponent = -80; exponent <= 40; exponent++)
			assert_true(values[half_from_integer(large[i], exponent)] ==
				    nearest_half(ldexp(large[i], exponent)));
	static const uint32_t scales[] = {1, 255, 1024, 65535, UINT32_MAX};
	for (size_t i = 0; i < sizeof(scales) / sizeof(scales[0]); i++)
		for (uint16_t a = 0; a <= HALF_ONE; a++)
			/* Of 43 digits at most, and with the half a double has room for 53. */
			assert_true(half_to_integer(a, scales[i]) ==
				    floor(values[a] * scales[i] + 0.5));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_number_works_with_a_spread_of_others),
		cmocka_unit_test(all_digits_work_with_all_others),
		cmocka_unit_test(lerp_rounds_each_step),
		cmocka_unit_test(bits_and_reals_are_one),
		cmocka_unit_test(reals_round_to_the_nearest_number),
		cmocka_unit_test(integers_come_and_go),
	};
	return cmocka_run_group_tests(tests, set_up, NULL);
}
