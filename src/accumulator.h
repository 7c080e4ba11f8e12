/* SPDX-License-Identifier: MIT */
#ifndef ACCUMULATOR_H
#define ACCUMULATOR_H

#include "renderer.h"

/** Makes it that size, and binds its framebuffer. */
bool accumulator_bind(struct accumulator *accumulator, struct gl *gl, uint32_t width,
	uint32_t height, struct sm_error *error);
/** Fine on a zeroed one. */
void accumulator_finish(struct accumulator *accumulator, struct gl *gl);

/** Copies it, sRGB-encoded, into the framebuffer that is bound. */
bool accumulator_copy(
	const struct accumulator *accumulator, struct gpu *gpu, struct sm_error *error);

#endif
