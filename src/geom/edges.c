/* SPDX-License-Identifier: MIT */
#include "geom/edges.h"
#include "base/array.h"
#include "geom/sides.h"
#include <stdlib.h>

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

static bool is_escape(size_t owner, uint32_t neighbour)
{
	return neighbour != EDGE_OPEN && neighbour - owner >= EDGE_ESCAPE;
}

static bool reserve_records(struct edge_table *table, const uint32_t *neighbours)
{
	table->blocks = array_zalloc(edge_table_blocks(table), sizeof(*table->blocks));
	if (table->blocks == NULL)
		return false;
	for (size_t c = 0; c < 3 * table->triangle_count; c++) {
		if (neighbours[c] == NO_RECORD)
			continue;
		struct edge_block *block = &table->blocks[c / 3 / EDGE_BLOCK];
		bool near = is_near(c / 3, neighbours[c]);
		*(near ? &block->near_count : &block->far_count) += 1;
		*(near ? &table->near_count : &table->far_count) += 1;
		table->escape_count += is_escape(c / 3, neighbours[c]);
	}
	table->near = array_alloc(table->near_count, sizeof(*table->near));
	table->far_corners = array_alloc(table->far_count, sizeof(*table->far_corners));
	table->far_distances = array_alloc(table->far_count, sizeof(*table->far_distances));
	table->escapes = array_alloc(table->escape_count, sizeof(*table->escapes));
	return table->near != NULL && table->far_corners != NULL && table->far_distances != NULL &&
	       table->escapes != NULL;
}

static void fill_records(struct edge_table *table, const uint32_t *neighbours)
{
	uint16_t *near = table->near, *distance = table->far_distances;
	uint8_t *corner = table->far_corners;
	uint32_t *escape = table->escapes;
	for (size_t c = 0; c < 3 * table->triangle_count; c++) {
		size_t owner = c / 3, k = c % 3;
		uint32_t neighbour = neighbours[c];
		if (neighbour == NO_RECORD)
			continue;
		size_t place = owner % EDGE_BLOCK + k * EDGE_BLOCK;
		if (is_near(owner, neighbour)) {
			*near++ = (uint16_t)(place + neighbour % EDGE_BLOCK * 256);
			continue;
		}
		*corner++ = (uint8_t)place;
		*distance++ = neighbour == EDGE_OPEN        ? 0
			      : is_escape(owner, neighbour) ? EDGE_ESCAPE
							    : (uint16_t)(neighbour - owner);
		if (is_escape(owner, neighbour))
			*escape++ = neighbour;
	}
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
	free(table->far_distances);
	free(table->escapes);
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
	       table->far_count * (sizeof(*table->far_corners) + sizeof(*table->far_distances)) +
	       table->escape_count * sizeof(*table->escapes);
}

static struct edge_record record_of(uint32_t owner, unsigned corner, uint32_t neighbour)
{
	return (struct edge_record){
		.corner = 3 * (size_t)owner + corner / EDGE_BLOCK,
		.neighbour = neighbour == owner ? EDGE_OPEN : neighbour,
	};
}

void edge_table_decode(const struct edge_table *table, struct edge_record *records)
{
	const uint16_t *near = table->near;
	struct edge_far_reader far = edge_far_reader_of(table);
	for (size_t b = 0; b < edge_table_blocks(table); b++) {
		uint32_t first = (uint32_t)(b * EDGE_BLOCK), owner, neighbour;
		for (unsigned i = 0; i < table->blocks[b].near_count; i++, near++)
			*records++ = record_of(
				first + *near % EDGE_BLOCK, *near % 256, first + *near / 256);
		for (unsigned i = 0; i < table->blocks[b].far_count; i++) {
			uint8_t corner = edge_far_reader_next(&far, first, &owner, &neighbour);
			*records++ = record_of(owner, corner, neighbour);
		}
	}
}
