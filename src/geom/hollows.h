/* SPDX-License-Identifier: MIT */
#ifndef GEOM_HOLLOWS_H
#define GEOM_HOLLOWS_H

#include "geom/edges.h"

/** A triangle of a closed part, and one beside it that rises before its plane. */
struct hollow {
	uint32_t triangle;
	uint32_t corner; /* 3 * the other + k: its vertices k and k + 1 are of both */
};

/** Where closed parts are hollow: along edges at which the one triangle's third vertex is before
 *  the other's plane by more than a twentieth of how far it is from the edge's end. */
struct hollows {
	struct hollow *of; /* [count], by their triangles, owned */
	size_t count;
	uint32_t *ends; /* [block_count], where those of each block of EDGE_BLOCK triangles end;
			   owned */
	size_t block_count;
};

/** indices: [3 * closed_count] at least, of the closed parts' triangles, which come first. False:
 *  out of memory. */
bool hollows_init(struct hollows *hollows, const float (*positions)[3], const uint32_t *indices,
	const struct edge_table *edges, size_t closed_count);
void hollows_finish(struct hollows *hollows);

size_t hollows_bytes(const struct hollows *hollows);

#endif
