/* SPDX-License-Identifier: MIT */
/* Where the parts of a sheet are, and what of the pictures they show. */
#include "bench/sheet.h"
#include "bench/glyph.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#define WIDTH 400
#define HEIGHT 300
/* As large as parts are at most, and a square as large. */
#define SIDE 144
#define LEFT 200
#define TOP 100

static float truth[WIDTH * HEIGHT], seen[WIDTH * HEIGHT];

/* In light, with a penumbra in that square and a lone pixel of another elsewhere. */
static int set_up(void **state)
{
	(void)state;
	for (size_t y = 0; y < HEIGHT; y++)
		for (size_t x = 0; x < WIDTH; x++) {
			bool inside = x >= LEFT && x < LEFT + SIDE && y >= TOP && y < TOP + SIDE;
			truth[y * WIDTH + x] = inside ? .5f : 1;
			seen[y * WIDTH + x] = 1;
		}
	truth[0] = .5f;
	truth[TOP * WIDTH + LEFT] = NAN;
	return 0;
}

/* Of the picture's rows from the top. */
static const uint8_t *pixel(const struct sheet *sheet, size_t x, size_t y)
{
	const struct picture *picture = &sheet->picture;
	return &picture->rgba[4 * ((picture->height - 1 - y) * picture->width + x)];
}

static size_t count_color(const struct sheet *sheet, const uint8_t rgb[3])
{
	size_t count = 0;
	for (size_t i = 0; i < (size_t)sheet->picture.width * sheet->picture.height; i++)
		count += memcmp(&sheet->picture.rgba[4 * i], rgb, 3) == 0;
	return count;
}

static void test_the_part_has_the_most_penumbra(void **state)
{
	(void)state;
	struct sheet sheet;
	assert_true(sheet_init(&sheet, truth, WIDTH, HEIGHT, 1, NULL));
	assert_int_equal(sheet.side, SIDE);
	assert_int_equal(sheet.left, LEFT);
	assert_int_equal(sheet.top, TOP);
	sheet_finish(&sheet);
}

static void test_differences_are_below_what_differs(void **state)
{
	(void)state;
	uint8_t off[3];
	struct sheet sheet;
	assert_true(sheet_init(&sheet, truth, WIDTH, HEIGHT, 2, NULL));
	difference_color(.5f, off);
	assert_int_equal(count_color(&sheet, off), 0);
	sheet_add(&sheet, "lit", "", seen);
	/* Four pixels for each of the part, less the one that cannot be compared. */
	assert_int_equal(count_color(&sheet, off), 4 * (SIDE * SIDE - 1));
	sheet_add(&sheet, "true", "", truth);
	assert_int_equal(count_color(&sheet, off), 4 * (SIDE * SIDE - 1));
	sheet_finish(&sheet);
}

static void test_more_than_fit_go_on_below(void **state)
{
	(void)state;
	struct sheet few, many;
	assert_true(sheet_init(&few, truth, WIDTH, HEIGHT, SHEET_COLUMNS, NULL));
	assert_true(sheet_init(&many, truth, WIDTH, HEIGHT, SHEET_COLUMNS + 1, NULL));
	assert_int_equal(many.picture.width, few.picture.width);
	assert_true(many.picture.height > 3 * few.picture.height / 2);
	uint8_t off[3];
	difference_color(.5f, off);
	for (size_t i = 0; i < SHEET_COLUMNS + 1; i++)
		sheet_add(&many, "lit", "", seen);
	assert_int_equal(count_color(&many, off), (SHEET_COLUMNS + 1) * 4 * (SIDE * SIDE - 1));
	sheet_finish(&few);
	sheet_finish(&many);
}

static void test_pictures_smaller_than_a_part_are_whole(void **state)
{
	(void)state;
	static const float tiny[6] = {1, .5f, 0, NAN, 1, 1};
	static const char name[] = "a-name-that-is-much-too-long-for-the-width-of-its-column";
	struct sheet sheet;
	assert_true(sheet_init(&sheet, tiny, 3, 2, 1, NULL));
	assert_int_equal(sheet.side, 2);
	sheet_add(&sheet, name, name, tiny);
	assert_int_equal(pixel(&sheet, 0, 0)[3], 255);
	sheet_finish(&sheet);
	assert_null(sheet.picture.rgba);
}

static bool is_blank(char c)
{
	static const uint8_t none[GLYPH_HEIGHT];
	return memcmp(glyph_rows(c), none, GLYPH_HEIGHT) == 0;
}

static void test_characters_of_names_are_told_apart(void **state)
{
	(void)state;
	static const char all[] = "abcdefghijklmnopqrstuvwxyz0123456789-. ";
	for (size_t i = 0; all[i] != '\0'; i++) {
		assert_int_equal(is_blank(all[i]), all[i] == ' ');
		for (size_t j = 0; j < i; j++)
			assert_memory_not_equal(
				glyph_rows(all[i]), glyph_rows(all[j]), GLYPH_HEIGHT);
	}
	assert_ptr_equal(glyph_rows('Q'), glyph_rows('q'));
	assert_int_equal(glyph_drop('q'), GLYPH_DESCENT);
	assert_int_equal(glyph_drop('b') + glyph_drop('\0'), 0);
	assert_true(is_blank('\xe9'));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_the_part_has_the_most_penumbra),
		cmocka_unit_test(test_differences_are_below_what_differs),
		cmocka_unit_test(test_more_than_fit_go_on_below),
		cmocka_unit_test(test_pictures_smaller_than_a_part_are_whole),
		cmocka_unit_test(test_characters_of_names_are_told_apart),
	};
	return cmocka_run_group_tests(tests, set_up, NULL);
}
