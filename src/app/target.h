/* SPDX-License-Identifier: MIT */
#ifndef APP_TARGET_H
#define APP_TARGET_H

#include <smoothie.h>

enum target_kind {
	TARGET_PICTURE,    /**< sRGB */
	TARGET_VISIBILITY, /**< plain bytes, as sm_view.visibility_of asks; one sample */
};

/** A framebuffer without a window; zero is empty. */
struct target {
	uint32_t width, height;
	uint32_t framebuffer; /**< GL name, to draw into */
	uint32_t resolved;    /**< GL name, to read from; the same with one sample */
	uint32_t texture;     /**< GL name: color of `resolved` */
	uint32_t buffers[2];  /**< renderbuffers: depth, color of several samples or 0 */
};

/** Makes one in the current context, with `samples` or as many as the driver has.
 *  Fails (INPUT) beyond the driver's limits, (MACHINE) when out of memory. */
bool target_init(struct target *target, enum target_kind kind, uint32_t width, uint32_t height,
	uint32_t samples, struct sm_error *error);

/** When all is drawn: brings the samples together, so that the texture is the picture. Nothing with
 *  one sample. */
void target_resolve(const struct target *target);

/** Reads width x height pixels as R,G,B,A bytes, rows from the bottom, when all is resolved. */
bool target_read(const struct target *target, uint8_t *rgba, struct sm_error *error);

/** Makes what target_read() got of a visibility shares of the light, rows from the top. */
void target_decode_visibility(const struct target *target, const uint8_t *rgba, float *seen);

/** Deletes what init, complete or not, has made. */
void target_finish(struct target *target);

#endif
