/* SPDX-License-Identifier: MIT */
#ifndef SPARSE_PASS_H
#define SPARSE_PASS_H

#include "geom/screen_parts.h"
#include "surface_pass.h"

/** Pixels from one point of a sparse picture of a light's visibility to the next. */
#define SPARSE_SPACING 4

/**
 * Draws a light's visibility at a grid of points of the view, and joins them to cells that surfaces
 * look up: where a cell is of one surface, and the penumbrae there are wide, they need not find it
 * themselves. view: of the light. May leave another framebuffer bound.
 */
bool sparse_pass_draw(
	const struct surface_pass *view, struct shadowed_light *light, struct sm_error *error);

/** Begins the picture that a light's visibility at points is drawn into, and to be joined from: no
 *  cell has a corner where nothing is drawn. */
bool sparse_pass_begin_points(const struct surface_pass *view, struct sm_error *error);

/** The points at the corners of all cells that pixels in a box of the view are in. */
struct pixel_box sparse_pass_points_in(const struct pixel_box *pixels);

/** Joins points to cells, of which the picture is made that size. */
bool sparse_pass_join(
	const struct surface_pass *view, struct picture *cells, struct sm_error *error);

/** Sets what surfaces look cells up by; flags of the program: CELLS. */
void sparse_pass_bind(const struct surface_pass *pass, const struct program *program);

/** After each frame: gives back what no light has drawn into for long. */
void sparse_pass_end_frame(struct sm_renderer *renderer);

/** Gives back all that was drawn into. */
void sparse_pass_finish(struct sm_renderer *renderer);

#endif
