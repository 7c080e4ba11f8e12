/* SPDX-License-Identifier: MIT */
#ifndef GEOM_EDGES_H
#define GEOM_EDGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Triangles whose facing fits one word. */
#define EDGE_BLOCK 64

/** How many records the triangles of a block own. */
struct edge_block {
	uint8_t near_count, far_count;
};

/**
 * Which triangles meet where: one record an edge, of 2 or 3 bytes when triangles that meet lie near
 * each other in the index buffer, and of 7 at most.
 *
 * Corner k of triangle t is also a half-edge: from its vertex k to vertex (k + 1) mod 3. Two
 * half-edges between the same two vertices in opposite directions are paired and share one record,
 * owned by the one whose triangle comes first; where several triangles meet, the lowest of one
 * direction is paired with the lowest of the other, and so on. A half-edge that is left over has a
 * record of its own, an open one. A triangle with the same vertex twice has no records at all.
 *
 * Invariant: take any set of triangles, and of each record with exactly one triangle in the set
 * the half-edge that belongs to it. These half-edges are the set's boundary as a chain, so that at
 * each vertex as many end as start: they are closed loops, whatever the mesh.
 *
 * Records are kept per block of 64 triangles, by the owner: near ones, whose neighbour is in the
 * same block, and far ones, the open ones among them. The owner's corner is a byte: triangle in the
 * block + 64 k.
 */
struct edge_table {
	size_t triangle_count;
	struct edge_block *blocks; /* [edge_table_blocks()] */
	size_t near_count;
	uint16_t *near; /* owner's corner + 256 * neighbour's place in the block */
	size_t far_count;
	uint8_t *far_corners;    /* owner's corner */
	uint16_t *far_distances; /* neighbour - owner; 0: open; EDGE_ESCAPE: see escapes */
	size_t escape_count;
	uint32_t *escapes; /* neighbours too far for a distance, in the far records' order */
};

#define EDGE_ESCAPE UINT16_MAX

/** indices: [3 * triangle_count], each < vertex_count; triangle_count < 2^31. False: out of
 *  memory. */
bool edge_table_init(struct edge_table *table, const uint32_t *indices, size_t triangle_count,
	size_t vertex_count);
void edge_table_finish(struct edge_table *table);

size_t edge_table_blocks(const struct edge_table *table);
size_t edge_table_records(const struct edge_table *table);
size_t edge_table_bytes(const struct edge_table *table);

/** Reads far records in their order. */
struct edge_far_reader {
	const uint8_t *corner;
	const uint16_t *distance;
	const uint32_t *escape;
};

static inline struct edge_far_reader edge_far_reader_of(const struct edge_table *table)
{
	return (struct edge_far_reader){table->far_corners, table->far_distances, table->escapes};
}

/** Reads one record of the block that starts with triangle `first`. An open record's neighbour is
 *  the owner itself. */
static inline uint8_t edge_far_reader_next(
	struct edge_far_reader *reader, uint32_t first, uint32_t *owner, uint32_t *neighbour)
{
	uint8_t corner = *reader->corner++;
	uint16_t distance = *reader->distance++;
	*owner = first + corner % EDGE_BLOCK;
	*neighbour = *owner + distance;
	if (__builtin_expect(distance == EDGE_ESCAPE, 0))
		*neighbour = *reader->escape++;
	return corner;
}

/** A record as a whole: corner 3 * t + k owns it; neighbour is a triangle, or EDGE_OPEN. */
struct edge_record {
	size_t corner;
	uint32_t neighbour;
};

#define EDGE_OPEN UINT32_MAX

/** Unpacks the table: records: [edge_table_records()]. */
void edge_table_decode(const struct edge_table *table, struct edge_record *records);

#endif
