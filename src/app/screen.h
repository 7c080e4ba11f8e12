/* SPDX-License-Identifier: MIT */
#ifndef APP_SCREEN_H
#define APP_SCREEN_H

#include "app/offscreen.h"
#include "display.h"
#include "load/stage.h"

/** Pictures of a stage in the form that a display wants; zero is empty. */
struct screen {
	struct display_target wanted; /**< what all below was made for */
	struct offscreen target;
	/* For displays that take pixels: */
	uint8_t *pixels;              /**< R,G,B,A of the screen, rows from the bottom; owned */
	uint32_t framebuffer, buffer; /**< GL names, as large as the screen; 0: `target` will do */
};

/** Makes it, and the stage, what the display wants. Where that differs from before, the stage's
 *  time is 0 again. Fails as offscreen_init() does. */
bool screen_fit(struct screen *screen, const struct display_target *wanted, struct stage *stage,
	struct sm_error *error);

/** Draws the stage as it is at the moment into `pixels` or the context's framebuffer 0. */
bool screen_draw(struct screen *screen, struct sm_renderer *renderer, const struct stage *stage,
	struct sm_error *error);

/** Whether screen_draw() would draw what it drew last. */
bool screen_is_current(
	const struct screen *screen, struct sm_renderer *renderer, const struct stage *stage);

/** Deletes what is there; needs the context. */
void screen_finish(struct screen *screen);

#endif
