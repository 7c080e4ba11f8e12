/* SPDX-License-Identifier: MIT */
#ifndef BENCH_DIFFERENCE_H
#define BENCH_DIFFERENCE_H

#include "base/error.h"
#include <stdio.h>

/** R,G,B,A bytes in sRGB, rows from the bottom: what png_init_picture() takes. Zero is empty. */
struct picture {
	uint8_t *rgba; /* owned */
	uint32_t width, height;
};

/** Errors of this size and above have the full colour. */
#define DIFFERENCE_FULL 0.5f

/** The colour of visibility minus reference: grey without a difference, red where it is too bright,
 *  blue where it is too dark, in steps that look alike. */
void difference_color(float error, uint8_t rgb[3]);

/** The grey of a visibility, linear in [0, 1]. */
void difference_grey(float visibility, uint8_t rgb[3]);

/** Writes the colours from the darkest to the brightest, as a gradient of CSS to the right. */
void difference_write_gradient(FILE *file);

/**
 * Makes a picture of three beside each other: reference, technique, and their difference.
 * visibility and reference are width x height, linear in [0, 1], rows from the top; where one is
 * NAN there is nothing to compare, and the picture is dark. Fails (MACHINE) when out of memory.
 */
bool difference_montage(struct picture *picture, const float *visibility, const float *reference,
	uint32_t width, uint32_t height, struct sm_error *error);

void difference_finish(struct picture *picture);

#endif
