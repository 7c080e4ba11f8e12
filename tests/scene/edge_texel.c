/* SPDX-License-Identifier: MIT */
#include "scene/edge_texel.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define SCREEN (512 << 8)

/* What shaders read in half a texel: an end. */
struct end {
	int32_t x, y; /* steps from the lower left */
	double depth;
};

static struct end end_of(const struct edge_texel *texel, int end)
{
	const uint32_t *w = &texel->words[2 * end], mask = (1u << EDGE_DEPTH_BITS) - 1;
	int32_t steps = 1 << EDGE_DEPTH_BITS;
	uint32_t depth = (w[0] & mask) << EDGE_DEPTH_BITS | (w[1] & mask);
	return (struct end){
		.x = ((int32_t)(w[0] & ~mask)) / steps + SCREEN / 2,
		.y = ((int32_t)(w[1] & ~mask)) / steps + SCREEN / 2,
		.depth = (double)(depth & ~1u) / EDGE_DEPTH_STEPS,
	};
}

static void assert_end(
	const struct edge_texel *texel, int end, int32_t x, int32_t y, double depth, double most)
{
	struct end found = end_of(texel, end);
	assert_int_equal(found.x, x);
	assert_int_equal(found.y, y);
	assert_true(fabs(found.depth - depth) <= most);
}

static void ends_stay_on_the_grid(void **state)
{
	(void)state;
	const struct chain_point edges[][2] = {
		{{0, 0, 0.0f, 1}, {SCREEN, SCREEN, 1.0f, 0}},
		{{12345, 67890, 0.123456f, 2}, {-7, SCREEN + 9, 0.999999f, 1}},
		{{-7 * SCREEN, 8 * SCREEN, 0.5f, 1}, {7 * SCREEN, -6 * SCREEN, 0.25f, 2}},
	};
	for (size_t i = 0; i < sizeof(edges) / sizeof(edges[0]); i++) {
		struct edge_texel texel = edge_texel_of(edges[i], SCREEN);
		for (int k = 0; k < 2; k++)
			assert_end(&texel, k, edges[i][k].x, edges[i][k].y,
				(double)edges[i][k].depth, 2.0 / EDGE_DEPTH_STEPS);
		assert_int_equal(texel.words[3] & 1, edges[i][0].sheets > 1);
	}
}

static void the_nearer_end_tells_how_near_an_edge_is(void **state)
{
	(void)state;
	const struct chain_point edge[2] = {{5, 6, 0.75f, 1}, {7, 8, 0.25f, 0}};
	struct edge_texel texel = edge_texel_of(edge, SCREEN);
	assert_int_equal(edge_texel_nearest(&texel), EDGE_DEPTH_STEPS / 4);
}

/* Along the same line. */
static void what_is_far_off_is_cut(void **state)
{
	(void)state;
	const int32_t far = CHAIN_LIMIT, limit = (1 << (EDGE_PLACE_BITS - 1)) - 1;
	const int32_t middle = SCREEN / 2;
	const struct chain_point across[2] = {
		{middle, middle, 0.5f, 1}, {middle + far, middle - far / 2, 0.75f, 0}};
	struct edge_texel texel = edge_texel_of(across, SCREEN);
	double share = (double)limit / far;
	assert_end(&texel, 0, middle, middle, 0.5, 2.0 / EDGE_DEPTH_STEPS);
	assert_end(&texel, 1, middle + limit, middle - (limit + 1) / 2, 0.5 + 0.25 * share,
		2.0 / EDGE_DEPTH_STEPS);
	/* Behind everything from half way on. */
	const struct chain_point behind[2] = {{0, 400, 1.5f, 1}, {1000, 0, 0.5f, 0}};
	texel = edge_texel_of(behind, SCREEN);
	assert_end(&texel, 0, 500, 200, 1.0, 2.0 / EDGE_DEPTH_STEPS);
	assert_end(&texel, 1, 1000, 0, 0.5, 2.0 / EDGE_DEPTH_STEPS);
}

/* Nothing is left but a point. */
static void what_is_beyond_the_range_has_no_length(void **state)
{
	(void)state;
	const int32_t far = CHAIN_LIMIT;
	const struct chain_point edges[][2] = {
		{{far, 0, 0.5f, 1}, {far, far, 0.5f, 0}},
		{{far, 0, 0.5f, 1}, {0, far, 0.5f, 0}},
		{{-far, far, 0.5f, 1}, {far, far, 0.25f, 0}},
		{{10, 20, 2.0f, 1}, {30, 40, CHAIN_DEPTH_MAX, 0}},
	};
	for (size_t i = 0; i < sizeof(edges) / sizeof(edges[0]); i++) {
		struct edge_texel texel = edge_texel_of(edges[i], SCREEN);
		struct end from = end_of(&texel, 0), to = end_of(&texel, 1);
		assert_int_equal(from.x, to.x);
		assert_int_equal(from.y, to.y);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(ends_stay_on_the_grid),
		cmocka_unit_test(the_nearer_end_tells_how_near_an_edge_is),
		cmocka_unit_test(what_is_far_off_is_cut),
		cmocka_unit_test(what_is_beyond_the_range_has_no_length),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
