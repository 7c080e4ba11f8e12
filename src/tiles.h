/* SPDX-License-Identifier: MIT */
#ifndef TILES_H
#define TILES_H

#include "geom/mesh.h"
#include "need.h"

/** Rows of tiles that are alike; of those that walk along edges. */
#define TILE_BAND 4
#define TILE_BAND_FINE 2

/** Meshes of more triangles are not worth cutting. */
#define TILE_TRIANGLES_MAX 16

/** The tiles of the picture by what a mesh needs there: disjoint, together all of the picture. */
struct tiles {
	struct screen_grid of[NEED_COUNT];
};

/**
 * Finds what a mesh of at most TILE_TRIANGLES_MAX triangles needs where it is seen: its part in
 * each tile, as the light sees that. Rounded up to few rectangles, since each is a draw call:
 * TILE_BAND rows at a time are alike, or TILE_BAND_FINE, and short gaps are closed.
 * width, height: of the picture, pixels. to_clip, to_light_clip: from the mesh to the clip spaces
 * of camera and light.
 */
void tiles_find(struct tiles *tiles, const struct need_map *map, const struct mesh *mesh,
	uint32_t width, uint32_t height, mat4 to_clip, mat4 to_light_clip);

#endif
