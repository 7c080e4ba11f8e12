/* SPDX-License-Identifier: MIT */
#ifndef RENDERER_H
#define RENDERER_H

#include "shadow_set.h"

/** Where several lights are added up when the caller's framebuffer cannot do that in linear
 *  light: sRGB-encoded colour, and depth. */
struct accumulator {
	GLuint color, depth, framebuffer;
	uint32_t width, height;
};

struct sm_renderer {
	struct gpu gpu;
	struct shadow_set shadows;
	struct accumulator accumulator;
	bool *soft; /* working memory: a mesh's clusters that are soft; owned */
	size_t soft_capacity;
};

/** What one frame does, in order. */
bool frame_draw(struct sm_renderer *renderer, const struct sm_scene *scene,
	const struct sm_view *view, struct sm_error *error);

#endif
