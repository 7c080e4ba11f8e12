/* SPDX-License-Identifier: MIT */
#ifndef SOFT_TILES_H
#define SOFT_TILES_H

#include "geom/screen_grid.h"
#include "scene/light.h"

/** Rows of tiles that are alike. */
#define SOFT_TILES_BAND 4

/**
 * Where in the picture surfaces may be that lie behind marked cells of a light's screen: each run
 * of cells, from the near plane to where its rays leave the scene's box, as the camera sees it.
 * Rounded up to few rectangles, since each is a draw call: SOFT_TILES_BAND rows at a time are
 * alike, and short gaps are closed. world_to_clip: the camera's.
 */
void soft_tiles_find(struct screen_grid *tiles, const struct screen_grid *cells,
	const struct light_frame *frame, const struct sm_scene *scene, mat4 world_to_clip);

#endif
