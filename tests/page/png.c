/* SPDX-License-Identifier: MIT */
/* What is encoded comes back: every value, the right way up, and marked with its meaning. */
#include "page/png.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

static const struct {
	uint32_t width, height;
} sizes[] = {{1, 1}, {1, 7}, {7, 1}, {3, 5}, {257, 129}, {64, 64}};

#define SIZES (sizeof(sizes) / sizeof(sizes[0]))

/* Bytes that differ from pixel to pixel and from channel to channel. */
static uint8_t *make_pixels(uint32_t width, uint32_t height)
{
	size_t size = (size_t)width * height * 4;
	uint8_t *rgba = malloc(size);
	assert_non_null(rgba);
	for (size_t i = 0; i < size; i++)
		rgba[i] = (uint8_t)(i * 2654435761u >> 13);
	return rgba;
}

/* Reads as `format`; free() the result. */
static void *decode(const struct png *png, uint32_t format, uint32_t width, uint32_t height)
{
	png_image image = {.version = PNG_IMAGE_VERSION};
	assert_true(png_image_begin_read_from_memory(&image, png->bytes, png->size));
	assert_int_equal(image.format, format);
	assert_int_equal(image.width, width);
	assert_int_equal(image.height, height);
	void *pixels = malloc(PNG_IMAGE_SIZE(image));
	assert_non_null(pixels);
	assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
	return pixels;
}

static bool has_chunk(const struct png *png, const char *chunk, size_t size)
{
	for (const uint8_t *at = png->bytes; at + size <= (uint8_t *)png->bytes + png->size; at++)
		if (memcmp(at, chunk, size) == 0)
			return true;
	return false;
}

static void test_pictures_keep_their_bytes(void **state)
{
	(void)state;
	for (size_t i = 0; i < SIZES; i++) {
		uint32_t width = sizes[i].width, height = sizes[i].height;
		struct png png;
		uint8_t *rgba = make_pixels(width, height);
		assert_true(png_init_picture(&png, rgba, width, height, NULL));
		uint8_t *rgb = decode(&png, PNG_FORMAT_RGB, width, height);
		for (size_t y = 0; y < height; y++)
			for (size_t x = 0; x < width; x++)
				assert_memory_equal(&rgb[3 * (y * width + x)],
					&rgba[4 * ((height - 1 - y) * width + x)], 3);
		free(rgb);
		free(rgba);
		png_finish(&png);
	}
}

static void test_visibility_keeps_sixteen_bits(void **state)
{
	(void)state;
	for (size_t i = 0; i < SIZES; i++) {
		uint32_t width = sizes[i].width, height = sizes[i].height;
		struct png png;
		uint8_t *rgba = make_pixels(width, height);
		assert_true(png_init_visibility(&png, rgba, width, height, NULL));
		uint16_t *grey = decode(&png, PNG_FORMAT_LINEAR_Y, width, height);
		for (size_t y = 0; y < height; y++)
			for (size_t x = 0; x < width; x++) {
				const uint8_t *pixel = &rgba[4 * ((height - 1 - y) * width + x)];
				assert_int_equal(grey[y * width + x], 256 * pixel[0] + pixel[1]);
			}
		free(grey);
		free(rgba);
		png_finish(&png);
	}
}

static void test_files_say_how_to_read_their_values(void **state)
{
	(void)state;
	static const uint8_t rgba[4] = {1, 2, 3, 4};
	struct png png;
	assert_true(png_init_picture(&png, rgba, 1, 1, NULL));
	assert_true(has_chunk(&png, "\0\0\0\1sRGB", 8));
	png_finish(&png);
	assert_true(png_init_visibility(&png, rgba, 1, 1, NULL));
	assert_false(has_chunk(&png, "sRGB", 4));
	assert_true(has_chunk(&png, "\0\0\0\4gAMA\0\1\x86\xa0", 12)); /* 100000: gamma 1 */
	png_finish(&png);
}

static void test_no_pixels_are_an_error(void **state)
{
	(void)state;
	struct sm_error error;
	struct png png;
	uint8_t rgba[4] = {0};
	assert_false(png_init_picture(&png, rgba, 0, 1, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	png_finish(&png);
	assert_false(png_init_visibility(&png, rgba, 1, 0, &error));
	png_finish(&png);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_pictures_keep_their_bytes),
		cmocka_unit_test(test_visibility_keeps_sixteen_bits),
		cmocka_unit_test(test_files_say_how_to_read_their_values),
		cmocka_unit_test(test_no_pixels_are_an_error),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
