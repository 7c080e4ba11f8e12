/* SPDX-License-Identifier: MIT */
#include "fixed/half.h"
#include <math.h>
#include <stdbool.h>

#define SIGN 0x8000u
#define HIDDEN 0x400u /* the digit that normal numbers do not store */

/* Powers of two: a step of the smallest numbers, and of the largest. */
#define LEAST_EXPONENT (-24)
#define GREATEST_EXPONENT 5

/* A magnitude as digits 2^exponent. */
struct parts {
	uint32_t digits; /* below 2 HIDDEN */
	int exponent;
};

static struct parts parts_of(uint16_t a)
{
	uint32_t digits = a & (HIDDEN - 1);
	int biased = (a & ~SIGN) >> 10;
	if (biased == 0)
		return (struct parts){digits, LEAST_EXPONENT};
	return (struct parts){digits | HIDDEN, LEAST_EXPONENT - 1 + biased};
}

/* n > 0. */
static int highest_bit(uint32_t n)
{
	return 31 - __builtin_clz(n);
}

/* n 2^-shift, to nearest, ties to even; n < 2^31, shift >= 0. */
static uint32_t shift_out(uint32_t n, int shift)
{
	if (shift == 0)
		return n;
	if (shift > 31)
		return 0;
	uint32_t kept = n >> shift, rest = n & ((1u << shift) - 1), tie = 1u << (shift - 1);
	return kept + (rest > tie || (rest == tie && kept % 2 == 1));
}

/* The number nearest to n 2^exponent; n < 2^31. A lowest bit that stands for all that is below it
 * is enough, if n has 13 bits or more. */
static uint16_t round_magnitude(uint32_t n, int exponent)
{
	if (n == 0)
		return 0;
	int last = highest_bit(n) + exponent - 10; /* power of two of the last digit kept */
	if (last < LEAST_EXPONENT)
		last = LEAST_EXPONENT;
	if (last > GREATEST_EXPONENT)
		return HALF_MAX;
	uint32_t digits = last <= exponent ? n << (exponent - last) : shift_out(n, last - exponent);
	/* The hidden digit carries into the exponent, and so does rounding up to a power of two. */
	uint32_t bits = ((uint32_t)(last - LEAST_EXPONENT) << 10) + digits;
	return (uint16_t)(bits < HALF_MAX ? bits : HALF_MAX);
}

static uint16_t with_sign(uint16_t magnitude, unsigned int sign)
{
	return (uint16_t)(magnitude | sign);
}

uint16_t half_from_real(double x)
{
	int exponent;
	double scaled = ldexp(frexp(fabs(x), &exponent), 30);
	if (isinf(x))
		return with_sign(HALF_MAX, x < 0.0 ? SIGN : 0);
	uint32_t digits = (uint32_t)scaled;
	digits |= (double)digits < scaled;
	return with_sign(round_magnitude(digits, exponent - 30), signbit(x) ? SIGN : 0);
}

double half_to_real(uint16_t a)
{
	struct parts parts = parts_of(a);
	double magnitude = ldexp(parts.digits, parts.exponent);
	return a & SIGN ? -magnitude : magnitude;
}

uint16_t half_from_integer(uint32_t n, int exponent)
{
	return round_magnitude(n, exponent);
}

uint32_t half_to_integer(uint16_t a, uint32_t factor)
{
	struct parts parts = parts_of(a);
	int shift = -parts.exponent;
	uint64_t product = (uint64_t)parts.digits * factor;
	return (uint32_t)((product + (UINT64_C(1) << (shift - 1))) >> shift);
}

/* Of magnitudes, a >= b. */
static uint16_t add_magnitudes(uint16_t a, uint16_t b, bool subtract)
{
	struct parts large = parts_of(a), small = parts_of(b);
	int shift = large.exponent - small.exponent;
	/* b is below a quarter of a's last digit, which is half of the last one just below a. */
	if (shift > 12)
		return a;
	uint32_t digits = large.digits << shift;
	digits = subtract ? digits - small.digits : digits + small.digits;
	return round_magnitude(digits, small.exponent);
}

uint16_t half_add(uint16_t a, uint16_t b)
{
	uint16_t x = a & ~SIGN, y = b & ~SIGN;
	bool subtract = ((a ^ b) & SIGN) != 0;
	unsigned int sign = (x >= y ? a : b) & SIGN;
	if (subtract && x == y)
		return 0;
	return with_sign(
		x >= y ? add_magnitudes(x, y, subtract) : add_magnitudes(y, x, subtract), sign);
}

uint16_t half_subtract(uint16_t a, uint16_t b)
{
	return half_add(a, b ^ SIGN);
}

uint16_t half_multiply(uint16_t a, uint16_t b)
{
	struct parts x = parts_of(a), y = parts_of(b);
	uint16_t magnitude = round_magnitude(x.digits * y.digits, x.exponent + y.exponent);
	return with_sign(magnitude, (a ^ b) & SIGN);
}

/* y.digits > 0. */
static uint16_t divide_parts(struct parts x, struct parts y)
{
	if (x.digits == 0)
		return 0;
	/* So that the quotient has its 13 bits. */
	int shift = 30 - highest_bit(x.digits);
	uint32_t digits = x.digits << shift;
	uint32_t quotient = digits / y.digits | (digits % y.digits != 0);
	return round_magnitude(quotient, x.exponent - shift - y.exponent);
}

uint16_t half_divide(uint16_t a, uint16_t b)
{
	struct parts x = parts_of(a), y = parts_of(b);
	uint16_t magnitude = y.digits == 0 ? HALF_MAX : divide_parts(x, y);
	return with_sign(magnitude, (a ^ b) & SIGN);
}

uint16_t half_lerp(uint16_t a, uint16_t b, uint16_t t)
{
	return half_add(half_multiply(a, half_subtract(HALF_ONE, t)), half_multiply(b, t));
}
