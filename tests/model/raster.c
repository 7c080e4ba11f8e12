/* SPDX-License-Identifier: MIT */
/* Which pixels a triangle covers, and with which values. */
#include "model/raster.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIZE = 32 };

static const struct raster_area whole = {.width = SIZE, .height = SIZE, .max = {SIZE, SIZE}};

/* How often each pixel was covered. */
struct coverage {
	int count[SIZE][SIZE];
	int total;
};

static void count_pixel(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth)
{
	struct coverage *coverage = data;
	(void)triangle;
	assert_true(x >= 0 && x < SIZE && y >= 0 && y < SIZE);
	assert_true(depth >= 0.0 && depth <= 1.0);
	coverage->count[y][x]++;
	coverage->total++;
}

/* A corner at a place of the screen, in pixels, with w. */
static void place(double corner[4], double x, double y, double z, double w)
{
	corner[0] = (x / SIZE * 2.0 - 1.0) * w;
	corner[1] = (y / SIZE * 2.0 - 1.0) * w;
	corner[2] = z * w;
	corner[3] = w;
}

static void cover(
	struct coverage *coverage, const struct raster_area *area, const double points[3][2])
{
	double corners[3][4];
	for (int i = 0; i < 3; i++)
		place(corners[i], points[i][0], points[i][1], 0.0, 1.0);
	raster_draw(area, (const double(*)[4])corners, count_pixel, coverage);
}

static void test_left_and_upper_edges_are_inside(void **state)
{
	(void)state;
	/* Edges through the middles of pixels 4 and 8, either way around. */
	static const double halves[4][3][2] = {
		{{4.5, 4.5}, {8.5, 4.5}, {8.5, 8.5}},
		{{4.5, 4.5}, {8.5, 8.5}, {4.5, 8.5}},
		{{8.5, 8.5}, {8.5, 4.5}, {4.5, 4.5}},
		{{4.5, 8.5}, {8.5, 8.5}, {4.5, 4.5}},
	};
	for (int pair = 0; pair < 2; pair++) {
		struct coverage coverage = {.total = 0};
		cover(&coverage, &whole, halves[2 * pair]);
		cover(&coverage, &whole, halves[2 * pair + 1]);
		for (int y = 0; y < SIZE; y++)
			for (int x = 0; x < SIZE; x++)
				assert_int_equal(
					coverage.count[y][x], x >= 4 && x < 8 && y > 4 && y <= 8);
	}
}

static double random_between(double from, double to)
{
	return from + (to - from) * rand() / RAND_MAX;
}

/* Cut up in random ways, also by lines through pixels' middles, the screen is covered once. */
static void test_triangles_that_share_edges_cover_once(void **state)
{
	(void)state;
	srand(1);
	for (int round = 0; round < 200; round++) {
		static const double rim[5][2] = {
			{-3, -3}, {SIZE + 3, -3}, {SIZE + 3, SIZE + 3}, {-3, SIZE + 3}, {-3, -3}};
		struct coverage coverage = {.total = 0};
		double inside[2];
		for (int axis = 0; axis < 2; axis++) {
			inside[axis] = random_between(0, SIZE);
			if (round % 2 == 0)
				inside[axis] = floor(inside[axis]) + 0.5;
		}
		for (int i = 0; i < 4; i++) {
			double points[3][2];
			memcpy(points[0], inside, sizeof(inside));
			memcpy(points[1], rim[i], sizeof(inside));
			memcpy(points[2], rim[i + 1], sizeof(inside));
			cover(&coverage, &whole, (const double(*)[2])points);
		}
		for (int y = 0; y < SIZE; y++)
			for (int x = 0; x < SIZE; x++)
				assert_int_equal(coverage.count[y][x], 1);
	}
}

static void test_nothing_beside_the_area_is_drawn(void **state)
{
	(void)state;
	static const double large[3][2] = {{-90, -90}, {200, -90}, {-90, 200}};
	struct raster_area inside = whole;
	struct coverage coverage = {.total = 0};
	inside.min[0] = inside.min[1] = 1;
	inside.max[0] = inside.max[1] = SIZE - 1;
	cover(&coverage, &inside, large);
	assert_int_equal(coverage.total, (SIZE - 2) * (SIZE - 2));
	for (int i = 0; i < SIZE; i++)
		assert_true(coverage.count[0][i] + coverage.count[i][0] == 0);
}

static void test_one_side_alone_is_drawn(void **state)
{
	(void)state;
	static const double front[3][2] = {{2, 2}, {20, 2}, {2, 20}};
	static const double back[3][2] = {{2, 2}, {2, 20}, {20, 2}};
	struct raster_area area = whole;
	struct coverage all = {.total = 0}, fronts = {.total = 0}, backs = {.total = 0};
	cover(&all, &area, front);
	area.kept = RASTER_FRONT;
	cover(&fronts, &area, front);
	cover(&fronts, &area, back);
	area.kept = RASTER_BACK;
	cover(&backs, &area, front);
	cover(&backs, &area, back);
	assert_true(all.total > 100);
	assert_int_equal(fronts.total, all.total);
	assert_int_equal(backs.total, all.total);
}

static void test_slivers_and_points_cover_nothing(void **state)
{
	(void)state;
	static const double line[3][2] = {{2, 2}, {10, 10}, {20, 20}};
	static const double point[3][2] = {{2.5, 2.5}, {2.5, 2.5}, {2.5, 2.5}};
	struct coverage coverage = {.total = 0};
	double corners[3][4];
	cover(&coverage, &whole, line);
	cover(&coverage, &whole, point);
	for (int i = 0; i < 3; i++)
		place(corners[i], 10.0 * i, 5.0 * i * i, 0.0, i == 1 ? NAN : 1.0);
	raster_draw(&whole, (const double(*)[4])corners, count_pixel, &coverage);
	corners[1][3] = INFINITY;
	raster_draw(&whole, (const double(*)[4])corners, count_pixel, &coverage);
	assert_int_equal(coverage.total, 0);
}

/* What a pixel must have of a triangle. */
struct expected {
	const double (*corners)[4];
	int pixels;
};

/* In perspective: sums of the corners by their weights lead back to the pixel. */
static void check_weights(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth)
{
	struct expected *expected = data;
	double weights[3], sum[4] = {0, 0, 0, 0};
	raster_weights(triangle, x, y, weights);
	for (int i = 0; i < 3; i++)
		for (int c = 0; c < 4; c++)
			sum[c] += weights[i] * expected->corners[i][c];
	assert_float_equal(weights[0] + weights[1] + weights[2], 1.0, 1e-9);
	assert_float_equal((sum[0] / sum[3] + 1.0) / 2.0 * SIZE, x + 0.5, 1e-6);
	assert_float_equal((sum[1] / sum[3] + 1.0) / 2.0 * SIZE, y + 0.5, 1e-6);
	assert_float_equal((sum[2] / sum[3] + 1.0) / 2.0, depth, 1e-9);
	assert_true(sum[2] >= -sum[3] - 1e-3 && sum[2] <= sum[3] + 1e-3);
	expected->pixels++;
}

static void test_values_are_those_of_the_corners(void **state)
{
	(void)state;
	/* The second reaches behind the eye. */
	static const double triangles[][3][4] = {
		{{-1, -1, 0.2, 1}, {3, -1, 1, 4}, {0, 1.5, 1, 2}},
		{{-4, -1, 8, 10}, {4, -1, 8, 10}, {0, -1, -12, -10}},
	};
	for (size_t i = 0; i < sizeof(triangles) / sizeof(triangles[0]); i++) {
		struct expected expected = {.corners = triangles[i]};
		raster_draw(&whole, triangles[i], check_weights, &expected);
		assert_true(expected.pixels > 100);
	}
}

/* A ground that reaches from behind the eye to far away is all below the horizon. */
static void test_what_reaches_behind_the_eye_is_cut(void **state)
{
	(void)state;
	/* x, y = -1, z of the projection with near 1 and far 100 */
	static const double ground[4][2] = {{-500, -50}, {500, -50}, {500, 90}, {-500, 90}};
	double corners[4][4];
	struct coverage coverage = {.total = 0};
	for (int i = 0; i < 4; i++) {
		double w = ground[i][1];
		const double corner[4] = {ground[i][0], -1.0, (101.0 * w - 200.0) / 99.0, w};
		memcpy(corners[i], corner, sizeof(corner));
	}
	for (int half = 0; half < 2; half++) {
		double triangle[3][4];
		memcpy(triangle[0], corners[0], sizeof(corners[0]));
		memcpy(triangle[1], corners[1 + half], 2 * sizeof(corners[0]));
		raster_draw(&whole, (const double(*)[4])triangle, count_pixel, &coverage);
	}
	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++)
			assert_int_equal(coverage.count[y][x], y < SIZE / 2);
}

static void test_a_coarse_grid_moves_corners_and_values(void **state)
{
	(void)state;
	double corners[3][4], moved[3][4];
	struct raster_area area = whole;
	struct expected expected = {.corners = (const double(*)[4])moved};
	static const double points[3][2] = {{2.2, 2.3}, {28.6, 4.1}, {9.9, 27.4}};
	area.snap_bits = 2;
	for (int i = 0; i < 3; i++) {
		place(corners[i], points[i][0], points[i][1], 0.1 * i, 1.0 + i);
		place(moved[i], rint(points[i][0] * 4.0) / 4.0, rint(points[i][1] * 4.0) / 4.0,
			0.1 * i, 1.0 + i);
	}
	raster_draw(&area, (const double(*)[4])corners, check_weights, &expected);
	assert_true(expected.pixels > 100);
	struct expected still = {.corners = (const double(*)[4])corners};
	area.weights_stay = area.depth_stays = true;
	raster_draw(&area, (const double(*)[4])corners, check_weights, &still);
	assert_int_equal(still.pixels, expected.pixels);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_left_and_upper_edges_are_inside),
		cmocka_unit_test(test_triangles_that_share_edges_cover_once),
		cmocka_unit_test(test_nothing_beside_the_area_is_drawn),
		cmocka_unit_test(test_one_side_alone_is_drawn),
		cmocka_unit_test(test_slivers_and_points_cover_nothing),
		cmocka_unit_test(test_values_are_those_of_the_corners),
		cmocka_unit_test(test_what_reaches_behind_the_eye_is_cut),
		cmocka_unit_test(test_a_coarse_grid_moves_corners_and_values),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
