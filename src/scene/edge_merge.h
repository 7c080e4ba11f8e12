/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_MERGE_H
#define SCENE_EDGE_MERGE_H

#include "scene/edge_chains.h"

/** How far merged edges may be from the chains as they were. */
struct edge_tolerance {
	float steps;    /* of the raster grid */
	float depth;    /* window depth */
	uint32_t texel; /* steps: centres of texels stay on their side of each chain */
};

/** Makes one edge of those that follow each other in nearly a straight line: finely tessellated
 *  meshes have many that are shorter than a texel. How often a chain winds around the centre of any
 *  texel does not change. Chains that all but vanish are left out. */
void edge_merge(struct edge_chains *chains, const struct edge_tolerance *tolerance);

#endif
