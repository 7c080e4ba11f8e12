/* SPDX-License-Identifier: MIT */
#ifndef PAGE_PNG_H
#define PAGE_PNG_H

#include <smoothie.h>

/** A PNG file in memory; zero is empty. */
struct png {
	void *bytes; /* owned */
	size_t size;
};

/**
 * Encode width x height pixels of R,G,B,A bytes, rows from the bottom as GL reads them.
 * Fail (MACHINE) when out of memory, (INPUT) on a size that PNG does not allow.
 */

/** R, G, B as an 8-bit sRGB picture. */
bool png_init_picture(struct png *png, const uint8_t *rgba, uint32_t width, uint32_t height,
	struct sm_error *error);
/** 256 R + G as a 16-bit grey picture with gamma 1: what sm_view.visibility_of draws. */
bool png_init_visibility(struct png *png, const uint8_t *rgba, uint32_t width, uint32_t height,
	struct sm_error *error);

/** Frees what an init, complete or not, has made. */
void png_finish(struct png *png);

#endif
