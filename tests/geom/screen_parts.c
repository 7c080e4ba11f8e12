/* SPDX-License-Identifier: MIT */
#include "geom/screen_parts.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define SIZE SCREEN_GRID_SIZE

/* How many parts the grid has; each pixel is in as many as its cell says. */
static size_t check_parts(const struct screen_grid *grid, uint32_t width, uint32_t height)
{
	uint8_t *found = calloc((size_t)width * height, 1);
	struct screen_part part = {0};
	size_t count = 0;
	assert_non_null(found);
	for (; screen_part_next(&part, grid, width, height); count++) {
		const struct pixel_box *box = &part.box;
		assert_true(box->left >= 0 && box->right <= (int)width);
		assert_true(box->bottom >= 0 && box->top <= (int)height);
		for (int y = box->bottom; y < box->top; y++)
			for (int x = box->left; x < box->right; x++)
				found[(size_t)y * width + (size_t)x]++;
	}
	for (uint32_t y = 0; y < height; y++)
		for (uint32_t x = 0; x < width; x++) {
			int column = (int)((x + 0.5) * SIZE / width);
			int row = (int)((y + 0.5) * SIZE / height);
			assert_int_equal(
				found[(size_t)y * width + x], screen_grid_has(grid, column, row));
		}
	free(found);
	return count;
}

static void pixels_are_in_one_part_or_in_none(void **state)
{
	(void)state;
	static const uint32_t sizes[][2] = {
		{1, 1}, {2, 63}, {64, 64}, {65, 7}, {389, 278}, {1000, 600}, {1024, 1}};
	uint64_t random = 43;
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		struct screen_grid grid;
		screen_grid_clear(&grid);
		assert_int_equal(check_parts(&grid, sizes[i][0], sizes[i][1]), 0);
		for (int row = 0; row < SIZE; row++) {
			random = random * 6364136223846793005u + 1442695040888963407u;
			grid.rows[row] = random ^ random >> 32;
		}
		assert_in_range(check_parts(&grid, sizes[i][0], sizes[i][1]), SIZE, SIZE * SIZE);
		screen_grid_fill(&grid);
		assert_int_equal(check_parts(&grid, sizes[i][0], sizes[i][1]), 1);
	}
}

static void alike_rows_go_together(void **state)
{
	(void)state;
	static const struct {
		uint64_t rows[4]; /* of the whole, 16 times each */
		size_t parts;
	} cases[] = {
		{{0, 1, 1, 0}, 1},
		{{0, 5, 5, 0}, 2},
		{{1, 2, 1, 2}, 4},
		{{(uint64_t)1 << 63 | 1, 0, 0, ~(uint64_t)0}, 3},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct screen_grid grid;
		for (int row = 0; row < SIZE; row++)
			grid.rows[row] = cases[i].rows[row / 16];
		assert_int_equal(check_parts(&grid, 200, 100), cases[i].parts);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(pixels_are_in_one_part_or_in_none),
		cmocka_unit_test(alike_rows_go_together),
	};
	return cmocka_run_group_tests_name("screen_parts", tests, NULL, NULL);
}
