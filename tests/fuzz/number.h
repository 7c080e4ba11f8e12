/* SPDX-License-Identifier: MIT */
#ifndef TESTS_FUZZ_NUMBER_H
#define TESTS_FUZZ_NUMBER_H

#include <stddef.h>
#include <stdint.h>

/** Reads numbers from a fuzzer's bytes; past their end they are 0. */
struct numbers {
	const uint8_t *data;
	size_t size;
};

uint8_t take_byte(struct numbers *numbers);

/**
 * One byte below 0x20 stands for a number that is known for trouble, up to 0xf0 for a multiple of
 * 1/16 about 0 at 0x80, and above that any bits of a float follow: so that numbers are often equal,
 * as in models, and a small input is a mesh.
 */
float take_float(struct numbers *numbers);
void take_floats(struct numbers *numbers, float *values, size_t count);

#endif
