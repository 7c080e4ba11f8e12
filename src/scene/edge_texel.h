/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_TEXEL_H
#define SCENE_EDGE_TEXEL_H

#include "scene/edge_chains.h"

/** Bits of a word that a place takes; below it are those of a depth. */
#define EDGE_PLACE_BITS 21
#define EDGE_DEPTH_BITS (32 - EDGE_PLACE_BITS)

/** Steps of window depth. */
#define EDGE_DEPTH_STEPS (1 << 2 * EDGE_DEPTH_BITS)

/**
 * An edge as a texture holds it, RGBA32UI: x and y of its start, x and y of its end, each in steps
 * of the raster grid from the middle of the light's screen, a signed number in the upper bits of a
 * word. Below are the upper and lower half of the start's window depth, and of the end's. The
 * lowest bit of all is set where two sheets end at the edge, and that of the start's depth where it
 * is a grazing triangle's.
 */
struct edge_texel {
	uint32_t words[4];
};

/** Of the edge between two points of a chain. screen: steps of the raster grid a side. What lies
 *  beyond the numbers' range, a screen's width and more around the middle, is cut off, as is what
 * is behind depth 1. */
struct edge_texel edge_texel_of(const struct chain_point edge[2], uint32_t screen);

/** Steps of depth that neither end is before. */
static inline uint32_t edge_texel_nearest(const struct edge_texel *texel)
{
	const uint32_t *w = texel->words, mask = (1u << EDGE_DEPTH_BITS) - 1;
	uint32_t start = (w[0] & mask) << EDGE_DEPTH_BITS | (w[1] & mask);
	uint32_t end = (w[2] & mask) << EDGE_DEPTH_BITS | (w[3] & mask);
	return start < end ? start : end;
}

#endif
