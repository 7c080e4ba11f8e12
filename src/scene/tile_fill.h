/* SPDX-License-Identifier: MIT */
#ifndef SCENE_TILE_FILL_H
#define SCENE_TILE_FILL_H

#include <cglm/cglm.h>
#include <stdint.h>

/**
 * Raises the values of tiles of a light's screen to the window depths of what lies over them, or
 * more, up to 1: deeper is nothing on the screen. What is before the near plane is left out.
 */
struct tile_fill {
	float *values; /* [tiles * tiles], row after row from the lower left; not owned */
	uint32_t tiles;
	float margin; /* tiles that all is grown by */
};

/** Tiles and window depth. */
struct tile_point {
	float x, y, depth;
	float beyond; /* the near plane: 1, else -1 */
};

/** A vertex of triangles. */
struct tile_vertex {
	vec4 clip;               /* clip space */
	struct tile_point point; /* while it is beyond the near plane */
};

/** position: object space. */
void tile_vertex_set(struct tile_vertex *vertex, const struct tile_fill *fill, mat4 to_clip,
	const float position[3]);

/** corners: of `vertices`. */
void tile_fill_triangle(const struct tile_fill *fill, const struct tile_vertex *vertices,
	const uint32_t corners[3]);

/** A box of object space. */
void tile_fill_box(
	const struct tile_fill *fill, mat4 to_clip, const float min[3], const float max[3]);

/** Whether to fill anything within the box would change nothing. */
bool tile_fill_has_box(
	const struct tile_fill *fill, mat4 to_clip, const float min[3], const float max[3]);

#endif
