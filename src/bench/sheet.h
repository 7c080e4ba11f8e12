/* SPDX-License-Identifier: MIT */
#ifndef BENCH_SHEET_H
#define BENCH_SHEET_H

#include "bench/difference.h"
#include <stddef.h>

/**
 * Techniques side by side, as a picture for a reader: the part of a scene's visibility that has the
 * most penumbra, enlarged. In the first column stands the reference above the whole picture with
 * that part framed; in those to its right each technique above its difference from the reference,
 * coloured by difference_color(). More than SHEET_COLUMNS techniques go on in rows below. Zero is
 * empty.
 */
struct sheet {
	struct picture picture;
	const float *reference; /* not owned */
	uint32_t width, height; /* of the pictures that are compared */
	uint32_t side;          /* of the part, pixels */
	uint32_t left, top;     /* of the part */
	size_t count, added;    /* techniques */
};

#define SHEET_COLUMNS 4

/** reference: width x height, linear in [0, 1], rows from the top, NAN where there is nothing to
 *  compare; kept until the last sheet_add(). count: techniques that will be added, 1 or more. Fails
 *  (MACHINE) when out of memory. */
bool sheet_init(struct sheet *sheet, const float *reference, uint32_t width, uint32_t height,
	size_t count, struct sm_error *error);
void sheet_finish(struct sheet *sheet);

/** Paints the next technique, one of the count, from a picture like the reference. note: a second
 *  line below the name. Characters as glyph_rows() has them. */
void sheet_add(struct sheet *sheet, const char *name, const char *note, const float *visibility);

#endif
