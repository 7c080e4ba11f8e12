/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_GRID_H
#define SCENE_EDGE_GRID_H

#include "scene/edge_chains.h"

/** Most tiles a side. */
#define EDGE_GRID_TILES_MAX 128

/** A vertex of a chain of silhouette edges in the list of a tile; as a texture holds it, RGBA32F.
 */
struct chain_vertex {
	float x, y;  /* window coordinates of the light's screen, on the raster grid */
	float depth; /* window depth */
	float start; /* 0: an edge leads here from the vertex before, its sheet on the left as the
			light sees it (x right, y up). Else a chain starts here: 1 + a depth that
			nothing from here to the list's end is before (rounded down): receivers not
			behind that are done */
};

/** What receivers in a tile of the light's screen need; RGBA32UI. */
struct edge_tile {
	uint32_t first;         /* of its vertices */
	uint32_t count_winding; /* vertices (24 bits) + (128 + winding number at the tile's centre,
				   behind all casters) << 24 */
	float nearest;          /* depth that none of its edges is before; 2: no edges */
	float farthest;         /* depth that no caster over the tile and its margin is behind; 0:
				   no caster */
};

static inline uint32_t edge_tile_count(const struct edge_tile *tile)
{
	return tile->count_winding & 0xffffff;
}

/** In [-128, 127]. */
static inline int edge_tile_winding(const struct edge_tile *tile)
{
	return (int)(tile->count_winding >> 24) - 128;
}

struct edge_grid_options {
	uint32_t tiles;         /* most a side: 32, 64 or 128; fewer where lists would grow too
				   long */
	uint32_t map_size;      /* texels a side of the layered map: margin of the lists */
	uint32_t subpixel_bits; /* of the rasteriser: the raster grid */
	size_t vertices_max;    /* of all lists, below 2^24; beyond it the nearest edges win */
};

/**
 * Silhouette edges of all casters, listed per tile of a light's screen. A tile's list has every
 * edge that touches the tile grown by 1.5 texels of the map, and every edge whose penumbra can
 * reach a receiver in the tile; none where no receiver is. Zero is empty; memory is kept from one
 * search to the next.
 */
struct edge_grid {
	uint32_t tiles;                /* a side */
	struct edge_tile *of;          /* [tiles * tiles], row after row from the lower left;
					  owned */
	struct chain_vertex *vertices; /* [vertex_count], owned */
	size_t vertex_count;
	size_t edge_count; /* of silhouettes */
	size_t dropped;    /* entries of lists that vertices_max left no room for */
	float mean_list;   /* edges in a list that has any */
	/* Working memory; owned */
	struct edge_chains chains;
	size_t tile_capacity, vertex_capacity;
};

/** Finds the silhouettes of all casters as the light sees them, and lists them. Everything written
 *  is finite. False: out of memory. */
bool edge_grid_find(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_grid_options *options);

void edge_grid_finish(struct edge_grid *grid);

/** Of memory. */
size_t edge_grid_bytes(const struct edge_grid *grid);

#endif
