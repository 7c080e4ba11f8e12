/* SPDX-License-Identifier: MIT */
#include "geom/screen_cover.h"
#include "geom/screen_depths.h"
#include "models.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SHAPES 12
#define RECTANGLES 400
#define ROUNDS 60

_Static_assert(SCREEN_COVER_SIZE == SCREEN_DEPTHS_SIZE, "the same cells");

static const uint8_t quad_edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};

static void random_range(uint64_t *random, float size, float *low, float *high)
{
	float middle = 1.2f * random_signed(random), half = size * random_signed(random);
	*low = middle - (half < 0.0f ? -half : half);
	*high = middle + (half < 0.0f ? -half : half);
}

static void random_shape(uint64_t *random, struct screen_point corners[4])
{
	float min[2], max[2];
	random_range(random, 0.3f, &min[0], &max[0]);
	random_range(random, 0.3f, &min[1], &max[1]);
	float middle[2] = {0.5f * (min[0] + max[0]), 0.5f * (min[1] + max[1])};
	corners[0] = (struct screen_point){min[0], middle[1]};
	corners[1] = (struct screen_point){middle[0], min[1]};
	corners[2] = (struct screen_point){max[0], middle[1]};
	corners[3] = (struct screen_point){middle[0], max[1]};
}

/* The same cells as depths have, which are held against points of the shapes. */
static void cells_are_those_of_depths(void **state)
{
	static struct screen_cover cover;
	static struct screen_depths depths;
	const struct screen_box all = screen_box_all();
	uint64_t random = 31;
	int touched = 0;
	(void)state;
	for (int round = 0; round < ROUNDS; round++) {
		screen_cover_clear(&cover);
		screen_depths_clear(&depths, &all);
		for (int i = 0; i < SHAPES; i++) {
			struct screen_point corners[4];
			random_shape(&random, corners);
			screen_cover_add(&cover, corners, quad_edges, 4, 0.5f);
			screen_depths_add(&depths, corners, quad_edges, 4, 0.5f, 0.5f);
		}
		for (int i = 0; i < RECTANGLES; i++) {
			float min[2], max[2];
			random_range(&random, i % 2 ? 0.5f : 0.01f, &min[0], &max[0]);
			random_range(&random, i % 2 ? 0.02f : 0.01f, &min[1], &max[1]);
			bool touches = screen_cover_touches(&cover, min, max);
			assert_int_equal(touches, screen_depths_before(&depths, min, max, 1.0f));
			touched += touches;
		}
	}
	assert_in_range(touched, ROUNDS * RECTANGLES / 10, ROUNDS * RECTANGLES * 9 / 10);
}

/* A rectangle is the shape that has its corners. */
static void rectangles_are_shapes(void **state)
{
	static struct screen_cover cover, same;
	uint64_t random = 37;
	(void)state;
	screen_cover_clear(&cover);
	screen_cover_clear(&same);
	for (int i = 0; i < 4 * SHAPES; i++) {
		float min[2], max[2];
		random_range(&random, 0.05f, &min[0], &max[0]);
		random_range(&random, 0.05f, &min[1], &max[1]);
		const struct screen_point corners[4] = {
			{min[0], min[1]}, {max[0], min[1]}, {max[0], max[1]}, {min[0], max[1]}};
		screen_cover_add_rectangle(&cover, min, max);
		screen_cover_add(&same, corners, quad_edges, 4, 0.0f);
		assert_memory_equal(&cover, &same, sizeof(cover));
	}
}

/* All of the screen, and nothing beside it. */
static void a_full_one_is_touched_everywhere(void **state)
{
	static struct screen_cover cover;
	const float low[2] = {-1, -1}, high[2] = {0.999f, 0.999f}, far[2] = {2, 2};
	(void)state;
	screen_cover_clear(&cover);
	assert_false(screen_cover_touches(&cover, low, high));
	screen_cover_fill(&cover);
	assert_true(screen_cover_touches(&cover, low, low));
	assert_true(screen_cover_touches(&cover, high, high));
	assert_false(screen_cover_touches(&cover, far, far));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(cells_are_those_of_depths),
		cmocka_unit_test(rectangles_are_shapes),
		cmocka_unit_test(a_full_one_is_touched_everywhere),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
