/* SPDX-License-Identifier: MIT */
#ifndef CHECK_VIEW_H
#define CHECK_VIEW_H

#include "load/stage.h"

/** A built-in scene, and a framebuffer for the visibility of its light. Zero is empty. */
struct check_view {
	struct stage stage;
	uint32_t width, height;
	uint32_t framebuffer, buffers[2]; /* GL names: colour, depth */
	uint8_t *rgba;                    /* owned: pixels as they are read */
};

/** Loads builtin:SCENE. Needs a current context. Fails (MACHINE). */
bool check_view_init(struct check_view *view, const char *scene, uint32_t width, uint32_t height,
	struct sm_error *error);
/** In the same context; fine on a half-made one. */
void check_view_finish(struct check_view *view);

/** Draws what of light 0 reaches each pixel: [height][width] steps of 1/65535, rows from the top.
 *  Fails as sm_renderer_draw(), and (MACHINE) where GL has an error. */
bool check_view_draw(struct check_view *view, struct sm_renderer *renderer, uint16_t *values,
	struct sm_error *error);

/** The built-in scenes that pictures are of; NULL past the last. */
const char *check_scene_name(size_t index);

#endif
