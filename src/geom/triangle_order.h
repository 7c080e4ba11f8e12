/* SPDX-License-Identifier: MIT */
#ifndef GEOM_TRIANGLE_ORDER_H
#define GEOM_TRIANGLE_ORDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/**
 * Reorders the triangles from `first` on so that those of a block of EDGE_BLOCK hang together and
 * show nearly one side, and blocks that follow each other lie and look alike: most blocks then face
 * a light as a whole.
 *
 * positions: [vertex_count][3], finite; indices: [3 * triangle_count], each < vertex_count;
 * triangle_count < 2^31. Takes n log n time. False, and nothing changed: out of memory.
 */
bool triangle_order_blocks(const float (*positions)[3], size_t vertex_count, uint32_t *indices,
	size_t first, size_t triangle_count);

#endif
