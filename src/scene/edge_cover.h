/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_COVER_H
#define SCENE_EDGE_COVER_H

#include "scene/edge_chains.h"
#include "scene/tile_depths.h"

/** Most tiles a side. */
#define EDGE_GRID_TILES_MAX 128

/**
 * How far away, in tiles, an edge at window depth d is that concerns a tile: the larger of margin
 * and base - rate d. Zero is empty; memory is kept.
 */
struct edge_cover {
	uint32_t tiles;     /* a side; a power of two, at most EDGE_GRID_TILES_MAX */
	float per_step;     /* tiles for each step of the raster grid */
	float *margin;      /* [tiles * tiles]; negative where nothing receives; owned */
	float *base, *rate; /* [tiles * tiles], owned */
	float widest, rate_max, deepest_max; /* of all tiles */
	const float *deepest; /* receiver of a tile, as struct tile_depths has it; not owned */
	float scale;          /* disc_scale(), tiles */
	float turn_max, pole; /* turn_max (pole - d): how far the light's disc is turned from its
				 axis, of the way to d */
	size_t margin_capacity, base_capacity, rate_capacity;
	/* What the grazing triangle that was asked for last concerns. */
	struct {
		const struct chain_point *corners; /* NULL: none was */
		uint16_t *found;                   /* [count], owned */
		size_t count, capacity;
	} grazing;
	/* Tiles of an edge, a bit each from the left; all 0 between searches. */
	uint64_t rows[EDGE_GRID_TILES_MAX][2];
};

/** map_size: texels a side; subpixel_bits: of the raster grid. False: out of memory. */
bool edge_cover_init(struct edge_cover *cover, const struct tile_depths *depths,
	const struct light_frame *frame, uint32_t map_size, uint32_t subpixel_bits);

/** Which tiles the edge from a to b concerns, and a few more perhaps: found: [tiles * tiles], by
 *  their numbers and in order. Returns how many. One of a grazing triangle is in its chain, and
 *  concerns tiles as the triangle does: of which all receivers are on the side of its plane where
 *  it counts, and the deepest one may see it hide a sample of the disc. */
size_t edge_cover_find(struct edge_cover *cover, const struct chain_point *a,
	const struct chain_point *b, uint16_t *found);

void edge_cover_finish(struct edge_cover *cover);

/** Of memory. */
size_t edge_cover_bytes(const struct edge_cover *cover);

#endif
