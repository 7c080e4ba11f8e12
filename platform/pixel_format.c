/* SPDX-License-Identifier: MIT */
#include "pixel_format.h"
#include <drm_fourcc.h>
#include <endian.h>
#include <string.h>

static const struct pixel_format formats[] = {
	{"xrgb8888", DRM_FORMAT_XRGB8888, 24, 4, {8, 8, 8}, {16, 8, 0}},
	{"xbgr8888", DRM_FORMAT_XBGR8888, 24, 4, {8, 8, 8}, {0, 8, 16}},
	{"xrgb2101010", DRM_FORMAT_XRGB2101010, 30, 4, {10, 10, 10}, {20, 10, 0}},
	{"rgb565", DRM_FORMAT_RGB565, 16, 2, {5, 6, 5}, {11, 5, 0}},
};
static const size_t format_count = sizeof(formats) / sizeof(formats[0]);

const struct pixel_format *pixel_format_at(size_t index)
{
	return index < format_count ? &formats[index] : NULL;
}

const struct pixel_format *pixel_format_find(const char *name)
{
	for (size_t i = 0; i < format_count; i++)
		if (strcmp(formats[i].name, name) == 0)
			return &formats[i];
	return NULL;
}

const struct pixel_format *pixel_format_of(uint32_t code)
{
	for (size_t i = 0; i < format_count; i++)
		if (formats[i].code == code)
			return &formats[i];
	return NULL;
}

/* The nearest of max + 1 values. */
static uint32_t scale(uint32_t byte, uint32_t max)
{
	return (byte * max + 127) / 255;
}

static uint32_t pack(const struct pixel_format *format, const uint8_t *rgba)
{
	uint32_t pixel = 0;
	for (int c = 0; c < 3; c++)
		pixel |= scale(rgba[c], (1u << format->bits[c]) - 1) << format->shift[c];
	return pixel;
}

/* Bytes that only change places, which the compiler makes vectors of. */
static void pack_bytes(const uint8_t shift[3], const uint8_t *restrict rgba, size_t count,
	uint32_t *restrict pixels)
{
	for (size_t i = 0; i < count; i++, rgba += 4)
		pixels[i] = htole32((uint32_t)rgba[0] << shift[0] | (uint32_t)rgba[1] << shift[1] |
				    (uint32_t)rgba[2] << shift[2]);
}

void pixel_format_pack(
	const struct pixel_format *format, const uint8_t *rgba, size_t count, void *pixels)
{
	if (format->depth == 24) {
		pack_bytes(format->shift, rgba, count, pixels);
	} else if (format->bytes == 4) {
		for (uint32_t *at = pixels, *end = at + count; at < end; at++, rgba += 4)
			*at = htole32(pack(format, rgba));
	} else {
		for (uint16_t *at = pixels, *end = at + count; at < end; at++, rgba += 4)
			*at = htole16((uint16_t)pack(format, rgba));
	}
}
