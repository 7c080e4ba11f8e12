/* SPDX-License-Identifier: MIT */
#ifndef SCENE_EDGE_LISTS_WRITE_H
#define SCENE_EDGE_LISTS_WRITE_H

#include "base/float_range.h"
#include "scene/edge_lists.h"

/** An edge that is listed, by its first point. */
struct keyed_edge {
	uint32_t nearest; /* edge_texel_nearest() */
	uint32_t edge, texel;
};

/** Of its ends' depths. */
static inline float edge_nearest(const struct chain_point *edge)
{
	return smaller(edge[0].depth, edge[1].depth);
}

/** Notes that an edge is listed; returns whether its run goes on there. Runs end at the same edges
 * in all tiles, whatever else is listed. */
static inline bool list_continues(struct list_end *end, size_t edge)
{
	bool goes_on = edge % EDGE_RUN_MAX != 0 && end->last_edge == edge;
	end->last_edge = (uint32_t)edge + 1;
	return goes_on;
}

static inline bool edge_is_listed(const struct edge_lists *lists, size_t edge)
{
	return lists->entry_ends[edge] > (edge > 0 ? lists->entry_ends[edge - 1] : 0);
}

/** Vertices that an edge adds to those of the edges before it. */
static inline uint32_t edge_added_vertices(const struct edge_lists *lists, size_t edge)
{
	if (!edge_is_listed(lists, edge))
		return 0;
	return edge > 0 && edge_is_listed(lists, edge - 1) ? 1 : 2;
}

/** Gives each list its own edges, of what has been collected. False: out of memory. */
bool edge_lists_make_whole(struct edge_lists *lists, const struct edge_chains *chains);

#endif
