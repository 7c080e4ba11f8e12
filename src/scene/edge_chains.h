/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_CHAINS_H
#define SCENE_EDGE_CHAINS_H

#include "geom/silhouette.h"
#include "scene/light.h"

/** On a light's screen, in steps of the raster grid from the lower left. */
struct chain_point {
	int32_t x, y; /* within CHAIN_LIMIT */
	float depth;  /* window depth, finite */
	bool ends;    /* its chain; else an edge leads to the point after, its sheet on the left */
};

/** Points farther off are moved there. */
#define CHAIN_LIMIT (1 << 24)

/**
 * The silhouettes of all casters as one light sees them: closed chains, the last point of each
 * being its first. Zero is empty; memory is kept from one search to the next.
 */
struct edge_chains {
	struct chain_point *points; /* [count], owned */
	size_t count;
	size_t edge_count;
	/* Working memory; owned */
	uint64_t *facing;
	struct silhouette_edge *edges;
	uint32_t *edge_from;  /* of a caster's vertices */
	uint32_t *edge_after; /* of edges: the next from the same vertex */
	size_t point_capacity, facing_capacity, edge_capacity, from_capacity, after_capacity;
};

/** screen: steps of the raster grid a side. False: out of memory. */
bool edge_chains_find(struct edge_chains *chains, const struct sm_scene *scene,
	const struct light_frame *frame, uint32_t screen);

void edge_chains_finish(struct edge_chains *chains);

/** Of memory. */
size_t edge_chains_bytes(const struct edge_chains *chains);

#endif
