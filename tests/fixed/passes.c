/* SPDX-License-Identifier: MIT */
/* The exact passes where what they must draw is known: under a lamp that is the camera as well. */
#include "fixed/passes.h"
#include "fixed/setup.h"
#include "fixed/span.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define SIZE 64
#define POLE 1.25
#define BLOCKER 0.25
#define RECEIVER 0.75

static const struct number_model *const numbers[] = {&number_fixed12, &number_half};

/* Twice the rounding of the numbers around 1. */
static double tolerance(const struct number_model *number)
{
	return number == &number_half ? 2.0 / 1024 : 4.0 / 1024;
}

static const struct fixed_screen map = {SIZE, SIZE, 1};
static const struct fixed_screen picture = {SIZE, SIZE, 0};

static struct fixed_scene scene_of_nothing(void)
{
	return (struct fixed_scene){
		.map_size = SIZE,
		.width = SIZE,
		.height = SIZE,
		.pole = (uint32_t)(POLE * (1 << FIXED_DEPTH_BITS)),
	};
}

/* A rectangle of NDC at a window depth, as two triangles in clip space. */
static void make_rectangle(const double ndc[4], double depth, double triangles[2][3][4])
{
	static const int corners[2][3][2] = {{{0, 1}, {2, 1}, {2, 3}}, {{0, 1}, {2, 3}, {0, 3}}};
	for (int t = 0; t < 2; t++)
		for (int i = 0; i < 3; i++) {
			triangles[t][i][0] = ndc[corners[t][i][0]];
			triangles[t][i][1] = ndc[corners[t][i][1]];
			triangles[t][i][2] = 2 * depth - 1;
			triangles[t][i][3] = 1;
		}
}

static void add_blocker(struct fixed_blockers *blockers, const double ndc[4], double depth)
{
	double triangles[2][3][4];
	make_rectangle(ndc, depth, triangles);
	for (int t = 0; t < 2; t++)
		assert_true(fixed_add_blocker(blockers, &map, triangles[t], FIXED_BOTH_SIDES));
}

static void add_receiver(struct fixed_scene *scene, double depth, bool receives)
{
	static const double everywhere[4] = {-1, -1, 1, 1};
	const struct fixed_bias bias = {1.05 / SIZE, {50, 0}};
	double triangles[2][3][4];
	make_rectangle(everywhere, depth, triangles);
	for (int t = 0; t < 2; t++) {
		struct fixed_surface surface = {.receives = receives};
		for (int i = 0; i < 3; i++)
			for (int c = 0; c < 4; c++)
				surface.clip[i][c] = surface.light[i][c] = triangles[t][i][c];
		assert_true(fixed_add_receiver(&scene->receivers, &picture, &surface, &bias));
	}
}

/* Of an edge at x = 0 whose blocker is to the left, from bottom to top. */
static void add_fin(struct fixed_scene *scene, float width)
{
	const float z = (float)(2 * BLOCKER - 1);
	const struct fixed_fin_corner corners[4] = {
		{{0, -1, z}, {0, 0}, width},
		{{0, 1, z}, {0, 0}, width},
		{{width, 1, z}, {width, 0}, width},
		{{width, -1, z}, {width, 0}, width},
	};
	assert_true(fixed_add_fin(&scene->fins, &map, corners));
}

static double seen_at(const uint16_t *values, int x, int y)
{
	return values[y * SIZE + x] / 65535.0;
}

static void draw(
	const struct fixed_scene *scene, const struct number_model *number, uint16_t *values)
{
	for (int i = 0; i < SIZE * SIZE; i++)
		values[i] = 12345;
	assert_true(fixed_draw(scene, number, values));
}

static void nothing_is_lit(void **state)
{
	(void)state;
	for (size_t n = 0; n < 2; n++) {
		struct fixed_scene scene = scene_of_nothing();
		uint16_t values[SIZE * SIZE];
		draw(&scene, numbers[n], values);
		for (int i = 0; i < SIZE * SIZE; i++)
			assert_int_equal(values[i], 65535);
		fixed_scene_finish(&scene);
	}
}

/* Pixels are texels here: no blending. */
static void half_a_plane_darkens_half_the_picture(void **state)
{
	(void)state;
	static const double left[4] = {-1, -1, 0, 1};
	for (size_t n = 0; n < 2; n++) {
		struct fixed_scene scene = scene_of_nothing();
		uint16_t values[SIZE * SIZE];
		add_blocker(&scene.casters, left, BLOCKER);
		add_receiver(&scene, RECEIVER, true);
		draw(&scene, numbers[n], values);
		for (int y = 0; y < SIZE; y++)
			for (int x = 0; x < SIZE; x++) {
				/* The border stays clear. */
				bool dark = x >= 1 && x < SIZE / 2 && y >= 1 && y < SIZE - 1;
				assert_int_equal(values[y * SIZE + x], dark ? 0 : 65535);
			}
		fixed_scene_finish(&scene);
	}
}

static void what_does_not_receive_or_is_in_front_is_lit(void **state)
{
	(void)state;
	static const double everywhere[4] = {-1, -1, 1, 1};
	struct fixed_scene scene = scene_of_nothing();
	uint16_t values[SIZE * SIZE];
	add_blocker(&scene.casters, everywhere, BLOCKER);
	add_receiver(&scene, RECEIVER, true);
	draw(&scene, &number_half, values);
	assert_int_equal(values[SIZE * SIZE / 2 + SIZE / 2], 0);
	/* Nearer to lamp and camera. */
	add_receiver(&scene, RECEIVER - 0.1, false);
	draw(&scene, &number_half, values);
	assert_int_equal(values[SIZE * SIZE / 2 + SIZE / 2], 65535);
	fixed_scene_finish(&scene);
	scene = scene_of_nothing();
	add_blocker(&scene.casters, everywhere, RECEIVER);
	add_receiver(&scene, RECEIVER, true);
	draw(&scene, &number_half, values);
	assert_int_equal(values[SIZE * SIZE / 2 + SIZE / 2], 65535);
	fixed_scene_finish(&scene);
}

/* alpha' = alpha (K - b) / (r - b), up to 1. */
static double penumbra(double x, double width, bool sinusoid)
{
	double share = (RECEIVER - BLOCKER) / (POLE - BLOCKER);
	double alpha = fmin(x / width / share, 1);
	return sinusoid ? 0.5 - 0.5 * cos(3.14159265358979 * alpha) : alpha;
}

static void a_fin_is_a_penumbra(void **state)
{
	(void)state;
	const float width = 0.9f;
	for (size_t n = 0; n < 4; n++) {
		struct fixed_scene scene = scene_of_nothing();
		uint16_t values[SIZE * SIZE];
		const struct number_model *number = numbers[n % 2];
		scene.sinusoid = n / 2;
		static const double everywhere[4] = {-1, -1, 1, 1};
		add_blocker(&scene.receivers_only, everywhere, RECEIVER);
		add_fin(&scene, width);
		add_receiver(&scene, RECEIVER, true);
		draw(&scene, number, values);
		for (int y = 1; y < SIZE - 1; y++)
			for (int x = 0; x < SIZE - 1; x++) {
				double ndc = (x + 0.5) * 2 / SIZE - 1;
				double expected =
					ndc < 0 ? 1 : penumbra(ndc, (double)width, scene.sinusoid);
				double found = seen_at(values, x, y);
				/* The slope of the sinusoid is pi / 2 at most. */
				assert_true(fabs(found - expected) <= 2 * tolerance(number));
			}
		fixed_scene_finish(&scene);
	}
}

/* Bilinear weights, on a picture of half the map's screen. */
static void texels_are_blended(void **state)
{
	(void)state;
	static const double left[4] = {-1, -1, 0, 1};
	const struct fixed_bias bias = {0};
	for (size_t n = 0; n < 2; n++) {
		struct fixed_scene scene = scene_of_nothing();
		uint16_t values[SIZE * SIZE];
		add_blocker(&scene.casters, left, BLOCKER);
		static const double everywhere[4] = {-1, -1, 1, 1};
		double triangles[2][3][4];
		make_rectangle(everywhere, RECEIVER, triangles);
		for (int t = 0; t < 2; t++) {
			struct fixed_surface surface = {.receives = true};
			for (int i = 0; i < 3; i++)
				for (int c = 0; c < 4; c++) {
					double scale = c < 2 ? 1.0 / 16 : 1;
					surface.clip[i][c] = triangles[t][i][c];
					surface.light[i][c] = triangles[t][i][c] * scale;
				}
			assert_true(
				fixed_add_receiver(&scene.receivers, &picture, &surface, &bias));
		}
		draw(&scene, numbers[n], values);
		for (int x = 0; x < SIZE; x++) {
			/* Texels from the edge, x = 0, between the centres beside it. */
			double texels = ((x + 0.5) * 2 / SIZE - 1) / 16 * SIZE / 2;
			double expected = fmin(fmax(texels + 0.5, 0), 1);
			assert_true(fabs(seen_at(values, x, SIZE / 2) - expected) <=
				    tolerance(numbers[n]));
		}
		fixed_scene_finish(&scene);
	}
}

/* So that the table does not depend on how the cosine is rounded. */
static void no_entry_of_the_falloff_is_near_a_tie(void **state)
{
	(void)state;
	for (size_t n = 0; n < 2; n++) {
		uint16_t table[FIXED_FALLOFF_SIZE];
		fixed_falloff_init(numbers[n], table);
		assert_int_equal(table[0], 0);
		assert_int_equal(table[FIXED_FALLOFF_SIZE - 1], numbers[n]->one);
		for (int i = 0; i < FIXED_FALLOFF_SIZE; i++) {
			double value = 0.5 - 0.5 * cos(3.14159265358979323846 * i / 1024);
			/* Ends are exact, and have nothing beyond them. */
			double around = i == 0 || i == 1024 ? 0 : 1e-13;
			assert_int_equal(table[i], numbers[n]->from_real(value - around));
			assert_int_equal(table[i], numbers[n]->from_real(value + around));
			if (i > 0)
				assert_true(table[i] >= table[i - 1]);
		}
	}
}

/* In order, and far away as near. */
static void camera_depths_are_ordered(void **state)
{
	(void)state;
	const int32_t one = 1 << 30;
	uint32_t before = fixed_camera_depth_of(-5);
	assert_int_equal(before, fixed_camera_depth_of(0));
	for (int32_t left = one; left > 0; left -= left / 100000 + 1) {
		uint32_t depth = fixed_camera_depth_of(one - left);
		assert_true(depth >= before && depth < FIXED_DEPTH_CLEAR);
		uint32_t farther = fixed_camera_depth_of(one - left + left / 100000 + 1);
		assert_true(farther > depth || left <= 1);
		before = depth;
	}
	assert_int_equal(fixed_camera_depth_of(INT32_MAX), FIXED_DEPTH_CLEAR - 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nothing_is_lit),
		cmocka_unit_test(half_a_plane_darkens_half_the_picture),
		cmocka_unit_test(what_does_not_receive_or_is_in_front_is_lit),
		cmocka_unit_test(a_fin_is_a_penumbra),
		cmocka_unit_test(texels_are_blended),
		cmocka_unit_test(no_entry_of_the_falloff_is_near_a_tie),
		cmocka_unit_test(camera_depths_are_ordered),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
