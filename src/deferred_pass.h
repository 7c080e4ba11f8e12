/* SPDX-License-Identifier: MIT */
#ifndef DEFERRED_PASS_H
#define DEFERRED_PASS_H

#include "surface_pass.h"

/**
 * Draws a light's visibility of each pixel once it is known which surface is seen there: first all
 * surfaces as receivers, where they lie on the light's screen, and then their visibility, over the
 * whole picture, for surfaces to look up. It is that which they would find themselves, but for
 * slopes of half the digits; or, as SM_SAMPLING_DEFERRED_SPARSE, of one of four by four pixels and
 * between those what sparse_pass.h joins them to. Pixels whose visibility is known without edges
 * are left out of the pass that looks at edges. Costs where surfaces are large; where triangles are
 * smaller than the blocks of pixels that drivers shade, or hide each other, each pixel is found
 * once instead of often. Of several samples of a pixel one may be another surface's there: that
 * looks beside it. view: of the light. May leave another framebuffer bound.
 */
bool deferred_pass_draw(
	const struct surface_pass *view, struct shadowed_light *light, struct sm_error *error);

/** Binds what surfaces look up; flags of the program: FOUND. */
void deferred_pass_bind(const struct surface_pass *pass);

/** After each frame: gives back what no light has drawn into for long. */
void deferred_pass_end_frame(struct sm_renderer *renderer);

/** Gives back all that was drawn into. */
void deferred_pass_finish(struct sm_renderer *renderer);

#endif
