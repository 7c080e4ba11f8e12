/* SPDX-License-Identifier: MIT */
#include "geom/edges.h"
#include "base/array.h"
#include "geom/sides.h"
#include <stdlib.h>
#include <string.h>

/* What the table holds about a half-edge, while it is built. Triangles are below 2^31. */
#define NO_RECORD (UINT32_MAX - 1)

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

static void count_block(struct edge_table *table, const uint32_t *neighbours, size_t b)
{
	struct edge_block *block = &table->blocks[b];
	struct link_list list = {.count = 0};
	for (size_t c = 3 * b * EDGE_BLOCK; c < 3 * block_end(table, b); c++) {
		if (neighbours[c] == NO_RECORD)
			continue;
		bool near = is_near(c / 3, neighbours[c]), open = neighbours[c] == EDGE_OPEN;
		*(near ? &block->near_count : &block->far_count) += 1;
		if (!near && !open)
			link_to(&list, neighbours[c] / EDGE_BLOCK);
		block->open |= open;
	}
	block->link_count = (uint8_t)list.count;
	table->near_count += block->near_count;
	table->far_count += block->far_count;
	table->link_count += block->link_count;
}

static bool reserve_records(struct edge_table *table, const uint32_t *neighbours)
{
	table->blocks = array_zalloc(edge_table_blocks(table), sizeof(*table->blocks));
	if (table->blocks == NULL)
		return false;
	for (size_t b = 0; b < edge_table_blocks(table); b++)
		count_block(table, neighbours, b);
	table->near = array_alloc(table->near_count, sizeof(*table->near));
	table->far_corners = array_alloc(table->far_count, sizeof(*table->far_corners));
	table->far_ends = array_alloc(table->far_count, sizeof(*table->far_ends));
	table->links = array_alloc(table->link_count, sizeof(*table->links));
	return table->near != NULL && table->far_corners != NULL && table->far_ends != NULL &&
	       table->links != NULL;
}

/* Where the next record and link go. */
struct edge_writer {
	uint16_t *near;
	uint8_t *corner;
	uint16_t *end;
	uint32_t *link;
};

static void fill_block(const struct edge_table *table, const uint32_t *neighbours, size_t b,
	struct edge_writer *writer)
{
	struct link_list list = {.count = 0};
	unsigned open = table->blocks[b].link_count;
	for (size_t c = 3 * b * EDGE_BLOCK; c < 3 * block_end(table, b); c++) {
		size_t owner = c / 3, k = c % 3;
		uint32_t neighbour = neighbours[c];
		if (neighbour == NO_RECORD)
			continue;
		size_t corner = owner % EDGE_BLOCK + k * EDGE_BLOCK, place = neighbour % EDGE_BLOCK;
		if (is_near(owner, neighbour)) {
			*writer->near++ = (uint16_t)(corner + 256 * place);
			continue;
		}
		*writer->corner++ = (uint8_t)corner;
		*writer->end++ =
			(uint16_t)(neighbour == EDGE_OPEN
					   ? 256 * open
					   : 256 * link_to(&list, neighbour / EDGE_BLOCK) + place);
	}
	memcpy(writer->link, list.blocks, list.count * sizeof(*list.blocks));
	writer->link += list.count;
}

static void fill_records(struct edge_table *table, const uint32_t *neighbours)
{
	struct edge_writer writer = {
		table->near, table->far_corners, table->far_ends, table->links};
	for (size_t b = 0; b < edge_table_blocks(table); b++)
		fill_block(table, neighbours, b, &writer);
}

bool edge_table_init(struct edge_table *table, const uint32_t *indices, size_t triangle_count,
	size_t vertex_count)
{
	*table = (struct edge_table){.triangle_count = triangle_count};
	uint32_t *neighbours = array_alloc(triangle_count, 3 * sizeof(*neighbours));
	bool ok = neighbours != NULL && pair_sides(table, indices, vertex_count, neighbours) &&
		  reserve_records(table, neighbours);
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
	free(table->near);
	free(table->far_corners);
	free(table->far_ends);
	free(table->links);
	*table = (struct edge_table){0};
}

size_t edge_table_blocks(const struct edge_table *table)
{
	return table->triangle_count / EDGE_BLOCK + (table->triangle_count % EDGE_BLOCK != 0);
}

size_t edge_table_records(const struct edge_table *table)
{
	return table->near_count + table->far_count;
}

size_t edge_table_bytes(const struct edge_table *table)
{
	return edge_table_blocks(table) * sizeof(*table->blocks) +
	       table->near_count * sizeof(*table->near) +
	       table->far_count * (sizeof(*table->far_corners) + sizeof(*table->far_ends)) +
	       table->link_count * sizeof(*table->links);
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
	const uint16_t *near = table->near, *end = table->far_ends;
	const uint8_t *corner = table->far_corners;
	const uint32_t *links = table->links;
	for (size_t b = 0; b < edge_table_blocks(table); b++) {
		struct edge_block block = table->blocks[b];
		size_t first = b * EDGE_BLOCK;
		for (unsigned i = 0; i < block.near_count; i++, near++)
			*records++ = record_of(first, *near % 256, (uint32_t)first + *near / 256);
		for (unsigned i = 0; i < block.far_count; i++, end++) {
			unsigned link = *end / 256;
			*records++ = record_of(first, *corner++,
				link == block.link_count ? EDGE_OPEN
							 : links[link] * EDGE_BLOCK + *end % 256);
		}
		links += block.link_count;
	}
}
