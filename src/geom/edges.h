/* SPDX-License-Identifier: MIT */
#ifndef GEOM_EDGES_H
#define GEOM_EDGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Triangles whose facing fits one word. */
#define EDGE_BLOCK 64

/** What the triangles of a block own. */
struct edge_block {
	/* Records of triangles with the one that follows them: bit t of `next`, and of k at the
	 * owner's corner in `low` and `high`. */
	uint64_t next, low, high;
	size_t records;                /* where its other records begin */
	uint32_t link, leading;        /* where its links begin, and the blocks that lead to it */
	uint8_t near_count, far_count; /* other records */
	uint8_t link_count;            /* other blocks that far records lead to */
};

/** Blocks whose bits fit one word. */
#define EDGE_BLOCK_SET 64

/**
 * Which triangles meet where: one record an edge, of 3 bits where a triangle meets the next one, of
 * 2 bytes where it meets another of the same block, else of 3 and a share of a link, which has 25,
 * 13 where links are many, and 5 where they are more.
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
 * Records are kept per block of 64 triangles, by the owner: those with the next triangle, near
 * ones, whose neighbour is in the same block, and far ones, the open ones among them. The owner's
 * corner is a byte: triangle in the block + 64 k. A block's links are the other blocks that its far
 * records lead to, each once: where the block is on one side of a light, and so are all triangles
 * that these records lead to, nothing of it is on a silhouette.
 */
struct edge_table {
	size_t triangle_count;
	struct edge_block *blocks; /* [edge_table_blocks()] */
	size_t next_count;
	size_t near_count, far_count;
	/* Of each block the owners' corners and the neighbours' places in it of its near records;
	 * then of its far ones the owners' corners, the neighbours' places in their blocks, and
	 * these blocks' among its links: one behind the last where it is open. */
	uint8_t *records;
	size_t link_count;
	uint32_t *links;      /* blocks */
	uint8_t *link_owners; /* the block whose link it is, modulo EDGE_BLOCK_SET */
	uint64_t
		*link_faces; /* a bit for each triangle there that records lead to; or NULL: many */
	uint32_t *leading;   /* [link_count]: blocks that have a link to a block; or NULL: many */
	uint64_t *leading_faces; /* of their links; or NULL */
	uint64_t *open;          /* [edge_table_sets()]: a bit for each block with an open record */
};

/** indices: [3 * triangle_count], each < vertex_count; triangle_count < 2^31. False: out of
 *  memory. */
bool edge_table_init(struct edge_table *table, const uint32_t *indices, size_t triangle_count,
	size_t vertex_count);
void edge_table_finish(struct edge_table *table);

size_t edge_table_blocks(const struct edge_table *table);
/** Words in a set of one bit a block: b is bit b % EDGE_BLOCK_SET of word b / EDGE_BLOCK_SET. */
size_t edge_table_sets(const struct edge_table *table);
size_t edge_table_records(const struct edge_table *table);
size_t edge_table_bytes(const struct edge_table *table);

/** The triangles that records of a link lead to, and maybe others there. */
static inline uint64_t edge_link_faces(const struct edge_table *table, size_t link)
{
	return table->link_faces != NULL ? table->link_faces[link] : UINT64_MAX;
}

/** Where the blocks that lead to block b end. */
static inline size_t edge_leading_end(const struct edge_table *table, size_t b)
{
	return (b + 1) * EDGE_BLOCK < table->triangle_count ? table->blocks[b + 1].leading
							    : table->link_count;
}

/** What a table holds of a block's other records: [near_count] and [far_count]. */
struct edge_records {
	const uint8_t *near_corners, *near_places, *far_corners, *far_places, *far_links;
};

static inline struct edge_records edge_block_records(
	const struct edge_table *table, const struct edge_block *block)
{
	const uint8_t *near = &table->records[block->records];
	const uint8_t *far = near + 2 * (size_t)block->near_count;
	return (struct edge_records){near, near + block->near_count, far, far + block->far_count,
		far + 2 * (size_t)block->far_count};
}

/** Owner's corner of the record of the block's triangle t with the next. */
static inline uint8_t edge_block_corner(const struct edge_block *block, unsigned t)
{
	unsigned k = (unsigned)(block->low >> t & 1) + 2 * (unsigned)(block->high >> t & 1);
	return (uint8_t)(t + EDGE_BLOCK * k);
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
