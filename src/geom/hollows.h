/* SPDX-License-Identifier: MIT */
#ifndef GEOM_HOLLOWS_H
#define GEOM_HOLLOWS_H

#include "geom/edges.h"

/** A triangle of a closed part, and one beside it. */
struct hollow {
	uint32_t triangle;
	uint32_t corner; /* 3 * the other + k: its vertices k and k + 1 are of both */
};

/** Where closed parts are hollow: the triangle beside rises before the other's plane. Of a mesh
 * that moves all places where two triangles meet, which may become so. */
struct hollows {
	struct hollow *of; /* [count], by their triangles, owned */
	size_t count;
	uint32_t *ends; /* [block_count], where those of each block of EDGE_BLOCK triangles end;
			   owned */
	size_t block_count;
	bool moving; /* which of them rise is to be asked */
};

/** indices: [3 * closed_count] at least, of the closed parts' triangles, which come first.
 *  positions: NULL for a mesh that moves. False: out of memory; finish it also then. */
bool hollows_init(struct hollows *hollows, const float (*positions)[3], const uint32_t *indices,
	const struct edge_table *edges, size_t closed_count);
void hollows_finish(struct hollows *hollows);

/** Whether the third vertex of the one beside is before the triangle's plane by more than a
 *  twentieth of how far it is from the edge's end. */
bool hollow_rises(
	const struct hollow *hollow, const float (*positions)[3], const uint32_t *indices);

size_t hollows_bytes(const struct hollows *hollows);

#endif
