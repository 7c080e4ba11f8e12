/* SPDX-License-Identifier: MIT */
#ifndef FIXED_HALF_H
#define FIXED_HALF_H

#include <stdint.h>

/*
 * IEEE 754 binary16, the `half` of Cg, on its bits and in integers alone: a sign, 5 bits of
 * exponent, 10 of significand; subnormals are kept. Each result is the exact one rounded once, to
 * nearest, ties to even, and finite: what would round to infinity saturates at +-65504. So there
 * are no infinities and no NaNs, and none may be given.
 */

#define HALF_ONE UINT16_C(0x3C00)
#define HALF_MAX UINT16_C(0x7BFF) /* 65504 */

/** x is not a NaN. */
uint16_t half_from_real(double x);
double half_to_real(uint16_t a);

/** n 2^exponent; n < 2^31. */
uint16_t half_from_integer(uint32_t n, int exponent);

uint16_t half_add(uint16_t a, uint16_t b);
uint16_t half_subtract(uint16_t a, uint16_t b);
uint16_t half_multiply(uint16_t a, uint16_t b);
/** By zero: +-65504, as the signs say, also of 0. */
uint16_t half_divide(uint16_t a, uint16_t b);
/** a (1 - t) + b t, each of the four operations rounded. */
uint16_t half_lerp(uint16_t a, uint16_t b, uint16_t t);

/** factor a to the nearest integer, halves up; a in [0, 1]. */
uint32_t half_to_integer(uint16_t a, uint32_t factor);

#endif
