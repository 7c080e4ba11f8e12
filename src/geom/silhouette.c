/* SPDX-License-Identifier: MIT */
#include "geom/silhouette.h"
#include "geom/set_search.h"

#define LINKS_MAX (3 * EDGE_BLOCK)

static inline void list_next(
	struct corner_list *list, const struct edge_block *block, uint64_t facing, uint16_t tag)
{
	uint64_t differ = (facing ^ facing >> 1) & block->next;
	for (; differ != 0; differ &= differ - 1)
		list->corners[list->count++] =
			tag | edge_block_corner(block, (unsigned)__builtin_ctzll(differ));
}

/* Each corner is written, and kept if it counts: there is no branch, which no processor could
 * predict. Of so few instructions, a loop's own are a tenth. */
static inline void list_near(struct corner_list *list, const struct edge_records *records,
	const struct edge_block *block, uint64_t facing, uint16_t tag)
{
	const uint8_t *corners = records->near_corners, *places = records->near_places;
	uint16_t *restrict end = &list->corners[list->count];
#pragma GCC unroll 4
	for (size_t i = 0; i < block->near_count; i++) {
		uint8_t corner = corners[i];
		*end = tag | corner;
		end += (facing >> corner % EDGE_BLOCK ^ facing >> places[i]) & 1;
	}
	list->count = (size_t)(end - list->corners);
}

/* links: of the block. */
static inline void list_far(struct corner_list *list, const struct edge_records *records,
	const struct edge_block *block, const uint32_t *links, const uint64_t *facing, uint64_t own,
	uint16_t tag)
{
	const uint8_t *corners = records->far_corners, *places = records->far_places;
	const uint8_t *links_of = records->far_links;
	uint16_t *restrict end = &list->corners[list->count];
	uint64_t across[LINKS_MAX + 1];
	for (unsigned i = 0; i < block->link_count; i++)
		across[i] = facing[links[i]];
	across[block->link_count] = 0;
#pragma GCC unroll 4
	for (size_t i = 0; i < block->far_count; i++) {
		uint8_t corner = corners[i];
		*end = tag | corner;
		end += (own >> corner % EDGE_BLOCK ^ across[links_of[i]] >> places[i]) & 1;
	}
	list->count = (size_t)(end - list->corners);
}

static inline bool is_uniform(uint64_t facing)
{
	return facing + 1 <= 1;
}

/* skips: records within a block on one side of the light are passed over. */
static inline void list_block(
	const struct set_search *search, unsigned b, bool skips, struct corner_list *list)
{
	const struct edge_table *table = &search->caster->edges;
	const struct edge_block *block = &table->blocks[search->first + b];
	const struct edge_records records = edge_block_records(table, block);
	uint64_t own = search->facing[search->first + b];
	uint16_t tag = (uint16_t)(b << 8);
	if (!skips || !is_uniform(own)) {
		list_next(list, block, own, tag);
		list_near(list, &records, block, own, tag);
	}
	list_far(list, &records, block, &table->links[block->link], search->facing, own, tag);
}

void set_search_list(
	const struct set_search *search, uint64_t blocks, bool skips, struct corner_list *list)
{
	list->count = 0;
	for (; blocks != 0; blocks &= blocks - 1) {
		unsigned b = (unsigned)__builtin_ctzll(blocks);
		list_block(search, b, skips, list);
		list->ends[b] = (uint16_t)list->count;
	}
}

static size_t smaller(size_t a, size_t b)
{
	return a < b ? a : b;
}

/* Where edges go. */
struct edge_output {
	struct silhouette_edge *edges;
	size_t count, capacity;
};

/* blocks: a bit for each of the set that is searched. */
static void find_in_set(
	const struct set_search *search, uint64_t blocks, bool skips, struct edge_output *output)
{
	struct corner_list list;
	set_search_list(search, blocks, skips, &list);
	size_t left = output->capacity - smaller(output->count, output->capacity);
	size_t written = smaller(list.count, left);
	for (size_t i = 0; i < written; i++)
		output->edges[output->count + i] = set_search_edge(search, list.corners[i]);
	output->count += list.count;
}

/* Of a set's blocks on both sides of the light, in 64: with more, no other is worth looking for. */
#define MIXED_MAX 24

/* A bit for each block of a set. */
static uint64_t set_of_blocks(const struct edge_table *table, size_t set)
{
	size_t left = edge_table_blocks(table) - set * EDGE_BLOCK_SET;
	return UINT64_MAX >> (EDGE_BLOCK_SET - smaller(left, EDGE_BLOCK_SET));
}

uint64_t set_search_blocks(const struct edge_table *table, const uint64_t *facing, size_t set)
{
	size_t first = set * EDGE_BLOCK_SET;
	size_t count = smaller(edge_table_blocks(table) - first, EDGE_BLOCK_SET);
	const struct edge_block *last = &table->blocks[first + count - 1];
	uint64_t mixed = 0, lit = 0;
	for (size_t i = 0; i < count; i++) {
		mixed |= (uint64_t)!is_uniform(facing[first + i]) << i;
		lit |= (facing[first + i] & 1) << i;
	}
	if (EDGE_BLOCK_SET * (size_t)__builtin_popcountll(mixed) >= MIXED_MAX * count)
		return set_of_blocks(table, set);
	uint64_t search = mixed | (lit & table->open[set]);
	for (size_t i = table->blocks[first].link; i < last->link + last->link_count; i++) {
		uint8_t owner = table->link_owners[i];
		uint64_t differ = facing[first + owner] ^ facing[table->links[i]];
		search |= (uint64_t)((differ & edge_link_faces(table, i)) != 0) << owner;
	}
	return search;
}

/* skips: sets are passed over in part where it is likely to pay. */
static size_t find(const struct caster *caster, const uint64_t *facing, bool skips,
	struct silhouette_edge *edges, size_t capacity)
{
	struct edge_output output = {edges, 0, capacity};
	const struct edge_table *table = &caster->edges;
	for (size_t set = 0; set < edge_table_sets(table); set++) {
		struct set_search search = {caster, facing, set * EDGE_BLOCK_SET};
		uint64_t all = set_of_blocks(table, set);
		uint64_t blocks = skips ? set_search_blocks(table, facing, set) : all;
		find_in_set(&search, blocks, blocks != all, &output);
	}
	return output.count;
}

size_t silhouette_find(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity)
{
	/* Without cones hardly a block is on one side of a light; where links are many, looking
	 * through them takes longer than through the records that it saves. */
	bool skips = caster->cones.count > 0 && caster->edges.leading != NULL;
	return find(caster, facing, skips, edges, capacity);
}

size_t silhouette_find_all(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity)
{
	return find(caster, facing, false, edges, capacity);
}
