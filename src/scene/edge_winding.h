/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_WINDING_H
#define SCENE_EDGE_WINDING_H

#include "scene/edge_chains.h"

/**
 * How often the chains wind around the centre of each tile, counter-clockwise: the sheets that lie
 * over it. Exact on the raster grid: an edge includes its lower end and not its upper, and a centre
 * on an edge is to the right of it (in x).
 *
 * screen: steps of the raster grid a side, below 2^23. winding: [tiles * tiles], row after row from
 * the lower left; overwritten.
 */
void edge_winding_find(
	const struct edge_chains *chains, uint32_t screen, uint32_t tiles, int32_t *winding);

#endif
