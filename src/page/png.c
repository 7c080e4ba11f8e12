/* SPDX-License-Identifier: MIT */
#include "page/png.h"
#include "base/array.h"
#include "base/error.h"
#include <png.h>
#include <stdlib.h>

/* PNG_IMAGE_FLAG_FAST: no filters and zlib level 3. */
static bool encode(struct png *png, uint32_t format, const void *pixels, uint32_t width,
	uint32_t height, struct sm_error *error)
{
	png_image image = {
		.version = PNG_IMAGE_VERSION,
		.width = width,
		.height = height,
		.format = format,
		.flags = PNG_IMAGE_FLAG_FAST,
	};
	/* A negative stride starts from the last row: PNG's top. */
	png_int_32 stride = -(png_int_32)PNG_IMAGE_ROW_STRIDE(image);
	png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
	png->bytes = array_alloc(size, 1);
	if (png->bytes == NULL)
		return error_no_memory(error);
	if (!png_image_write_to_memory(&image, png->bytes, &size, 0, pixels, stride, NULL))
		return error_set(error, SM_ERROR_INPUT, "cannot encode a PNG of %ux%u (%s)", width,
			height, image.message);
	png->size = size;
	return true;
}

bool png_init_picture(struct png *png, const uint8_t *rgba, uint32_t width, uint32_t height,
	struct sm_error *error)
{
	*png = (struct png){0};
	uint8_t *rgb = array_alloc(height, 3 * (size_t)width);
	if (rgb == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < (size_t)width * height; i++) {
		rgb[3 * i] = rgba[4 * i];
		rgb[3 * i + 1] = rgba[4 * i + 1];
		rgb[3 * i + 2] = rgba[4 * i + 2];
	}
	bool encoded = encode(png, PNG_FORMAT_RGB, rgb, width, height, error);
	free(rgb);
	return encoded;
}

bool png_init_visibility(struct png *png, const uint8_t *rgba, uint32_t width, uint32_t height,
	struct sm_error *error)
{
	*png = (struct png){0};
	uint16_t *grey = array_alloc(height, sizeof(*grey) * width);
	if (grey == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < (size_t)width * height; i++)
		grey[i] = (uint16_t)(rgba[4 * i] << 8 | rgba[4 * i + 1]);
	bool encoded = encode(png, PNG_FORMAT_LINEAR_Y, grey, width, height, error);
	free(grey);
	return encoded;
}

void png_finish(struct png *png)
{
	free(png->bytes);
	*png = (struct png){0};
}
