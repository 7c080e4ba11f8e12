/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SIDES_H
#define GEOM_SIDES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A half-edge, filed under its two vertices. */
struct side {
	uint32_t vertex[2]; /* ascending */
	uint32_t triangle;
	uint8_t k;        /* corner of the triangle */
	uint8_t reversed; /* 1: it runs from vertex[1] to vertex[0] */
};

/** The sides of all triangles, those of one edge next to each other in the order of their
 *  corners. */
struct sides {
	size_t count;
	struct side *items;
};

/** Of undirected edges: distinct pairs of vertices. */
struct edge_counts {
	size_t edges;
	size_t open;         /* with one triangle */
	size_t non_manifold; /* with more than two */
	size_t inverted;     /* with two, which run through it the same way */
};

/** indices: [3 * triangle_count], each < vertex_count; triangle_count < 2^31. A triangle with the
 *  same vertex twice has no sides. Takes linear time. False: out of memory. */
bool sides_init(
	struct sides *sides, const uint32_t *indices, size_t triangle_count, size_t vertex_count);
void sides_finish(struct sides *sides);

/** How many sides the edge has whose first is item `begin`. */
size_t sides_at_edge(const struct sides *sides, size_t begin);

struct edge_counts sides_count_edges(const struct sides *sides);

static inline size_t side_corner(const struct side *side)
{
	return 3 * (size_t)side->triangle + side->k;
}

#endif
