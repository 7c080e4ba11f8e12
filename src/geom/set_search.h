/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SET_SEARCH_H
#define GEOM_SET_SEARCH_H

#include "geom/silhouette.h"

/** A set of blocks that is searched for edges. */
struct set_search {
	const struct caster *caster;
	const uint64_t *facing;
	size_t first; /* block */
};

/** Half-edges on the silhouette, of a set of blocks: the corner within its block, and the block
 * within the set times 256. They are gathered first and then written in one go, because triangles
 * are far apart in memory: a processor waits for many of them at once only where there is nothing
 * to mispredict between. */
struct corner_list {
	size_t count;
	uint16_t corners[EDGE_BLOCK_SET * 3 * EDGE_BLOCK];
	uint16_t ends[EDGE_BLOCK_SET]; /* of each block that was listed: the count behind it */
};

/** Lists the edges of some of the set's blocks, a bit for each, in the blocks' order. skips:
 * records within a block on one side of the light are passed over. */
void set_search_list(
	const struct set_search *search, uint64_t blocks, bool skips, struct corner_list *list);

/** Those blocks of a set that may have edges, a bit for each: the ones that are not on one side of
 *  the light, and that lead to a triangle that is not on theirs. */
uint64_t set_search_blocks(const struct edge_table *table, const uint64_t *facing, size_t set);

/** Has memory fetched that set_search_edge() reads. */
static inline void set_search_fetch(const struct set_search *search, uint16_t corner)
{
	size_t b = search->first + corner / 256;
	__builtin_prefetch(&search->caster->indices[3 * (b * EDGE_BLOCK + corner % EDGE_BLOCK)]);
}

/** The edge of one of the list's corners. Which way round it is depends on the facing without a
 * branch, which no processor could predict. */
static inline struct silhouette_edge set_search_edge(
	const struct set_search *search, uint16_t corner)
{
	/* By k, and from 4 on for triangles that face the light: the edge's ends. */
	static const uint8_t from[8] = {1, 2, 0, 0, 0, 1, 2, 0}, to[8] = {0, 1, 2, 0, 1, 2, 0, 0};
	size_t b = search->first + corner / 256, t = corner % EDGE_BLOCK;
	const uint32_t *corners = &search->caster->indices[3 * (b * EDGE_BLOCK + t)];
	unsigned side = corner / EDGE_BLOCK % 4 + 4 * (unsigned)(search->facing[b] >> t & 1);
	return (struct silhouette_edge){corners[from[side]], corners[to[side]]};
}

#endif
