/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_GATHER_H
#define TECHNIQUE_GATHER_H

#include "scene/edge_chains.h"
#include "scene/penumbra.h"

/** What the technique and its model share (docs/gather.md). */

/** Texels a side of the layers, at most: they tell how many sheets are before a receiver, and that
 *  at their texels' centres; finer ones change nothing. */
#define GATHER_LAYER_SIZE_MAX 512
/** At most. */
#define GATHER_LAYERS 3
/** A side, where lists do not grow too long. */
#define GATHER_TILES_MAX 128
#define GATHER_TILES_MIN 64
/** Tiles in the widest penumbra, beyond which half as many a side do as well: each list is mostly
 * of what reaches the tile from outside. */
#define GATHER_PENUMBRA_TILES 16
/** Of all lists, 1.5 MB: runs of edges and their vertices, or vertices alone where lists are whole.
 */
#define GATHER_RUNS_MAX (64 * 1024)
#define GATHER_VERTICES_MAX (32 * 1024)
#define GATHER_COPIES_MAX (96 * 1024)
#define GATHER_ROOM                                                     \
	{                                                               \
		GATHER_RUNS_MAX, GATHER_VERTICES_MAX, GATHER_COPIES_MAX \
	}

/** Texels a side of the layers, for a map of map_size >= 1: a power of two, so that points of the
 *  raster grid are floats. Else a winding number may be off where an edge runs through a texel's
 *  centre. */
static inline uint32_t gather_layer_size(uint32_t map_size)
{
	uint32_t size = GATHER_LAYER_SIZE_MAX;
	while (size > map_size)
		size /= 2;
	return size;
}

/** Tiles a side to list edges by. */
static inline uint32_t gather_tiles(const struct sm_scene *scene, const struct light_frame *frame)
{
	uint32_t tiles = GATHER_TILES_MAX;
	while (tiles > GATHER_TILES_MIN &&
		penumbra_texels(scene, frame, tiles) > GATHER_PENUMBRA_TILES)
		tiles /= 2;
	return tiles;
}

/** What was found for the last frame of a technique's state, which owns it. */
const struct edge_chains *gather_chains(const void *state);

#endif
