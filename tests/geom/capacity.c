/* SPDX-License-Identifier: MIT */
#include "capacity.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static struct silhouette_edge *room_for(size_t capacity)
{
	struct silhouette_edge *edges = malloc(capacity * sizeof(*edges));
	assert_non_null(edges);
	return edges;
}

void check_capacity(edge_search search, void *data, size_t needed, size_t step)
{
	struct silhouette_edge *all = room_for(needed);
	assert_int_equal(search(data, NULL, 0), needed);
	assert_int_equal(search(data, all, needed), needed);
	for (size_t capacity = 1; capacity <= needed; capacity += step) {
		struct silhouette_edge *exact = room_for(capacity);
		assert_int_equal(search(data, exact, capacity), needed);
		assert_memory_equal(exact, all, capacity * sizeof(*exact));
		free(exact);
	}
	free(all);
}
