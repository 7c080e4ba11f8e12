/* SPDX-License-Identifier: MIT */
/* vm_picture [--rotate N] [--rgb565] PICTURE [OTHER]: prints the CRC that vkms has for a display
 * that shows PICTURE, or compares it with OTHER and fails where a pixel differs. A picture is a
 * PNG or PPM file, or "pattern:WxH"; OTHER is as it is. */
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "card.h"

struct picture {
	uint32_t width, height;
	uint8_t *rgb;
};

static struct picture picture_create(uint32_t width, uint32_t height)
{
	demand(width > 0 && height > 0 && width <= 16384 && height <= 16384, "size of a picture");
	struct picture picture = {width, height, calloc((size_t)width * height, 3)};
	demand(picture.rgb != NULL, "memory");
	return picture;
}

static uint8_t *pixel_at(const struct picture *picture, uint32_t x, uint32_t y)
{
	return picture->rgb + 3 * ((size_t)y * picture->width + x);
}

static struct picture draw_pattern(uint32_t width, uint32_t height)
{
	struct picture picture = picture_create(width, height);
	for (uint32_t y = 0; y < height; y++)
		for (uint32_t x = 0; x < width; x++)
			for (int i = 0; i < 3; i++)
				pixel_at(&picture, x, y)[i] =
					(uint8_t)(pattern_color(x, y) >> (16 - 8 * i));
	return picture;
}

static struct picture read_ppm(const char *path)
{
	uint32_t width = 0, height = 0;
	FILE *file = fopen(path, "rb");
	demand(file != NULL, path);
	demand(fscanf(file, "P6 %u %u 255", &width, &height) == 2 && fgetc(file) != EOF, path);
	struct picture picture = picture_create(width, height);
	demand(fread(picture.rgb, 3, (size_t)width * height, file) == (size_t)width * height, path);
	fclose(file);
	return picture;
}

static struct picture read_png(const char *path)
{
	png_image image = {.version = PNG_IMAGE_VERSION};
	demand(png_image_begin_read_from_file(&image, path), path);
	image.format = PNG_FORMAT_RGB;
	struct picture picture = picture_create(image.width, image.height);
	demand(png_image_finish_read(&image, NULL, picture.rgb, 0, NULL), path);
	return picture;
}

static struct picture read_picture(const char *name)
{
	uint32_t width, height;
	if (sscanf(name, "pattern:%ux%u", &width, &height) == 2)
		return draw_pattern(width, height);
	const char *dot = strrchr(name, '.');
	return dot && !strcmp(dot, ".ppm") ? read_ppm(name) : read_png(name);
}

/* A quarter of a turn, clockwise. */
static struct picture turn(struct picture from)
{
	struct picture to = picture_create(from.height, from.width);
	for (uint32_t y = 0; y < to.height; y++)
		for (uint32_t x = 0; x < to.width; x++)
			memcpy(pixel_at(&to, x, y), pixel_at(&from, y, from.height - 1 - x), 3);
	free(from.rgb);
	return to;
}

/* crc32_le() of the kernel: zlib's polynomial, without inversions. */
static uint32_t crc32_le(uint32_t crc, uint8_t byte)
{
	crc ^= byte;
	for (int i = 0; i < 8; i++)
		crc = crc >> 1 ^ (crc & 1 ? 0xedb88320U : 0);
	return crc;
}

/* Threshold of the recursive ordered matrix of 8x8, 0..63. */
static uint32_t threshold(uint32_t x, uint32_t y)
{
	uint32_t odd = x ^ y;
	return (odd & 1) << 5 | (y & 1) << 4 | (odd & 2) << 2 | (y & 2) << 1 | (odd & 4) >> 1 |
	       (y & 4) >> 2;
}

static uint32_t dither(uint32_t value, uint32_t max, uint32_t x, uint32_t y)
{
	uint32_t level = (value * max * 64 + 255 * threshold(x, y) + 127) / (255 * 64);
	return level < max ? level : max;
}

/* RGB565_to_argb_u16() of vkms: fixed point with 32 bits of fraction, and its own rounding. */
static uint16_t expand(uint32_t level, uint32_t max)
{
	const uint64_t one = UINT64_C(1) << 32;
	uint64_t ratio = (65535 * one) / max;
	return (uint16_t)((level * ratio + one / 2) >> 32);
}

static uint16_t vkms_channel(
	const struct picture *picture, uint32_t x, uint32_t y, int channel, int rgb565)
{
	uint32_t value = pixel_at(picture, x, y)[channel];
	uint32_t max = channel == 1 ? 63 : 31;
	return rgb565 ? expand(dither(value, max, x, y), max) : (uint16_t)(value * 257);
}

static uint32_t vkms_crc(const struct picture *picture, int rgb565)
{
	uint32_t crc = 0;
	for (uint32_t y = 0; y < picture->height; y++)
		for (uint32_t x = 0; x < picture->width; x++) {
			uint16_t argb[4] = {0xffff};
			for (int i = 0; i < 3; i++)
				argb[1 + i] = vkms_channel(picture, x, y, i, rgb565);
			for (int i = 0; i < 4; i++)
				crc = crc32_le(crc32_le(crc, argb[i] & 255), argb[i] >> 8);
		}
	return crc;
}

/* Prints how far the pictures are apart; 0 if they are equal. */
static int compare(const struct picture *a, const struct picture *b)
{
	if (a->width != b->width || a->height != b->height) {
		printf("%ux%u against %ux%u\n", a->width, a->height, b->width, b->height);
		return 1;
	}
	size_t different = 0, first = 0, size = (size_t)a->width * a->height;
	for (size_t i = size; i-- > 0;)
		if (memcmp(a->rgb + 3 * i, b->rgb + 3 * i, 3)) {
			different++;
			first = i;
		}
	if (!different)
		return 0;
	const uint8_t *p = a->rgb + 3 * first, *q = b->rgb + 3 * first;
	printf("%zu of %zu pixels differ, first at %zu,%zu: %d %d %d against %d %d %d\n", different,
		size, first % a->width, first / a->width, p[0], p[1], p[2], q[0], q[1], q[2]);
	return 1;
}

int main(int argc, char **argv)
{
	int turns = 0, rgb565 = 0, at = 1;
	for (; at < argc && !strncmp(argv[at], "--", 2); at++) {
		if (!strcmp(argv[at], "--rgb565"))
			rgb565 = 1;
		else if (!strcmp(argv[at], "--rotate") && at + 1 < argc)
			turns = atoi(argv[++at]) / 90;
	}
	if (at >= argc) {
		fputs("usage: vm_picture [--rotate N] [--rgb565] PICTURE [OTHER]\n", stderr);
		return 2;
	}
	struct picture picture = read_picture(argv[at]), other = {0};
	while (turns-- > 0)
		picture = turn(picture);
	int status = 0;
	if (at + 1 < argc) {
		other = read_picture(argv[at + 1]);
		status = compare(&picture, &other);
	} else {
		printf("%08x\n", vkms_crc(&picture, rgb565));
	}
	free(picture.rgb);
	free(other.rgb);
	return status;
}
