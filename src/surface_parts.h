/* SPDX-License-Identifier: MIT */
#ifndef SURFACE_PARTS_H
#define SURFACE_PARTS_H

#include "surface_pass.h"

/** Finds out by drawing, which is to be done before state is set for surfaces, what parts ask the
 *  driver for. */
void surface_parts_find_ways(const struct surface_pass *pass);

/** Draws an object that a shadow may fall on, each part with no more than it needs (need.h): that
 * is the same there and costs less. list: its triangles by need; NULL: they are not told apart.
 * flags: of the program that does all that the technique does. */
bool surface_parts_draw(struct surface_pass *pass, const struct object *object,
	const struct lit_list *list, uint64_t flags, struct sm_error *error);

/** Marks the cells of the picture that an object's parts which need the technique may be seen in.
 */
bool surface_parts_mark(const struct surface_pass *pass, const struct object *object,
	struct screen_grid *cells, struct sm_error *error);

#endif
