/* SPDX-License-Identifier: MIT */
#include "pixel_format.h"
#include <drm_fourcc.h>
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

void pixel_format_pack(
	const struct pixel_format *format, const uint8_t *rgba, size_t count, void *pixels)
{
	uint32_t max[3];
	uint8_t *out = pixels;
	for (int c = 0; c < 3; c++)
		max[c] = (1u << format->bits[c]) - 1;
	for (size_t i = 0; i < count; i++, rgba += 4, out += format->bytes) {
		uint32_t pixel = 0;
		for (int c = 0; c < 3; c++)
			pixel |= (rgba[c] * max[c] + 127) / 255 << format->shift[c];
		for (int byte = 0; byte < format->bytes; byte++)
			out[byte] = (uint8_t)(pixel >> 8 * byte);
	}
}
