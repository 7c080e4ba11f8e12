/* SPDX-License-Identifier: MIT */
#include "geom/edges.h"
#include "base/array.h"
#include "geom/sides.h"
#include <stdlib.h>
#include <string.h>

/* What the table holds about a half-edge, while it is built. Triangles are below 2^31. */
#define NO_RECORD (UINT32_MAX - 1)

/* Of fewer records a link, it isn't kept which triangles links lead to: that takes 8 bytes each,
 * and such meshes hang together so little that it saves nothing. */
#define LINK_RECORDS_MIN 4
/* Of fewer, links are not kept the other way around. */
#define LEADING_RECORDS_MIN 8

/* The first side from i on that runs this way. */
static size_t next_side(const struct side *sides, size_t count, size_t i, uint8_t reversed)
{
	while (i < count && sides[i].reversed != reversed)
		i++;
	return i;
}

/* Pairs off the sides of one edge, in the order of their corners. */
static void pair_group(const struct side *sides, size_t count, uint32_t *neighbours)
{
	size_t i = next_side(sides, count, 0, 0);
	size_t j = next_side(sides, count, 0, 1);
	while (i < count && j < count) {
		const struct side *owner = &sides[i < j ? i : j];
		const struct side *other = &sides[i < j ? j : i];
		neighbours[side_corner(owner)] = other->triangle;
		i = next_side(sides, count, i + 1, 0);
		j = next_side(sides, count, j + 1, 1);
	}
	for (; i < count; i = next_side(sides, count, i + 1, 0))
		neighbours[side_corner(&sides[i])] = EDGE_OPEN;
	for (; j < count; j = next_side(sides, count, j + 1, 1))
		neighbours[side_corner(&sides[j])] = EDGE_OPEN;
}

/* Fills neighbours: [3 * triangle_count]. */
static bool pair_sides(const struct edge_table *table, const uint32_t *indices, size_t vertex_count,
	uint32_t *neighbours)
{
	for (size_t c = 0; c < 3 * table->triangle_count; c++)
		neighbours[c] = NO_RECORD;
	struct sides sides;
	if (!sides_init(&sides, indices, table->triangle_count, vertex_count))
		return false;
	for (size_t begin = 0, count; begin < sides.count; begin += count) {
		count = sides_at_edge(&sides, begin);
		pair_group(&sides.items[begin], count, neighbours);
	}
	sides_finish(&sides);
	return true;
}

static bool is_near(size_t owner, uint32_t neighbour)
{
	return neighbour != EDGE_OPEN && neighbour / EDGE_BLOCK == owner / EDGE_BLOCK;
}

/* The links of a block, as its far records come to them: room for one of each record. */
struct link_list {
	unsigned count;
	uint32_t blocks[3 * EDGE_BLOCK];
};

/* Where a block is in the list, which it is added to. */
static unsigned link_to(struct link_list *list, uint32_t block)
{
	unsigned i = 0;
	while (i < list->count && list->blocks[i] != block)
		i++;
	list->blocks[i] = block;
	list->count += i == list->count;
	return i;
}

static size_t block_end(const struct edge_table *table, size_t b)
{
	size_t left = table->triangle_count - b * EDGE_BLOCK;
	return b * EDGE_BLOCK + (left < EDGE_BLOCK ? left : EDGE_BLOCK);
}

/* Whether it can be one of the block's records with the next triangle; it is entered there. */
static bool enter_next(struct edge_block *block, size_t corner, uint32_t neighbour)
{
	size_t owner = corner / 3, place = owner % EDGE_BLOCK, k = corner % 3;
	uint64_t bit = UINT64_C(1) << place;
	if (neighbour != owner + 1 || place == EDGE_BLOCK - 1 || (block->next & bit) != 0)
		return false;
	block->next |= bit;
	block->low |= (k & 1) << place;
	block->high |= (k >> 1) << place;
	return true;
}

/* Enters what is with the next triangle, taking it from the neighbours, and counts the rest. */
static void count_block(struct edge_table *table, uint32_t *neighbours, size_t b)
{
	struct edge_block *block = &table->blocks[b];
	struct link_list list = {.count = 0};
	*block = (struct edge_block){.records = 2 * table->near_count + 3 * table->far_count,
		.link = (uint32_t)table->link_count};
	for (size_t c = 3 * b * EDGE_BLOCK; c < 3 * block_end(table, b); c++) {
		if (neighbours[c] == NO_RECORD)
			continue;
		if (enter_next(block, c, neighbours[c])) {
			table->next_count++;
			neighbours[c] = NO_RECORD;
			continue;
		}
		bool near = is_near(c / 3, neighbours[c]), open = neighbours[c] == EDGE_OPEN;
		*(near ? &block->near_count : &block->far_count) += 1;
		if (!near && !open)
			link_to(&list, neighbours[c] / EDGE_BLOCK);
		table->open[b / EDGE_BLOCK_SET] |= (uint64_t)open << b % EDGE_BLOCK_SET;
	}
	block->link_count = (uint8_t)list.count;
	table->near_count += block->near_count;
	table->far_count += block->far_count;
	table->link_count += block->link_count;
}

static bool reserve_records(struct edge_table *table, uint32_t *neighbours)
{
	table->blocks = array_alloc(edge_table_blocks(table), sizeof(*table->blocks));
	table->open = array_zalloc(edge_table_sets(table), sizeof(*table->open));
	if (table->blocks == NULL || table->open == NULL)
		return false;
	for (size_t b = 0; b < edge_table_blocks(table); b++)
		count_block(table, neighbours, b);
	if (table->link_count > UINT32_MAX)
		return false;
	table->records =
		array_alloc(2 * table->near_count + 3 * table->far_count, sizeof(*table->records));
	table->links = array_alloc(table->link_count, sizeof(*table->links));
	table->link_owners = array_alloc(table->link_count, sizeof(*table->link_owners));
	return table->records != NULL && table->links != NULL && table->link_owners != NULL;
}

static bool reserve_link_faces(struct edge_table *table)
{
	if (table->link_count > edge_table_records(table) / LINK_RECORDS_MIN)
		return true;
	table->link_faces = array_zalloc(table->link_count, sizeof(*table->link_faces));
	return table->link_faces != NULL;
}

static bool reserve_leading(struct edge_table *table)
{
	if (table->link_count > edge_table_records(table) / LEADING_RECORDS_MIN)
		return true;
	table->leading = array_alloc(table->link_count, sizeof(*table->leading));
	table->leading_faces = array_alloc(table->link_count, sizeof(*table->leading_faces));
	return table->leading != NULL && table->leading_faces != NULL;
}

static void fill_link_faces(const struct edge_table *table, const struct edge_block *block)
{
	const struct edge_records records = edge_block_records(table, block);
	for (size_t i = 0; i < block->far_count; i++)
		if (records.far_links[i] < block->link_count)
			table->link_faces[block->link + records.far_links[i]] |=
				UINT64_C(1) << records.far_places[i];
}

/* Fills what one block owns. */
static void fill_block(const struct edge_table *table, const uint32_t *neighbours, size_t b)
{
	const struct edge_block *block = &table->blocks[b];
	struct link_list list = {.count = 0};
	uint8_t *near = &table->records[block->records];
	uint8_t *far = near + 2 * (size_t)block->near_count;
	for (size_t c = 3 * b * EDGE_BLOCK; c < 3 * block_end(table, b); c++) {
		uint32_t neighbour = neighbours[c];
		if (neighbour == NO_RECORD)
			continue;
		uint8_t corner = (uint8_t)(c / 3 % EDGE_BLOCK + c % 3 * EDGE_BLOCK);
		uint8_t place = neighbour == EDGE_OPEN ? 0 : neighbour % EDGE_BLOCK;
		if (is_near(c / 3, neighbour)) {
			near[block->near_count] = place;
			*near++ = corner;
			continue;
		}
		far[block->far_count] = place;
		far[2 * (size_t)block->far_count] =
			neighbour == EDGE_OPEN ? block->link_count
					       : (uint8_t)link_to(&list, neighbour / EDGE_BLOCK);
		*far++ = corner;
	}
	memcpy(&table->links[block->link], list.blocks, list.count * sizeof(*list.blocks));
	memset(&table->link_owners[block->link], (int)(b % EDGE_BLOCK_SET), list.count);
	if (table->link_faces != NULL)
		fill_link_faces(table, block);
}

/* Sorts the owners of links by the blocks that these lead to. */
static void fill_leading(struct edge_table *table)
{
	size_t blocks = edge_table_blocks(table);
	uint32_t sum = 0;
	for (size_t b = 0; b < blocks; b++)
		table->blocks[b].leading = 0;
	for (size_t i = 0; i < table->link_count; i++)
		table->blocks[table->links[i]].leading++;
	/* Behind the last one of each block, which is then filled backwards. */
	for (size_t b = 0; b < blocks; b++)
		sum = table->blocks[b].leading += sum;
	for (size_t b = blocks; b-- > 0;)
		for (size_t i = 0; i < table->blocks[b].link_count; i++) {
			size_t link = table->blocks[b].link + i;
			size_t place = --table->blocks[table->links[link]].leading;
			table->leading[place] = (uint32_t)b;
			table->leading_faces[place] = table->link_faces[link];
		}
}

static void fill_records(struct edge_table *table, const uint32_t *neighbours)
{
	for (size_t b = 0; b < edge_table_blocks(table); b++)
		fill_block(table, neighbours, b);
	if (table->leading != NULL)
		fill_leading(table);
}

bool edge_table_init(struct edge_table *table, const uint32_t *indices, size_t triangle_count,
	size_t vertex_count)
{
	*table = (struct edge_table){.triangle_count = triangle_count};
	uint32_t *neighbours = array_alloc(triangle_count, 3 * sizeof(*neighbours));
	bool ok = neighbours != NULL && pair_sides(table, indices, vertex_count, neighbours) &&
		  reserve_records(table, neighbours) && reserve_link_faces(table) &&
		  reserve_leading(table);
	if (ok)
		fill_records(table, neighbours);
	else
		edge_table_finish(table);
	free(neighbours);
	return ok;
}

void edge_table_finish(struct edge_table *table)
{
	free(table->blocks);
	free(table->records);
	free(table->links);
	free(table->link_owners);
	free(table->leading);
	free(table->leading_faces);
	free(table->link_faces);
	free(table->open);
	*table = (struct edge_table){0};
}

size_t edge_table_blocks(const struct edge_table *table)
{
	return table->triangle_count / EDGE_BLOCK + (table->triangle_count % EDGE_BLOCK != 0);
}

size_t edge_table_sets(const struct edge_table *table)
{
	return (edge_table_blocks(table) + EDGE_BLOCK_SET - 1) / EDGE_BLOCK_SET;
}

size_t edge_table_records(const struct edge_table *table)
{
	return table->next_count + table->near_count + table->far_count;
}

size_t edge_table_bytes(const struct edge_table *table)
{
	size_t link = sizeof(*table->links) + sizeof(*table->link_owners);
	if (table->link_faces != NULL)
		link += sizeof(*table->link_faces);
	if (table->leading != NULL)
		link += sizeof(*table->leading) + sizeof(*table->leading_faces);
	return edge_table_blocks(table) * sizeof(*table->blocks) + 2 * table->near_count +
	       3 * table->far_count + table->link_count * link +
	       edge_table_sets(table) * sizeof(*table->open);
}

static struct edge_record record_of(size_t first, unsigned corner, uint32_t neighbour)
{
	return (struct edge_record){
		.corner = 3 * (first + corner % EDGE_BLOCK) + corner / EDGE_BLOCK,
		.neighbour = neighbour,
	};
}

void edge_table_decode(const struct edge_table *table, struct edge_record *records)
{
	for (size_t b = 0; b < edge_table_blocks(table); b++) {
		struct edge_block block = table->blocks[b];
		size_t first = b * EDGE_BLOCK;
		for (unsigned t = 0; t < EDGE_BLOCK; t++)
			if (block.next >> t & 1)
				*records++ = record_of(first, edge_block_corner(&block, t),
					(uint32_t)first + t + 1);
		const struct edge_records held = edge_block_records(table, &block);
		for (size_t i = 0; i < block.near_count; i++)
			*records++ = record_of(
				first, held.near_corners[i], (uint32_t)first + held.near_places[i]);
		for (size_t i = 0; i < block.far_count; i++) {
			uint8_t link = held.far_links[i];
			*records++ = record_of(first, held.far_corners[i],
				link == block.link_count
					? EDGE_OPEN
					: table->links[block.link + link] * EDGE_BLOCK +
						  held.far_places[i]);
		}
	}
}
