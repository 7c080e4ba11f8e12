/* SPDX-License-Identifier: MIT */
#ifndef TESTS_GEOM_CAPACITY_H
#define TESTS_GEOM_CAPACITY_H

#include "geom/silhouette.h"

/** Finds edges of data: returns their number, and writes no more than capacity. */
typedef size_t (*edge_search)(void *data, struct silhouette_edge *edges, size_t capacity);

/** Asserts that the search finds `needed` edges, that it says so whatever its room is, and that
 * what it writes are the first of them. `step`: from one capacity that is tried to the next. */
void check_capacity(edge_search search, void *data, size_t needed, size_t step);

#endif
