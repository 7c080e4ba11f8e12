/* SPDX-License-Identifier: MIT */
#ifndef APP_OFFSCREEN_H
#define APP_OFFSCREEN_H

#include <smoothie.h>

enum offscreen_kind {
	OFFSCREEN_PICTURE,    /**< sRGB */
	OFFSCREEN_VISIBILITY, /**< plain bytes, as sm_view.visibility_of asks; one sample */
};

/** A framebuffer without a window; zero is empty. */
struct offscreen {
	uint32_t width, height;
	uint32_t framebuffer; /**< GL name, to draw into */
	uint32_t resolved;    /**< GL name, to read from; the same with one sample */
	uint32_t texture;     /**< GL name: color of `resolved` */
	uint32_t buffers[2];  /**< renderbuffers: depth, color of several samples or 0 */
};

/** Makes one in the current context, with `samples` or as many as the driver has.
 *  Fails (INPUT) beyond the driver's limits, (MACHINE) when out of memory. */
bool offscreen_init(struct offscreen *target, enum offscreen_kind kind, uint32_t width,
	uint32_t height, uint32_t samples, struct sm_error *error);

/** When all is drawn: brings the samples together, so that the texture is the picture. Nothing with
 *  one sample. */
void offscreen_resolve(const struct offscreen *target);

/** Reads width x height pixels as R,G,B,A bytes, rows from the bottom, when all is resolved. */
bool offscreen_read(const struct offscreen *target, uint8_t *rgba, struct sm_error *error);

/** Makes what offscreen_read() got of a visibility shares of the light, rows from the top. */
void offscreen_decode_visibility(const struct offscreen *target, const uint8_t *rgba, float *seen);

/** Deletes what init, complete or not, has made. */
void offscreen_finish(struct offscreen *target);

#endif
