/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_HOLLOWS_H
#define SCENE_EDGE_HOLLOWS_H

#include "scene/edge_texel.h"

/** In a tile's list. */
#define HOLLOWS_MAX 32

/** In all lists. */
#define EDGE_HOLLOWS_MAX 32767

/** Texels of each. */
#define HOLLOW_TEXELS 4

/** Where a triangle counts, as a texture holds it, RGBA32UI: at receivers at x and y of the light's
 *  screen, in steps of the raster grid from its middle, and at depth d, in steps of
 *  EDGE_DEPTH_STEPS, if slope[0] x + slope[1] y + start > d and near < d < far. */
struct hollow_plane {
	float slope[2], start;
	uint16_t near, far; /* 65,536 steps of window depth */
};

struct listed_hollow {
	uint32_t tile, hollow; /* row after row from the lower left; of the chains' */
};

/** Triangles over hollows by the tiles they concern. Zero is empty; memory is kept. */
struct edge_hollows {
	struct listed_hollow *of; /* [count], by tiles, in the chains' order, owned */
	size_t count;
	size_t dropped; /* that there was no room for */
	size_t capacity;
};

/** Lists the chains' hollows, HOLLOWS_MAX a tile and `most` in all at most. False:
 *  out of memory. */
bool edge_hollows_list(struct edge_hollows *lists, const struct edge_chains *chains,
	uint32_t screen, uint32_t tiles, size_t most);

/** How many the tile has that the first of is listed there. */
size_t edge_hollows_of_tile(const struct edge_hollows *lists, size_t first);

/** Writes [HOLLOW_TEXELS * lists->count] texels: of each tile three for each of its triangles, with
 *  their edges as lists have them, then one for each with its plane. screen: steps of the raster
 *  grid a side. */
void edge_hollows_write(const struct edge_hollows *lists, const struct edge_chains *chains,
	uint32_t screen, struct edge_texel *texels);

void edge_hollows_finish(struct edge_hollows *lists);

/** Of memory. */
size_t edge_hollows_bytes(const struct edge_hollows *lists);

#endif
