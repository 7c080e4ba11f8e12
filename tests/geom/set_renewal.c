/* SPDX-License-Identifier: MIT */
#include "geom/set_renewal.h"
#include "geom/facing.h"
#include "geom/mesh.h"
#include "models.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Of a sphere's first set. */
#define EDGES_MAX (3 * EDGE_BLOCK * EDGE_BLOCK_SET)

/* Edges that must stay as they are. */
#define GUARDS 16

struct edges {
	size_t count;
	struct silhouette_edge at[EDGES_MAX];
	uint16_t starts[EDGE_BLOCK_SET];
};

/* Each block of the set by itself: by what faces the light now, where it is one of `renew`, or by
 * what did. */
static void find_by_blocks(const struct caster *caster, const uint64_t *now, const uint64_t *before,
	uint64_t renew, struct edges *found)
{
	static struct corner_list list;
	found->count = 0;
	for (unsigned b = 0; b < EDGE_BLOCK_SET; b++) {
		const struct set_search search = {caster, renew >> b & 1 ? now : before, 0};
		set_search_list(&search, UINT64_C(1) << b, false, &list);
		found->starts[b] = (uint16_t)found->count;
		for (size_t i = 0; i < list.count; i++)
			found->at[found->count++] = set_search_edge(&search, list.corners[i]);
	}
}

/* An array of exactly so many, and guards behind them; on the heap, where sanitizers look. */
static struct silhouette_edge *new_edges(size_t count, size_t guards)
{
	struct silhouette_edge *edges = malloc((count + guards) * sizeof(*edges) + 1);
	assert_non_null(edges);
	memset(edges, 0xaa, (count + guards) * sizeof(*edges));
	return edges;
}

/* spare: edges behind those kept and the next ones that are the set's to read and write. */
static void check_renewal(const struct caster *caster, const uint64_t *now, const uint64_t *before,
	uint64_t renew, size_t spare)
{
	static struct edges kept, expected;
	static struct corner_list list;
	static uint16_t listed[EDGE_BLOCK_SET + EDGES_MAX];
	const struct set_search search = {caster, now, 0};
	find_by_blocks(caster, now, before, 0, &kept);
	find_by_blocks(caster, now, before, renew, &expected);
	set_search_list(&search, renew, false, &list);
	uint16_t *end = listed;
	for (uint64_t left = renew; left != 0; left &= left - 1)
		*end++ = list.ends[__builtin_ctzll(left)];
	memcpy(end, list.corners, list.count * sizeof(*end));
	struct silhouette_edge *from = new_edges(kept.count + spare, 0);
	struct silhouette_edge *next = new_edges(expected.count + spare, GUARDS);
	struct silhouette_edge *guards = new_edges(0, GUARDS);
	memcpy(from, kept.at, kept.count * sizeof(*from));
	struct set_renewal renewal = {
		.kept = from,
		.size = kept.count,
		.kept_room = kept.count + spare,
		.next = next,
		.next_room = expected.count + spare,
		.starts = kept.starts,
		.count = EDGE_BLOCK_SET,
	};
	const uint16_t *behind = set_renewal_write(&renewal, &search, renew, listed);
	assert_ptr_equal(behind, end + list.count);
	assert_int_equal(renewal.written, expected.count);
	assert_memory_equal(next, expected.at, expected.count * sizeof(*next));
	assert_memory_equal(kept.starts, expected.starts, sizeof(expected.starts));
	assert_memory_equal(&next[expected.count + spare], guards, GUARDS * sizeof(*next));
	free(guards);
	free(next);
	free(from);
}

/* A set whose triangles all face one way, whose edges are all between it and others, and one with
 * any facing. */
static void take_facing(uint64_t *state, uint64_t *facing, size_t words)
{
	unsigned kind = random_next(state) % 4;
	for (size_t i = 0; i < words; i++) {
		uint64_t word = (uint64_t)random_next(state) << 32 | random_next(state);
		uint64_t sparse = word & word >> 7 & word << 11 & word >> 23;
		facing[i] = kind == 0 ? 0 : kind == 1 ? word : kind == 2 ? sparse : ~sparse;
	}
}

static void writes_the_listed_blocks_and_keeps_the_others(void **state)
{
	(void)state;
	struct model model = model_sphere(6);
	struct sm_mesh_desc desc = model_desc(&model, "renewal");
	struct mesh mesh;
	assert_true(mesh_init(&mesh, &desc, NULL));
	size_t words = facing_words(&mesh.caster);
	uint64_t *facing[2] = {malloc(words * sizeof(uint64_t)), malloc(words * sizeof(uint64_t))};
	assert_true(facing[0] != NULL && facing[1] != NULL && words >= EDGE_BLOCK_SET);
	uint64_t random = 3;
	for (unsigned i = 0; i < 400; i++) {
		uint64_t any = (uint64_t)random_next(&random) << 32 | random_next(&random);
		const uint64_t renew[] = {any, any & any >> 5 & any << 9, ~any | any << 3, 0,
			UINT64_MAX, UINT64_C(1) << 63, 1};
		take_facing(&random, facing[0], words);
		take_facing(&random, facing[1], words);
		check_renewal(&mesh.caster, facing[0], facing[1], renew[i % 7], i % 13);
	}
	free(facing[0]);
	free(facing[1]);
	mesh_finish(&mesh);
	model_finish(&model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(writes_the_listed_blocks_and_keeps_the_others),
	};
	return cmocka_run_group_tests_name("set_renewal", tests, NULL, NULL);
}
