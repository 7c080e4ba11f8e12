/* SPDX-License-Identifier: MIT */
#ifndef GLES_PRIMITIVES_H
#define GLES_PRIMITIVES_H

#include "gles/gpu.h"

/** Primitives at most that are drawn at once: rows of 128 in the least texture that every driver
 *  has. */
#define PRIMITIVES_MAX (128 * 2048)

/** Primitives of integers (fixed/primitive.h) for exact_raster.vert, as a texture of 128 in a row.
 *  Zero is empty. */
struct primitives {
	GLuint texture, array;
	GLsizei width, height; /* of the texture */
	size_t count;
};

void primitives_finish(struct primitives *primitives, struct gl *gl);

/** Uploads the first PRIMITIVES_MAX of them, if there are so many, `size` bytes each: a multiple
 * of 16. */
void primitives_upload(struct primitives *primitives, struct gpu *gpu, const void *items,
	size_t count, size_t size);

/** Draws what was uploaded into a target of width x height pixels, with the program in use; fails
 *  (MACHINE) for want of memory. */
bool primitives_draw(const struct primitives *primitives, struct gpu *gpu,
	const struct program *program, GLsizei width, GLsizei height, struct sm_error *error);

#endif
