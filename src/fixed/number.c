/* SPDX-License-Identifier: MIT */
#include "fixed/number.h"
#include "fixed/half.h"
#include "fixed/s110.h"

static uint32_t fixed12_ratio(uint32_t n, uint32_t d)
{
	uint64_t doubled = (uint64_t)n * (2 * S110_ONE) + d;
	return (uint32_t)s110_saturate((long long)(doubled / (2 * (uint64_t)d)));
}

static uint32_t fixed12_div(uint32_t a, uint32_t b)
{
	return (uint32_t)s110_divide((int)a, (int)b);
}

static uint32_t fixed12_mul(uint32_t a, uint32_t b)
{
	return (uint32_t)s110_multiply((int)a, (int)b);
}

static uint32_t fixed12_add(uint32_t a, uint32_t b)
{
	return (uint32_t)s110_add((int)a, (int)b);
}

static uint32_t fixed12_rest(uint32_t a)
{
	return S110_ONE - a;
}

static uint32_t fixed12_lerp(uint32_t a, uint32_t b, uint32_t t)
{
	return (uint32_t)s110_lerp((int)a, (int)b, (int)t);
}

static uint32_t fixed12_weight(uint32_t f)
{
	return f;
}

static uint32_t fixed12_index(uint32_t a)
{
	return a;
}

static uint32_t fixed12_bytes(uint32_t a)
{
	return (a * 65535 + S110_ONE / 2) / S110_ONE;
}

static uint32_t fixed12_from_real(double x)
{
	return (uint32_t)s110_from_real(x);
}

const struct number_model number_fixed12 = {
	.name = "fixed12",
	.one = S110_ONE,
	.largest = S110_MAX,
	.ratio = fixed12_ratio,
	.div = fixed12_div,
	.mul = fixed12_mul,
	.add = fixed12_add,
	.rest = fixed12_rest,
	.lerp = fixed12_lerp,
	.weight = fixed12_weight,
	.index = fixed12_index,
	.bytes = fixed12_bytes,
	.from_real = fixed12_from_real,
};

/* 22 bits of depth or length, as a number below 2. */
#define RATIO_EXPONENT (-21)

static uint32_t half_ratio(uint32_t n, uint32_t d)
{
	return half_divide(
		half_from_integer(n, RATIO_EXPONENT), half_from_integer(d, RATIO_EXPONENT));
}

static uint32_t half_div(uint32_t a, uint32_t b)
{
	return half_divide((uint16_t)a, (uint16_t)b);
}

static uint32_t half_mul(uint32_t a, uint32_t b)
{
	return half_multiply((uint16_t)a, (uint16_t)b);
}

static uint32_t half_sum(uint32_t a, uint32_t b)
{
	return half_add((uint16_t)a, (uint16_t)b);
}

static uint32_t half_rest(uint32_t a)
{
	return half_subtract(HALF_ONE, (uint16_t)a);
}

static uint32_t half_blend(uint32_t a, uint32_t b, uint32_t t)
{
	return half_lerp((uint16_t)a, (uint16_t)b, (uint16_t)t);
}

static uint32_t half_weight(uint32_t f)
{
	return half_from_integer(f, -10);
}

static uint32_t half_index(uint32_t a)
{
	return half_to_integer((uint16_t)a, 1024);
}

static uint32_t half_bytes(uint32_t a)
{
	return half_to_integer((uint16_t)a, 65535);
}

static uint32_t half_nearest(double x)
{
	return half_from_real(x);
}

const struct number_model number_half = {
	.name = "half",
	.one = HALF_ONE,
	.largest = HALF_MAX,
	.ratio = half_ratio,
	.div = half_div,
	.mul = half_mul,
	.add = half_sum,
	.rest = half_rest,
	.lerp = half_blend,
	.weight = half_weight,
	.index = half_index,
	.bytes = half_bytes,
	.from_real = half_nearest,
};
