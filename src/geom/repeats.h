/* SPDX-License-Identifier: MIT */
#ifndef GEOM_REPEATS_H
#define GEOM_REPEATS_H

#include "geom/sides.h"

/**
 * Removes each triangle between the same three vertices as an earlier one, whichever way the two
 * are wound; the order stays. sides: of the indices, [3 * *triangle_count], each < vertex_count.
 * Takes linear time. False: out of memory, and nothing is changed.
 */
bool repeats_drop(
	const struct sides *sides, size_t vertex_count, uint32_t *indices, size_t *triangle_count);

#endif
