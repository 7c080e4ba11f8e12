/* SPDX-License-Identifier: MIT */
#ifndef MODEL_DIFFERENCE_H
#define MODEL_DIFFERENCE_H

#include <stddef.h>
#include <stdint.h>

/** How far two pictures of visibility are apart, in visibility. */
struct model_difference {
	double mean, max; /* of the absolute differences */
	size_t failing;   /* pixels that differ by more than the tolerance */
};

/** Compares two pictures of [count] pixels, steps of 1/65535; all 0 without pixels. */
struct model_difference model_difference(
	const uint16_t *drawn, const uint16_t *model, size_t count, double tolerance);

#endif
