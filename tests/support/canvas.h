/* SPDX-License-Identifier: MIT */
#ifndef SUPPORT_CANVAS_H
#define SUPPORT_CANVAS_H

#include <GLES3/gl3.h>
#include <stdint.h>

/** A framebuffer with colour and depth; with several samples, and one that they are resolved to. */
struct canvas {
	GLuint framebuffer, color, depth;
	GLuint resolved_framebuffer, resolved; /* 0 with one sample */
	uint32_t width, height;
};

/** color_format: sized and renderable. Fails the test if GL refuses. */
void canvas_init(struct canvas *canvas, GLenum color_format, uint32_t width, uint32_t height);
/** The same with that many samples a pixel, or as many as the driver has. */
void canvas_init_multisampled(struct canvas *canvas, GLenum color_format, uint32_t width,
	uint32_t height, GLsizei samples);
void canvas_finish(struct canvas *canvas);

/** [height][width][4] bytes R,G,B,A as they are stored, rows from the top; the caller's to
 *  free(). Leaves the canvas bound. */
uint8_t *canvas_read(const struct canvas *canvas);

#endif
