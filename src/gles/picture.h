/* SPDX-License-Identifier: MIT */
#ifndef GLES_PICTURE_H
#define GLES_PICTURE_H

#include "gles/gl.h"

/** Colour and depth of some size, as textures, and the framebuffer that draws into both. */
struct picture {
	GLuint color, depth, framebuffer; /* depth: 0 if it is another picture's */
	uint32_t width, height;           /* 0 until it is whole */
};

/** Nearest filtering, clamped to the edge. depth: a depth texture of that size, which must outlive
 *  it, or 0 for one of its own, of 24 bits. Leaves the picture bound, with its viewport, and
 * nothing at unit 0. On failure (MACHINE) finish() is still to be called. */
bool picture_init(struct picture *picture, struct gl *gl, enum storage_owner owner, uint32_t width,
	uint32_t height, GLenum color_format, GLuint depth, struct sm_error *error);
/** Makes it that size, with a depth of its own, unless it is so already, and binds it. */
bool picture_resize(struct picture *picture, struct gl *gl, enum storage_owner owner,
	uint32_t width, uint32_t height, GLenum color_format, struct sm_error *error);
/** Fine on a half-made or zeroed picture. */
void picture_finish(struct picture *picture, struct gl *gl);

/** Binds framebuffer and viewport. */
void picture_bind(const struct picture *picture, struct gl *gl);

#endif
