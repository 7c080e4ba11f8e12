/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_GRID_H
#define SCENE_EDGE_GRID_H

#include "scene/edge_hollows.h"
#include "scene/edge_keep.h"
#include "scene/edge_lists.h"

/** What receivers in a tile of the light's screen need; RGBA32UI. */
struct edge_tile {
	uint32_t first;         /* of its runs, or, in whole lists, edges (17 bits) + first of its
				   triangles over hollows << 17 */
	uint32_t count_winding; /* how many runs or edges (17 bits) + triangles << 17 + (128 +
				   winding number at the tile's centre, behind all casters) << 24 */
	float nearest;          /* depth that none of its edges is before; 2: no edges */
	float farthest;         /* depth that no caster over the tile and its margin is behind; 0:
				   no caster */
};

static inline uint32_t edge_tile_count(const struct edge_tile *tile)
{
	return tile->count_winding & 0x1ffff;
}

static inline uint32_t edge_tile_first(const struct edge_tile *tile)
{
	return tile->first & 0x1ffff;
}

static inline uint32_t edge_tile_hollows(const struct edge_tile *tile)
{
	return tile->count_winding >> 17 & 0x7f;
}

static inline uint32_t edge_tile_first_hollow(const struct edge_tile *tile)
{
	return tile->first >> 17;
}

/** In [-128, 127]. */
static inline int edge_tile_winding(const struct edge_tile *tile)
{
	return (int)(tile->count_winding >> 24) - 128;
}

/** Bits of a texel below which a raster grid is coarse: its steps show in pictures. */
#define RASTER_BITS_FINE 6

/** What they are where it is, on the grid of edges. */
#define EDGE_BITS 8

static inline bool raster_is_coarse(uint32_t subpixel_bits)
{
	return subpixel_bits < RASTER_BITS_FINE;
}

static inline uint32_t edge_finer_bits(uint32_t subpixel_bits)
{
	return raster_is_coarse(subpixel_bits) ? EDGE_BITS - subpixel_bits : 0;
}

struct edge_grid_options {
	uint32_t tiles;         /* most a side, 32, 64 or 128; half or a quarter of them where
				   lists would not fit */
	uint32_t map_size;      /* texels a side of the layered map: margin of the lists */
	uint32_t subpixel_bits; /* of the rasteriser: the raster grid */
	struct edge_room room;  /* of all lists; beyond it the nearest edges win */
	uint32_t finer_bits;    /* that the edges' grid has beyond those; edge_finer_bits() */
};

/**
 * Silhouette edges of all casters, listed per tile of a light's screen. A tile's list has every
 * edge within 1.5 texels of the map from the tile, and every edge whose penumbra can reach a
 * receiver in the tile that is farther from a spot than four thirds of its radius; none where no
 * receiver is. Zero is empty; memory is kept from one search to the next, and so are the edges of
 * casters that have not changed.
 */
struct edge_grid {
	uint32_t tiles;       /* a side */
	struct edge_tile *of; /* [tiles * tiles], row after row from the lower left; owned */
	bool whole;           /* tiles' lists are of texels, not of runs */
	const struct edge_texel *texels;    /* [texel_count], of lists, and from hollow_base on of
					       triangles over hollows */
	const struct edge_run *runs;        /* [run_count], of lists that are not whole */
	const struct edge_vertex *vertices; /* [vertex_count], that runs are of */
	size_t texel_count, run_count, vertex_count, hollow_base;
	size_t edge_count; /* of the sheets' boundaries */
	size_t dropped;    /* entries of lists that there was no room for */
	float mean_list;   /* edges in a list that has any */
	/* Working memory; owned */
	struct edge_keep keep;
	struct edge_chains chains;
	struct tile_depths depths;
	struct edge_cover cover;
	struct edge_lists lists;
	struct edge_hollows hollows;
	int32_t *winding;
	size_t tile_capacity, winding_capacity;
};

/** Vertices that follow each other, with edges between them. */
struct edge_stretch {
	const struct edge_vertex *vertices; /* [edges + 1] */
	uint32_t edges;
};

/** How many stretches a tile's list is of. Whole lists are of none before
 *  edge_grid_find_stretches(). */
static inline uint32_t edge_tile_stretches(
	const struct edge_grid *grid, const struct edge_tile *tile)
{
	const uint32_t *first = &grid->lists.first[tile - grid->of];
	return first[1] - first[0];
}

static inline struct edge_stretch edge_tile_stretch(
	const struct edge_grid *grid, const struct edge_tile *tile, uint32_t i)
{
	const struct edge_run *run = &grid->runs[grid->lists.first[tile - grid->of] + i];
	return (struct edge_stretch){&grid->vertices[edge_run_first(run)], edge_run_count(run)};
}

/** Finds where casters show otherwise than in the search before, grid->keep.changed, as the search
 *  that follows does if nobody has. False: out of memory. */
bool edge_grid_look(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_grid_options *options);

/** Finds the silhouettes of all casters as the light sees them, and lists them. Everything written
 *  is finite. False: out of memory. */
bool edge_grid_find(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_grid_options *options);

/** Has whole lists be of runs as well, for whom follows chains. False: out of memory. */
bool edge_grid_find_stretches(struct edge_grid *grid);

/** Has the next search keep nothing of what it found for objects that have not changed. */
void edge_grid_forget(struct edge_grid *grid);

void edge_grid_finish(struct edge_grid *grid);

/** Of memory. */
size_t edge_grid_bytes(const struct edge_grid *grid);

#endif
