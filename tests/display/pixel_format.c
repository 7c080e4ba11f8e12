/* SPDX-License-Identifier: MIT */
/* Pixels as DRM has them: little-endian, whatever the machine. */
#include "pixel_format.h"
#include <drm_fourcc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void colours_are_packed(void **state)
{
	(void)state;
	static const struct {
		const char *name;
		uint32_t code;
		uint8_t rgba[8], pixels[8];
	} cases[] = {
		{"xrgb8888", DRM_FORMAT_XRGB8888, {1, 2, 3, 255, 255, 254, 253, 0},
			{3, 2, 1, 0, 253, 254, 255, 0}},
		{"xbgr8888", DRM_FORMAT_XBGR8888, {1, 2, 3, 255, 255, 254, 253, 0},
			{1, 2, 3, 0, 255, 254, 253, 0}},
		/* 255 becomes 1023, 128 becomes 514 (513.5), 1 becomes 4. */
		{"xrgb2101010", DRM_FORMAT_XRGB2101010, {255, 0, 0, 0, 0, 128, 1, 0},
			{0, 0, 0xf0, 0x3f, 0x04, 0x08, 0x08, 0}},
		/* 132 becomes 16 (16.05) of 31, 128 becomes 32 (31.6) of 63. */
		{"rgb565", DRM_FORMAT_RGB565, {255, 0, 0, 0, 132, 128, 255, 0},
			{0x00, 0xf8, 0x1f, 0x84}},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		uint8_t pixels[9];
		const struct pixel_format *format = pixel_format_find(cases[i].name);
		assert_non_null(format);
		assert_ptr_equal(format, pixel_format_at(i));
		assert_ptr_equal(format, pixel_format_of(cases[i].code));
		memset(pixels, 0xa5, sizeof(pixels));
		pixel_format_pack(format, cases[i].rgba, 2, pixels);
		assert_memory_equal(pixels, cases[i].pixels, 2u * format->bytes);
		assert_int_equal(pixels[2 * format->bytes], 0xa5);
	}
	assert_null(pixel_format_at(sizeof(cases) / sizeof(cases[0])));
	assert_null(pixel_format_find("argb8888"));
	assert_null(pixel_format_of(DRM_FORMAT_ARGB8888));
}

/* Each byte is at most half a step away. */
static void every_byte_is_rounded(void **state)
{
	(void)state;
	for (size_t i = 0; pixel_format_at(i) != NULL; i++) {
		const struct pixel_format *format = pixel_format_at(i);
		for (int byte = 0; byte < 256; byte++) {
			const uint8_t rgba[] = {(uint8_t)byte, (uint8_t)byte, (uint8_t)byte, 9};
			uint8_t out[4] = {0};
			pixel_format_pack(format, rgba, 1, out);
			uint32_t pixel =
				out[0] | out[1] << 8 | out[2] << 16 | (uint32_t)out[3] << 24;
			for (int c = 0; c < 3; c++) {
				int max = (1 << format->bits[c]) - 1;
				int value = (int)(pixel >> format->shift[c]) & max;
				int twice = 2 * (value * 255 - byte * max);
				assert_true(twice >= -255 && twice <= 255);
			}
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(colours_are_packed),
		cmocka_unit_test(every_byte_is_rounded),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
