/* SPDX-License-Identifier: MIT */
#ifndef SCENE_SEEN_CELLS_H
#define SCENE_SEEN_CELLS_H

#include "geom/screen_grid.h"
#include "scene/light_reach.h"

/**
 * Marks the cells of a light's screen that are within `margin`, NDC, of a surface that is seen and
 * receives: a caster beside all of them throws its shadow beside the view, or nowhere. What is
 * seen of an object is bounded by the part of its box that is in the view.
 */
void seen_cells_find(struct screen_grid *cells, const struct sm_scene *scene,
	const struct light_frame *frame, const struct view_volume *volume, float margin);

#endif
