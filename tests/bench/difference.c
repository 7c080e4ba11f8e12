/* SPDX-License-Identifier: MIT */
/* Pictures of errors: grey where there is none, red and blue to either side, dark where nothing can
 * be compared. */
#include "bench/difference.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

static void test_sign_is_hue_and_size_is_strength(void **state)
{
	(void)state;
	uint8_t zero[3], before[3], now[3];
	difference_color(0, zero);
	assert_int_equal(zero[0], zero[1]);
	assert_int_equal(zero[1], zero[2]);
	for (int sign = -1; sign <= 1; sign += 2) {
		int strong = sign > 0 ? 0 : 2;
		memcpy(before, zero, 3);
		for (int i = 1; i <= 10; i++) {
			difference_color((float)(sign * i) * DIFFERENCE_FULL / 10, now);
			assert_true(now[strong] - now[2 - strong] >
				    before[strong] - before[2 - strong]);
			memcpy(before, now, 3);
		}
		difference_color((float)sign, now);
		assert_memory_equal(now, before, 3);
	}
}

/* Rec. 709 luminance of sRGB bytes. */
static double luminance(const uint8_t rgb[3])
{
	static const double weights[3] = {0.2126, 0.7152, 0.0722};
	double sum = 0;
	for (int i = 0; i < 3; i++)
		sum += weights[i] * pow(rgb[i] / 255.0, 2.2);
	return sum;
}

static void test_both_signs_are_about_as_dark(void **state)
{
	(void)state;
	for (int i = 1; i <= 10; i++) {
		uint8_t bright[3], dark[3];
		difference_color((float)i / 20, bright);
		difference_color((float)-i / 20, dark);
		assert_true(fabs(luminance(bright) - luminance(dark)) < 0.05);
	}
}

static void test_three_pictures_are_beside_each_other(void **state)
{
	(void)state;
	/* 2 x 2, rows from the top, but from the bottom in the picture */
	static const float visibility[4] = {0.5f, NAN, 1, 0}, reference[4] = {0, 0, 1, 0.5f};
	static const uint8_t white[3] = {255, 255, 255}, black[3] = {0, 0, 0};
	struct picture picture;
	uint8_t color[3];
	assert_true(difference_montage(&picture, visibility, reference, 2, 2, NULL));
	assert_int_equal(picture.height, 2);
	size_t stride = (picture.width - 2) / 2;
	const uint8_t *low = picture.rgba, *high = low + 4 * picture.width;
	assert_memory_equal(low, white, 3);
	assert_memory_equal(low + 4 * stride, white, 3);
	difference_color(0, color);
	assert_memory_equal(low + 8 * stride, color, 3);
	assert_int_equal(low[4], 188); /* sRGB of 0.5 */
	assert_memory_equal(low + 4 * stride + 4, black, 3);
	difference_color(-0.5f, color);
	assert_memory_equal(low + 8 * stride + 4, color, 3);
	difference_color(0.5f, color);
	assert_memory_equal(high + 8 * stride, color, 3);
	for (size_t i = 0; i < 3; i++)
		assert_memory_equal(high + 4 * (i * stride + 1), low + 8, 3); /* as the gutter */
	for (size_t i = 0; i < picture.width * 2; i++)
		assert_int_equal(picture.rgba[4 * i + 3], 255);
	difference_finish(&picture);
}

static void test_too_wide_is_refused(void **state)
{
	(void)state;
	struct picture picture;
	struct sm_error error;
	assert_false(difference_montage(&picture, NULL, NULL, UINT32_MAX, 1, &error));
	difference_finish(&picture);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_sign_is_hue_and_size_is_strength),
		cmocka_unit_test(test_both_signs_are_about_as_dark),
		cmocka_unit_test(test_three_pictures_are_beside_each_other),
		cmocka_unit_test(test_too_wide_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
