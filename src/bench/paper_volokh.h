/* SPDX-License-Identifier: MIT */
#ifndef BENCH_PAPER_VOLOKH_H
#define BENCH_PAPER_VOLOKH_H

#include <stddef.h>

/*
 * The numbers of Volokh's Figures 4 and 5, from report/data.txt of his repository, commit 9e0e800.
 * He names no machine; it has a GPU.
 */

/** Ms to find silhouettes and make fins, by edges. */
struct volokh_mesh {
	double edges, ms;
};

/** Ms to draw at 130,000 edges, by texels a side of the map; the fins being there. */
struct volokh_size {
	double map, shadow_map, with_buffers;
};

/** NULL past the last. */
const struct volokh_mesh *volokh_mesh(size_t i);
const struct volokh_size *volokh_size(size_t i);

#endif
