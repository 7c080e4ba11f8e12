/* SPDX-License-Identifier: MIT */
#include "geom/screen_grid.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIZE SCREEN_GRID_SIZE
#define ROUNDS 3000

/* In cells: what floats lose of a shape of a few screens, and of one that reaches as far as shapes
 * may before they mark everything (10^4 cells, where floats step by 10^-3). */
#define ROUNDING 1e-3
#define ROUNDING_FAR 1e-2

struct shape {
	struct screen_point points[8];
	size_t point_count;
	const uint8_t (*edges)[2];
	size_t edge_count;
	float slack;
};

static const uint8_t quad_edges[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
static const uint8_t box_edges[12][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}, {4, 5}, {5, 7}, {7, 6},
	{6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

/* Four points around an ellipse, from a needle to a circle; `far`: how far away it may be. */
static struct shape random_quad(uint64_t *random, float far)
{
	struct shape shape = {.point_count = 4, .edges = quad_edges, .edge_count = 4};
	float x = far * random_signed(random), y = far * random_signed(random);
	float long_axis = far * fabsf(random_signed(random));
	float short_axis = long_axis * powf(10.0f, -3.0f * fabsf(random_signed(random)));
	float tilt = 3.14159265f * random_signed(random);
	for (int i = 0; i < 4; i++) {
		float angle = 1.5707963f * ((float)i + 0.9f * fabsf(random_signed(random)));
		float u = long_axis * cosf(angle), v = short_axis * sinf(angle);
		shape.points[i] = (struct screen_point){
			x + u * cosf(tilt) - v * sinf(tilt), y + u * sinf(tilt) + v * cosf(tilt)};
	}
	return shape;
}

/* A box under a random perspective. */
static struct shape random_box(uint64_t *random, float far)
{
	struct shape shape = {.point_count = 8, .edges = box_edges, .edge_count = 12};
	float m[3][4];
	for (int row = 0; row < 3; row++)
		for (int column = 0; column < 4; column++)
			m[row][column] = random_signed(random) * (row == 2 ? 0.3f : 0.5f * far);
	m[2][3] = 1.0f; /* w is at least .1 */
	for (int i = 0; i < 8; i++) {
		float clip[3];
		for (int row = 0; row < 3; row++) {
			clip[row] = m[row][3];
			for (int axis = 0; axis < 3; axis++)
				clip[row] += i >> axis & 1 ? m[row][axis] : -m[row][axis];
		}
		shape.points[i] = (struct screen_point){clip[0] / clip[2], clip[1] / clip[2]};
	}
	return shape;
}

/* Of any kind, off by no more than 60 screens, well within what is not far away. */
static struct shape random_shape(uint64_t *random, int round, double *rounding)
{
	bool far = round % 4 == 3;
	float reach = far ? 6.0f : 1.0f;
	struct shape shape = round % 2 ? random_quad(random, reach) : random_box(random, reach);
	shape.slack = 0.02f + fabsf(random_signed(random));
	*rounding = far ? ROUNDING_FAR : ROUNDING;
	return shape;
}

static void add(struct screen_grid *grid, const struct shape *shape)
{
	screen_grid_add(grid, shape->points, shape->edges, shape->edge_count, shape->slack);
}

static double cells_of(double ndc)
{
	return (ndc + 1.0) / 2.0 * SIZE;
}

/* A point of the hull, in cells: anywhere, or on the line between two corners. */
static void random_inside(uint64_t *random, const struct shape *shape, double p[2])
{
	bool between = random_next(random) % 2;
	double sum = 0.0;
	p[0] = p[1] = 0.0;
	for (int left = between ? 2 : (int)shape->point_count; left > 0; left--) {
		size_t i = between ? random_next(random) % shape->point_count : (size_t)left - 1;
		double share = fabs(random_signed(random)) + 1e-9;
		p[0] += share * cells_of(shape->points[i].x);
		p[1] += share * cells_of(shape->points[i].y);
		sum += share;
	}
	p[0] /= sum;
	p[1] /= sum;
}

static void check_covers(uint64_t *random, const struct screen_grid *grid,
	const struct shape *shape, double rounding)
{
	for (int i = 0; i < 300; i++) {
		double p[2];
		random_inside(random, shape, p);
		for (int c = 0; c < 2; c++)
			p[c] = floor(p[c] + (shape->slack - rounding) * random_signed(random));
		if (p[0] < 0 || p[0] >= SIZE || p[1] < 0 || p[1] >= SIZE)
			continue;
		if (!screen_grid_has(grid, (int)p[0], (int)p[1]))
			fail_msg("cell %g, %g is not marked", p[0], p[1]);
	}
}

static void everything_inside_is_marked(void **state)
{
	(void)state;
	uint64_t random = 17;
	for (int round = 0; round < ROUNDS; round++) {
		struct screen_grid grid;
		double rounding;
		struct shape shape = random_shape(&random, round, &rounding);
		screen_grid_clear(&grid);
		add(&grid, &shape);
		check_covers(&random, &grid, &shape, rounding);
	}
}

/* Whether the line through two points has the whole shape on one side, and the whole cell, grown
 * by `more`, on the other. */
static bool separates(const struct shape *shape, const uint8_t edge[2], int x, int row, double more)
{
	const struct screen_point *a = &shape->points[edge[0]], *b = &shape->points[edge[1]];
	double nx = (double)a->y - b->y, ny = (double)b->x - a->x, length = hypot(nx, ny);
	if (length == 0.0)
		return false;
	double least = INFINITY, most = -INFINITY;
	for (size_t i = 0; i < shape->point_count; i++) {
		double d = nx * cells_of(shape->points[i].x) + ny * cells_of(shape->points[i].y);
		least = fmin(least, d);
		most = fmax(most, d);
	}
	double middle = nx * (x + 0.5) + ny * (row + 0.5);
	double reach = (fabs(nx) + fabs(ny)) * (0.5 + more);
	return middle + reach < least || middle - reach > most;
}

static bool is_near(const struct shape *shape, int x, int row, double more)
{
	double min[2] = {INFINITY, INFINITY}, max[2] = {-INFINITY, -INFINITY};
	const double cell[2] = {x, row};
	for (size_t i = 0; i < shape->point_count; i++) {
		const double p[2] = {cells_of(shape->points[i].x), cells_of(shape->points[i].y)};
		for (int c = 0; c < 2; c++) {
			min[c] = fmin(min[c], p[c]);
			max[c] = fmax(max[c], p[c]);
		}
	}
	for (int c = 0; c < 2; c++)
		if (min[c] > cell[c] + 1 + more || max[c] < cell[c] - more)
			return false;
	for (size_t i = 0; i < shape->edge_count; i++)
		if (separates(shape, shape->edges[i], x, row, more))
			return false;
	return true;
}

/* A cell is marked only if, grown by the slack on each side, it meets the hull. */
static void nothing_else_is_marked(void **state)
{
	(void)state;
	uint64_t random = 19;
	size_t marked = 0;
	for (int round = 0; round < ROUNDS / 10; round++) {
		struct screen_grid grid;
		double rounding;
		struct shape shape = random_shape(&random, round, &rounding);
		screen_grid_clear(&grid);
		add(&grid, &shape);
		for (int row = 0; row < SIZE; row++) {
			for (int x = 0; x < SIZE; x++) {
				if (!screen_grid_has(&grid, x, row))
					continue;
				marked++;
				if (!is_near(&shape, x, row, shape.slack + rounding))
					fail_msg("round %d: cell %d, %d is marked", round, x, row);
			}
		}
	}
	assert_true(marked > 1000);
}

static void marks_add_up(void **state)
{
	(void)state;
	uint64_t random = 23;
	struct screen_grid all;
	screen_grid_clear(&all);
	for (int round = 0; round < 20; round++) {
		double rounding;
		struct shape shape = random_shape(&random, round, &rounding);
		struct screen_grid before = all, one;
		screen_grid_clear(&one);
		add(&one, &shape);
		add(&all, &shape);
		for (int row = 0; row < SIZE; row++)
			assert_true(all.rows[row] == (before.rows[row] | one.rows[row]));
	}
}

static bool is_uniform(const struct screen_grid *grid, uint64_t word)
{
	for (int row = 0; row < SIZE; row++)
		if (grid->rows[row] != word)
			return false;
	return true;
}

/* Shapes of known cells: a cell is 1/32 wide. */
static void cells_count_from_the_lower_left(void **state)
{
	(void)state;
	const struct {
		float x0, y0, x1, y1, slack;
		int first, last, first_row, last_row;
	} cases[] = {
		{-0.99f, -0.99f, -0.98f, -0.98f, 0.0f, 0, 0, 0, 0},
		{0.98f, 0.98f, 0.99f, 0.99f, 0.0f, 63, 63, 63, 63},
		{0.98f, -0.99f, 0.99f, -0.98f, 0.0f, 63, 63, 0, 0},
		{0.01f, 0.01f, 0.02f, 0.02f, 0.0f, 32, 32, 32, 32},
		{0.01f, 0.01f, 0.02f, 0.02f, 1.0f, 31, 33, 31, 33},
		{-2.0f, -2.0f, 2.0f, 2.0f, 0.0f, 0, 63, 0, 63},
		{-2.0f, 0.01f, 2.0f, 0.02f, 0.0f, 0, 63, 32, 32},
		{0.01f, -2.0f, 0.02f, 2.0f, 0.0f, 32, 32, 0, 63},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		float x0 = cases[i].x0, y0 = cases[i].y0, x1 = cases[i].x1, y1 = cases[i].y1;
		struct shape shape = {
			.points = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}},
			.edges = quad_edges,
			.edge_count = 4,
			.slack = cases[i].slack,
		};
		struct screen_grid grid;
		screen_grid_clear(&grid);
		add(&grid, &shape);
		for (int row = 0; row < SIZE; row++)
			for (int x = 0; x < SIZE; x++)
				assert_int_equal(screen_grid_has(&grid, x, row),
					x >= cases[i].first && x <= cases[i].last &&
						row >= cases[i].first_row &&
						row <= cases[i].last_row);
	}
}

static void beside_the_screen_nothing_is_marked(void **state)
{
	(void)state;
	const float places[][2] = {{3, 0}, {-3, 0}, {0, 3}, {0, -3}, {300, 300}, {-300, 0}};
	for (size_t i = 0; i < sizeof(places) / sizeof(places[0]); i++) {
		float x = places[i][0], y = places[i][1];
		struct shape shape = {.points = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}},
			.edges = quad_edges,
			.edge_count = 4};
		struct screen_grid grid;
		screen_grid_clear(&grid);
		add(&grid, &shape);
		assert_true(is_uniform(&grid, 0));
	}
}

static void a_point_too_far_marks_everything(void **state)
{
	(void)state;
	const float values[] = {1e3f, -1e3f, 1e30f, INFINITY, -INFINITY, NAN};
	for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++) {
		for (int corner = 0; corner < 8; corner++) {
			struct shape shape = {.points = {{5, 5}, {6, 5}, {6, 6}, {5, 6}},
				.edges = quad_edges,
				.edge_count = 4};
			*(corner % 2 ? &shape.points[corner / 2].x : &shape.points[corner / 2].y) =
				values[i];
			struct screen_grid grid;
			screen_grid_clear(&grid);
			add(&grid, &shape);
			assert_true(is_uniform(&grid, ~(uint64_t)0));
		}
	}
}

static struct screen_grid random_grid(uint64_t *random, uint32_t one_in)
{
	struct screen_grid grid;
	screen_grid_clear(&grid);
	for (int row = 0; row < SIZE; row++)
		for (int x = 0; x < SIZE; x++)
			if (random_next(random) % one_in == 0)
				grid.rows[row] |= (uint64_t)1 << x;
	return grid;
}

/* Cell by cell. */
static bool touches(const struct screen_grid *grid, const float min[2], const float max[2])
{
	for (int row = 0; row < SIZE; row++)
		for (int x = 0; x < SIZE; x++)
			if (screen_grid_has(grid, x, row) && cells_of(min[0]) < x + 1 &&
				cells_of(max[0]) >= x && cells_of(min[1]) < row + 1 &&
				cells_of(max[1]) >= row)
				return true;
	return false;
}

static void rectangles_touch_marked_cells(void **state)
{
	(void)state;
	uint64_t random = 29;
	size_t found = 0;
	for (int round = 0; round < ROUNDS; round++) {
		struct screen_grid grid = random_grid(&random, round % 2 ? 20 : 1000);
		float min[2], max[2];
		for (int c = 0; c < 2; c++) {
			min[c] = 1.3f * random_signed(&random);
			max[c] = min[c] + 0.4f * fabsf(random_signed(&random));
		}
		bool expected = touches(&grid, min, max);
		assert_true(screen_grid_touches(&grid, min, max) == expected);
		found += expected;
	}
	assert_true(found > ROUNDS / 5 && found < ROUNDS * 4 / 5);
}

static void rectangles_without_bounds_touch_all(void **state)
{
	(void)state;
	struct screen_grid grid;
	const float wide[2] = {INFINITY, 1e30f}, unknown[2] = {NAN, NAN};
	screen_grid_clear(&grid);
	assert_false(screen_grid_touches(&grid, (float[]){-1e30f, -INFINITY}, wide));
	assert_false(screen_grid_touches(&grid, unknown, unknown));
	grid.rows[5] = (uint64_t)1 << 63;
	assert_true(screen_grid_touches(&grid, (float[]){-1e30f, -INFINITY}, wide));
	assert_true(screen_grid_touches(&grid, unknown, unknown));
}

static void runs_end_where_cells_change(void **state)
{
	(void)state;
	uint64_t random = 31;
	for (uint32_t one_in = 1; one_in <= 64; one_in *= 2) {
		struct screen_grid grid = random_grid(&random, one_in);
		for (int row = 0; row < SIZE; row++) {
			for (int x = 0; x < SIZE; x++) {
				int end = screen_grid_run_end(&grid, x, row);
				bool marked = screen_grid_has(&grid, x, row);
				assert_true(end > x && end <= SIZE);
				for (int i = x; i < end; i++)
					assert_true(screen_grid_has(&grid, i, row) == marked);
				if (end < SIZE)
					assert_true(screen_grid_has(&grid, end, row) != marked);
			}
		}
	}
}

static bool is_around(const struct screen_grid *grid, int x, int row)
{
	for (int j = row - 1; j <= row + 1; j++)
		for (int i = x - 1; i <= x + 1; i++)
			if (i >= 0 && i < SIZE && j >= 0 && j < SIZE && screen_grid_has(grid, i, j))
				return true;
	return false;
}

static void cells_around_are_marked(void **state)
{
	(void)state;
	uint64_t random = 37;
	for (uint32_t one_in = 1; one_in <= 4096; one_in *= 4) {
		struct screen_grid grid = random_grid(&random, one_in), wide = grid;
		screen_grid_widen(&wide);
		for (int row = 0; row < SIZE; row++)
			for (int x = 0; x < SIZE; x++)
				assert_true(
					screen_grid_has(&wide, x, row) == is_around(&grid, x, row));
	}
}

static void what_both_have_is_left(void **state)
{
	(void)state;
	uint64_t random = 41;
	struct screen_grid a = random_grid(&random, 2), b = random_grid(&random, 3), both = a;
	screen_grid_cut(&both, &b);
	for (int row = 0; row < SIZE; row++)
		assert_true(both.rows[row] == (a.rows[row] & b.rows[row]));
	assert_in_range(screen_grid_count(&both), SIZE * SIZE / 9, SIZE * SIZE / 4);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(everything_inside_is_marked),
		cmocka_unit_test(nothing_else_is_marked),
		cmocka_unit_test(marks_add_up),
		cmocka_unit_test(cells_count_from_the_lower_left),
		cmocka_unit_test(beside_the_screen_nothing_is_marked),
		cmocka_unit_test(a_point_too_far_marks_everything),
		cmocka_unit_test(rectangles_touch_marked_cells),
		cmocka_unit_test(rectangles_without_bounds_touch_all),
		cmocka_unit_test(runs_end_where_cells_change),
		cmocka_unit_test(cells_around_are_marked),
		cmocka_unit_test(what_both_have_is_left),
	};
	return cmocka_run_group_tests_name("screen_grid", tests, NULL, NULL);
}
