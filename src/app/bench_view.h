/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_VIEW_H
#define APP_BENCH_VIEW_H

#include "app/offscreen.h"
#include "load/stage.h"

/** The visibility of a scene's first light in two pictures. Zero is empty. */
struct bench_view {
	struct stage stage; /**< of the pictures' size */
	struct offscreen target;
	size_t pixels;
	float *seen[2]; /**< [pixels], owned: shares of the light, rows from the top */
	uint8_t *rgba;  /**< owned: a picture as it was read */
};

/** Makes what is needed to draw in the current context; view->stage is loaded before, the rest
 *  zero. Fails (INPUT) beyond the driver's limits, (MACHINE) when out of memory. */
bool bench_view_init(struct bench_view *view, struct sm_error *error);

/** Draws one of the two, at that time of the stage. Fails as sm_renderer_draw(). */
bool bench_view_draw(struct bench_view *view, struct sm_renderer *renderer, int which,
	double seconds, struct sm_error *error);

/** Frees what init, complete or not, has made, and the stage, in the same context. */
void bench_view_finish(struct bench_view *view);

#endif
