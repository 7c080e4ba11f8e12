/* SPDX-License-Identifier: MIT */
#ifndef FIXED_NUMBER_H
#define FIXED_NUMBER_H

#include <stdint.h>

/**
 * The arithmetic of the exact passes: numbers of at least 0 as bits that are ordered as the numbers
 * are, 0 being 0. The functions round as their precision says, and saturate at its largest number.
 * shaders_es/exact_NAME.glsl has the same ones as num_ratio() and so on, bit for bit.
 */
struct number_model {
	const char *name; /* as sm_precision_name() has it */
	uint32_t one;
	uint32_t largest;
	/** n / d of integers below 2^22, d > 0. half: of n and d as halfs, which have 11 bits. */
	uint32_t (*ratio)(uint32_t n, uint32_t d);
	/** a / b; by 0: the largest. */
	uint32_t (*div)(uint32_t a, uint32_t b);
	uint32_t (*mul)(uint32_t a, uint32_t b);
	uint32_t (*add)(uint32_t a, uint32_t b);
	/** 1 - a; a <= 1. */
	uint32_t (*rest)(uint32_t a);
	/** a (1 - t) + b t, each operation rounded, which makes no more than 1; a, b, t <= 1. */
	uint32_t (*lerp)(uint32_t a, uint32_t b, uint32_t t);
	/** f / 1024, exactly; f < 1024. */
	uint32_t (*weight)(uint32_t f);
	/** 1024 a and 65535 a to the nearest integer, halves up; a <= 1. */
	uint32_t (*index)(uint32_t a);
	uint32_t (*bytes)(uint32_t a);
	/** The number nearest to x; x >= 0. */
	uint32_t (*from_real)(double x);
};

/** s1.10 fixed point (s110.h): 0 to 2047, one 1024. */
extern const struct number_model number_fixed12;
/** IEEE binary16 (half.h). */
extern const struct number_model number_half;

#endif
