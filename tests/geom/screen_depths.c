/* SPDX-License-Identifier: MIT */
#include "geom/screen_depths.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIZE SCREEN_DEPTHS_SIZE
#define SHAPES 60
#define ROUNDS 40

static const uint8_t quad_edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};

struct shape {
	struct screen_point corners[4];
	float depth;
};

static struct shape random_shape(uint64_t *random)
{
	struct shape shape = {.depth = fabsf(random_signed(random))};
	float x = random_signed(random), y = random_signed(random);
	float u[2], v[2];
	for (int axis = 0; axis < 2; axis++) {
		u[axis] = 0.1f * random_signed(random);
		v[axis] = 0.01f * random_signed(random);
	}
	for (int i = 0; i < 4; i++) {
		float along = i == 1 || i == 2 ? 1.0f : 0.0f, across = i >= 2 ? 1.0f : 0.0f;
		shape.corners[i] = (struct screen_point){
			x + along * u[0] + across * v[0], y + along * u[1] + across * v[1]};
	}
	return shape;
}

static void add(struct screen_depths *depths, const struct shape *shape, float slack)
{
	screen_depths_add(depths, shape->corners, quad_edges, 4, slack, shape->depth);
}

/* A point of the shape. */
static void random_inside(uint64_t *random, const struct shape *shape, float p[2])
{
	const struct screen_point *c = shape->corners;
	float s = fabsf(random_signed(random)), t = fabsf(random_signed(random));
	p[0] = c[0].x + s * (c[1].x - c[0].x) + t * (c[3].x - c[0].x);
	p[1] = c[0].y + s * (c[1].y - c[0].y) + t * (c[3].y - c[0].y);
}

static bool is_on_screen(const float p[2])
{
	return fabsf(p[0]) < 1.0f && fabsf(p[1]) < 1.0f;
}

/* What is behind a shape is told so, and what is in front of all shapes there is not. */
static void shapes_are_found(void **state)
{
	static struct screen_depths depths;
	const struct screen_box all = screen_box_all();
	uint64_t random = 23;
	(void)state;
	for (int round = 0; round < ROUNDS; round++) {
		struct shape shapes[SHAPES];
		float least = INFINITY;
		screen_depths_clear(&depths, &all);
		for (int i = 0; i < SHAPES; i++) {
			shapes[i] = random_shape(&random);
			add(&depths, &shapes[i], 0.5f);
			least = fminf(least, shapes[i].depth);
		}
		for (int i = 0; i < 20 * SHAPES; i++) {
			const struct shape *shape = &shapes[i % SHAPES];
			float p[2];
			random_inside(&random, shape, p);
			if (!is_on_screen(p))
				continue;
			assert_true(screen_depths_before(&depths, p, p, shape->depth + 1e-3f));
			assert_false(screen_depths_before(&depths, p, p, least));
		}
	}
}

/* Where nothing has been added there is nothing, at whatever depth. */
static void the_rest_is_empty(void **state)
{
	static struct screen_depths depths;
	const struct screen_box all = screen_box_all();
	const struct shape shape = {
		{{-0.5f, -0.5f}, {0.0f, -0.5f}, {0.0f, 0.0f}, {-0.5f, 0.0f}}, 0.25f};
	(void)state;
	screen_depths_clear(&depths, &all);
	const float low[2] = {0.1f, 0.1f}, high[2] = {1.0f, 1.0f}, edge[2] = {-0.25f, -0.25f};
	assert_false(screen_depths_before(&depths, edge, high, 1.0f));
	add(&depths, &shape, 0.1f);
	assert_false(screen_depths_before(&depths, low, high, 1.0f));
	assert_true(screen_depths_before(&depths, edge, high, 1.0f));
	assert_false(screen_depths_before(&depths, edge, high, 0.25f));
	assert_false(
		screen_depths_before(&depths, (const float[2]){2, 2}, (const float[2]){3, 3}, 1));
}

/* The nearer of two counts, whichever came first. */
static void the_least_is_kept(void **state)
{
	static struct screen_depths depths;
	const struct screen_box all = screen_box_all();
	struct shape shape = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.5f};
	const float middle[2] = {0, 0};
	(void)state;
	screen_depths_clear(&depths, &all);
	add(&depths, &shape, 0);
	shape.depth = 0.25f;
	add(&depths, &shape, 0);
	shape.depth = 0.75f;
	add(&depths, &shape, 0);
	assert_true(screen_depths_before(&depths, middle, middle, 0.3f));
	assert_false(screen_depths_before(&depths, middle, middle, 0.2f));
}

/* A part that is cleared is empty, and what is beside it stays. */
static void a_part_is_cleared(void **state)
{
	static struct screen_depths depths;
	const struct screen_box all = screen_box_all(), part = {{-0.5f, -0.5f}, {0.5f, 0.25f}};
	const struct shape shape = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.5f};
	(void)state;
	screen_depths_clear(&depths, &all);
	add(&depths, &shape, 0);
	screen_depths_clear(&depths, &part);
	assert_false(screen_depths_before(&depths, part.min, part.max, 1.0f));
	for (int i = 0; i < SIZE; i++) {
		float at = 2.0f * ((float)i + 0.5f) / SIZE - 1.0f;
		const float above[2] = {at, 0.3f}, below[2] = {at, -0.6f};
		const float left[2] = {-0.6f, at}, right[2] = {0.6f, at};
		assert_true(screen_depths_before(&depths, above, above, 1.0f));
		assert_true(screen_depths_before(&depths, below, below, 1.0f));
		assert_true(screen_depths_before(&depths, left, left, 1.0f));
		assert_true(screen_depths_before(&depths, right, right, 1.0f));
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(shapes_are_found),
		cmocka_unit_test(the_rest_is_empty),
		cmocka_unit_test(the_least_is_kept),
		cmocka_unit_test(a_part_is_cleared),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
