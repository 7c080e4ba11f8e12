/* SPDX-License-Identifier: MIT */
/* Copies of a picture to screens: which pixel goes where, and as which value. */
#include "canvas.h"
#include "rig.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* All values of all channels at all places of the dither matrix, however the picture is turned, and
 * no multiple of 8 pixels. */
#define BLOCKS 33 /* of 8x8 pixels, a row */
#define WIDTH (8 * BLOCKS + 3)
#define HEIGHT (8 * 8 + 5)

typedef uint8_t picture[HEIGHT][WIDTH][4]; /* rows from the top */

static void paint(picture pixels)
{
	for (int y = 0; y < HEIGHT; y++) {
		for (int x = 0; x < WIDTH; x++) {
			int block = x / 8 + BLOCKS * (y / 8);
			pixels[y][x][0] = (uint8_t)block;
			pixels[y][x][1] = (uint8_t)(5 * block + 17);
			pixels[y][x][2] = (uint8_t)(255 - block);
			pixels[y][x][3] = (uint8_t)(x + y);
		}
	}
}

static GLuint upload(const picture pixels)
{
	GLuint texture;
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, WIDTH, HEIGHT);
	for (int y = 0; y < HEIGHT; y++)
		glTexSubImage2D(GL_TEXTURE_2D, 0, 0, HEIGHT - 1 - y, WIDTH, 1, GL_RGBA,
			GL_UNSIGNED_BYTE, pixels[y]);
	glBindTexture(GL_TEXTURE_2D, 0);
	return texture;
}

struct format {
	GLenum name;
	uint8_t bits[3];
};

static const struct format formats[] = {
	{GL_RGBA8, {8, 8, 8}}, {GL_RGB565, {5, 6, 5}}, {GL_RGB10_A2, {10, 10, 10}}};

static int max_of(const struct format *format, int channel)
{
	return (1 << format->bits[channel]) - 1;
}

/* [height][width][3] values as they are stored, rows from the top; the caller's to free(). */
static int (*read_values(const struct canvas *canvas, const struct format *format))[3]
{
	size_t width = canvas->width, height = canvas->height;
	uint32_t *rows = malloc(width * height * sizeof(*rows));
	int(*values)[3] = malloc(width * height * sizeof(*values));
	assert_true(rows != NULL && values != NULL);
	bool wide = format->bits[0] > 8;
	glReadPixels(0, 0, (GLsizei)width, (GLsizei)height, GL_RGBA,
		wide ? GL_UNSIGNED_INT_2_10_10_10_REV : GL_UNSIGNED_BYTE, rows);
	for (size_t i = 0; i < width * height; i++) {
		uint32_t pixel = rows[(height - 1 - i / width) * width + i % width];
		for (int channel = 0; channel < 3; channel++) {
			int value = (int)(pixel >> (wide ? 10 : 8) * channel & (wide ? 1023 : 255));
			/* What GL widens to bytes, back. */
			values[i][channel] =
				wide ? value : (2 * value * max_of(format, channel) + 255) / 510;
		}
	}
	free(rows);
	return values;
}

/* Bayer's matrix, as it is built up: each step puts four copies side by side. */
static int bayer(int x, int y)
{
	static const int step[2][2] = {{0, 2}, {3, 1}}; /* [y][x] */
	return 16 * step[y & 1][x & 1] + 4 * step[y >> 1 & 1][x >> 1 & 1] +
	       step[y >> 2 & 1][x >> 2 & 1];
}

static int expected_value(int byte, int max, int x, int y)
{
	if (max == 255)
		return byte;
	if (max > 255)
		return (2 * byte * max + 255) / 510;
	return (byte * max * 64 + 255 * bayer(x, y) + 127) / (255 * 64);
}

/* The picture's pixel (px, py) that is seen at (x, y) of the screen, both from the top left. */
static void pixel_at(uint32_t rotation, int x, int y, int *px, int *py)
{
	switch (rotation) {
	case 0:
		*px = x, *py = y;
		break;
	case 90:
		*px = y, *py = HEIGHT - 1 - x;
		break;
	case 180:
		*px = WIDTH - 1 - x, *py = HEIGHT - 1 - y;
		break;
	default:
		*px = WIDTH - 1 - y, *py = x;
	}
}

static void assert_copied(const picture pixels, const int (*values)[3], uint32_t rotation,
	const struct format *format)
{
	int width = rotation % 180 == 0 ? WIDTH : HEIGHT;
	for (int i = 0; i < WIDTH * HEIGHT; i++) {
		int x = i % width, y = i / width, px, py;
		pixel_at(rotation, x, y, &px, &py);
		for (int channel = 0; channel < 3; channel++) {
			int byte = pixels[py][px][channel];
			int wanted = expected_value(byte, max_of(format, channel), x, y);
			if (values[i][channel] != wanted)
				fail_msg("%u degrees, %u bits, (%d, %d), channel %d: byte %d gives "
					 "%d, not %d",
					rotation, format->bits[channel], x, y, channel, byte,
					values[i][channel], wanted);
		}
	}
}

static void copy(struct rig *rig, const struct sm_screen *screen)
{
	struct sm_error error;
	if (!sm_renderer_copy_to_screen(rig->renderer, screen, &error))
		fail_msg("%s", error.text);
}

static void check_all_screens(struct rig *rig)
{
	static picture pixels;
	paint(pixels);
	GLuint texture = upload(pixels);
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
		for (uint32_t rotation = 0; rotation < 360; rotation += 90) {
			bool turned = rotation % 180 != 0;
			struct canvas canvas;
			canvas_init(&canvas, formats[i].name, turned ? HEIGHT : WIDTH,
				turned ? WIDTH : HEIGHT);
			struct sm_screen screen = {.texture = texture,
				.width = WIDTH,
				.height = HEIGHT,
				.framebuffer = canvas.framebuffer,
				.rotation = rotation};
			memcpy(screen.bits, formats[i].bits, sizeof(screen.bits));
			copy(rig, &screen);
			int(*values)[3] = read_values(&canvas, &formats[i]);
			assert_copied(pixels, (const int(*)[3])values, rotation, &formats[i]);
			free(values);
			canvas_finish(&canvas);
		}
	}
	glDeleteTextures(1, &texture);
}

static void pictures_come_through_turned_and_rounded_exactly(void **state)
{
	check_all_screens(*state);
}

/* Drivers that always decode sRGB. */
static void so_they_do_decoded_and_encoded_again(void **state)
{
	struct rig *rig = *state;
	rig_use_driver(rig, &(struct sm_driver_options){.caps = "-EXT_texture_sRGB_decode"});
	check_all_screens(rig);
}

/* A level between two values is shown by as many pixels of the matrix as it is near to them. */
static void dithering_keeps_the_mean(void **state)
{
	(void)state;
	for (int byte = 0; byte < 256; byte++) {
		int sum = 0;
		for (int i = 0; i < 64; i++)
			sum += expected_value(byte, 31, i % 8, i / 8);
		/* In 1/64 steps, to the nearest. */
		assert_true(abs(sum * 255 - byte * 31 * 64) <= 255);
	}
}

static void screens_that_cannot_be_are_refused(void **state)
{
	struct rig *rig = *state;
	static picture pixels;
	struct canvas plain, encoded;
	GLint most[2];
	glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most);
	canvas_init(&encoded, GL_SRGB8_ALPHA8, WIDTH, HEIGHT);
	canvas_init(&plain, GL_RGBA8, WIDTH, HEIGHT);
	GLuint texture = upload(pixels);
	const struct sm_screen good = {texture, WIDTH, HEIGHT, plain.framebuffer, 0, {8, 8, 8}};
	struct {
		struct sm_screen screen;
		const char *text;
	} cases[] = {
		{good, "turned by 45 degrees"},
		{good, "turned by 360 degrees"},
		{good, "a screen of 5,5,5 bits"},
		{good, "a screen of 0,0,0 bits"},
		{good, "a screen of 0x69 pixels"},
		{good, "a screen of 69x4294967295 pixels"},
		{good, "no texture"},
		{good, "is sRGB"},
	};
	cases[0].screen.rotation = 45;
	cases[1].screen.rotation = 360;
	memset(cases[2].screen.bits, 5, 3);
	memset(cases[3].screen.bits, 0, 3);
	cases[4].screen.width = 0;
	cases[5].screen.width = UINT32_MAX;
	cases[5].screen.rotation = 270;
	cases[6].screen.texture = 0;
	cases[7].screen.framebuffer = encoded.framebuffer;
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_error error = {0};
		assert_false(sm_renderer_copy_to_screen(rig->renderer, &cases[i].screen, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		if (strstr(error.text, cases[i].text) == NULL)
			fail_msg("\"%s\" says nothing of \"%s\"", error.text, cases[i].text);
	}
	copy(rig, &good);
	glDeleteTextures(1, &texture);
	canvas_finish(&plain);
	canvas_finish(&encoded);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(pictures_come_through_turned_and_rounded_exactly),
		rig_test(so_they_do_decoded_and_encoded_again),
		cmocka_unit_test(dithering_keeps_the_mean),
		rig_test(screens_that_cannot_be_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
