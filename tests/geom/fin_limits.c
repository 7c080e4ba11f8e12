/* SPDX-License-Identifier: MIT */
/* Fins that are not drawn in full, or not at all, since no one would see the difference. */
#include "fin_probe.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* 1 - b/r of a blocker at distance b and a receiver at the far plane, 3, in `perspective`. */
static float drawn_at(float b)
{
	return 1.0f - b / 3.0f;
}

static void fins_are_drawn_as_far_out_as_any_receiver_asks(void **state)
{
	(void)state;
	const struct {
		struct fin_law law;
		float width, middle; /* at distance 2, and of that what is drawn */
	} cases[] = {
		{fin_law_perspective(0.1f, 1, 3), 0.05f, 1.0f / 3.0f},
		{fin_law_constant(0.1f), 0.1f, 1.0f},
		{fin_law_parallel(0.1f), 0.025f, 1.0f},
	};
	const float positions[2][3] = {{-1, 0, -2}, {1, 0, -2}};
	const struct silhouette_edge edge = {0, 1};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct fin_params params = params_of(perspective);
		params.law = cases[i].law;
		struct fins fins = build_positions(positions, 2, &edge, 1, &params);
		assert_int_equal(fins.count, 4);
		const struct fin_vertex *v = fins.vertices;
		float width = cases[i].width, y = -width * cases[i].middle;
		assert_vertex(&v[0], (float[]){-0.5f, 0, 0.5f}, (float[]){0, 0}, width);
		assert_vertex(&v[1], (float[]){0.5f, 0, 0.5f}, (float[]){0, 0}, width);
		assert_vertex(&v[2], (float[]){0.5f, y, 0.5f}, (float[]){0, y}, width);
		assert_vertex(&v[3], (float[]){-0.5f, y, 0.5f}, (float[]){0, y}, width);
		free(fins.vertices);
	}
}

/* Between its ends too: the outer border of a quad that runs away from the light is the limit at
 * every depth that it passes. */
static void the_limit_is_straight_along_an_edge(void **state)
{
	(void)state;
	const float positions[2][3] = {{-1, 0, -1}, {3, 0, -3}};
	const struct silhouette_edge edge = {0, 1};
	struct fin_params params = params_of(perspective);
	params.law = fin_law_perspective(0.1f, 1, 3);
	struct fins fins = build_positions(positions, 2, &edge, 1, &params);
	assert_int_equal(fins.count, 4);
	const struct fin_vertex *v = fins.vertices;
	for (float t = 0.0f; t <= 1.0f; t += 0.0625f) {
		float offset = (1.0f - t) * v[3].offset[1] + t * v[2].offset[1];
		float width = (1.0f - t) * v[0].width + t * v[1].width;
		float b = 0.1f / width; /* the law: width = scale / w */
		assert_true(fabsf(-offset - width * drawn_at(b)) <= CLOSE);
	}
	free(fins.vertices);
}

static float alpha_error(const struct fins *fins, const float (*seen)[3],
	const struct silhouette_edge *edges, size_t edge_count, float width, float drawn)
{
	float error = 0.0f;
	uint64_t random = 37;
	for (int i = 0; i < 3000; i++) {
		float p[2] = {0.6f * random_signed(&random), 0.6f * random_signed(&random)};
		bool inside = true;
		for (size_t e = 0; e < edge_count; e++)
			inside = inside && side(seen[edges[e].a], seen[edges[e].b], p) > 0.0f;
		float expected = distance_at(seen, edges, edge_count, width, p);
		if (!inside && expected < drawn)
			error = fmaxf(error, fabsf(alpha_at(fins, p) - expected));
		/* Corners reach farther out than fins, by sqrt(2) at most. */
		if (!inside && expected > 1.4143f * drawn && alpha_at(fins, p) < 1.0f)
			error = 1.0f;
	}
	return error;
}

/* Of the full width, however much of it is drawn; and nothing is drawn beyond. */
static void alpha_stays_a_share_of_the_width(void **state)
{
	(void)state;
	const struct silhouette_edge edges[] = {{0, 1}, {1, 2}, {2, 0}};
	const float distances[] = {1.0f, 1.5f, 2.0f, 2.7f};
	for (size_t i = 0; i < sizeof(distances) / sizeof(distances[0]); i++) {
		float w = distances[i];
		const float seen[3][3] = {{-0.3f, -0.3f, 0}, {0.3f, -0.2f, 0}, {0, 0.3f, 0}};
		float positions[3][3];
		for (int v = 0; v < 3; v++)
			memcpy(positions[v], (float[]){w * seen[v][0], w * seen[v][1], -w},
				sizeof(positions[v]));
		struct fin_params params = params_of(perspective);
		params.law = fin_law_perspective(0.2f, 1, 3);
		struct fins fins =
			build_positions((const float(*)[3])positions, 3, edges, 3, &params);
		float error = alpha_error(&fins, seen, edges, 3, 0.2f / w, drawn_at(w));
		assert_true(error < 1e-4f);
		free(fins.vertices);
	}
}

static void fins_nowhere_wider_than_the_finest_are_left_out(void **state)
{
	(void)state;
	/* What is drawn of a width that goes with 1 / w is .2 at the near end and 0 at the far one;
	 * of one that goes with depth .3 and 0; .3 of one that is constant. */
	const float away[2][3] = {{-1, 0, -1}, {3, 0, -3}}, level[2][3] = {{-3, 0, -3}, {3, 0, -3}};
	const struct fin_law perspective_law = fin_law_perspective(0.3f, 1, 3);
	const struct fin_law parallel = fin_law_parallel(0.3f), constant = fin_law_constant(0.3f);
	const struct {
		const float (*positions)[3];
		struct fin_law law;
		float finest;
		size_t quads;
	} cases[] = {
		{away, perspective_law, 0.0f, 1},
		{away, perspective_law, 0.19f, 1},
		{away, perspective_law, 0.21f, 0},
		{away, parallel, 0.29f, 1},
		{away, parallel, 0.31f, 0},
		{level, perspective_law, 0.0f, 0},
		{level, constant, 0.29f, 1},
		{level, constant, 0.31f, 0},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		for (uint32_t from = 0; from < 2; from++) {
			const struct silhouette_edge edge = {from, 1 - from};
			struct fin_params params = params_of(perspective);
			params.law = cases[i].law;
			params.finest = cases[i].finest;
			struct fins fins =
				build_positions(cases[i].positions, 2, &edge, 1, &params);
			assert_int_equal(fins.count, 4 * cases[i].quads);
			assert_int_equal(fins.left_out_count, 1 - cases[i].quads);
			free(fins.vertices);
		}
	}
}

/* A gap between two fins of width .1 at a corner where the blocker turns by an angle is .2 times
 * the sine of half of it wide. */
static void gaps_nowhere_wider_than_the_finest_stay_open(void **state)
{
	(void)state;
	const float finest[] = {0.0f, 0.01f, 0.05f, 0.09f};
	for (int degrees = 1; degrees < 180; degrees += 7) {
		float turn = (float)degrees * 0.017453293f, gap = 0.2f * sinf(turn / 2.0f);
		const float positions[3][3] = {
			{-0.5f, 0, 0}, {0, 0, 0}, {0.5f * cosf(turn), 0.5f * sinf(turn), 0}};
		const struct silhouette_edge edges[] = {{0, 1}, {1, 2}};
		for (size_t i = 0; i < sizeof(finest) / sizeof(finest[0]); i++) {
			struct fin_params params = params_of(identity);
			params.finest = finest[i];
			struct fins fins = build_positions(positions, 3, edges, 2, &params);
			assert_int_equal(fins.count, gap > finest[i] ? 12 : 8);
			free(fins.vertices);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(fins_are_drawn_as_far_out_as_any_receiver_asks),
		cmocka_unit_test(the_limit_is_straight_along_an_edge),
		cmocka_unit_test(alpha_stays_a_share_of_the_width),
		cmocka_unit_test(fins_nowhere_wider_than_the_finest_are_left_out),
		cmocka_unit_test(gaps_nowhere_wider_than_the_finest_stay_open),
	};
	return cmocka_run_group_tests_name("fin_limits", tests, NULL, NULL);
}
