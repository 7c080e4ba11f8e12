/* SPDX-License-Identifier: MIT */
#include "load/image.h"
#include <png.h>
#include <string.h>

uint8_t *image_alloc(struct model *model, uint64_t width, uint64_t height)
{
	if (width < 1 || height < 1 || width > MODEL_IMAGE_MAX || height > MODEL_IMAGE_MAX)
		return NULL;
	return model_alloc(model, height, 4 * width);
}

static const char *png_decode(
	struct model *model, const void *bytes, size_t size, struct model_image *image)
{
	png_image png = {.version = PNG_IMAGE_VERSION};
	if (!png_image_begin_read_from_memory(&png, bytes, size))
		return "a damaged PNG";
	png.format = PNG_FORMAT_RGBA;
	uint8_t *rgba = image_alloc(model, png.width, png.height);
	if (rgba == NULL) {
		png_image_free(&png);
		return "too large";
	}
	if (!png_image_finish_read(&png, NULL, rgba, 0, NULL))
		return "a damaged PNG";
	*image = (struct model_image){png.width, png.height, rgba};
	return NULL;
}

const char *image_decode(
	struct model *model, const void *bytes, size_t size, struct model_image *image)
{
	static const uint8_t png[] = {0x89, 'P', 'N', 'G'}, jpeg[] = {0xff, 0xd8, 0xff};
	if (size > sizeof(png) && memcmp(bytes, png, sizeof(png)) == 0)
		return png_decode(model, bytes, size, image);
	if (size > sizeof(jpeg) && memcmp(bytes, jpeg, sizeof(jpeg)) == 0)
		return jpeg_decode(model, bytes, size, image);
	return "neither PNG nor JPEG";
}
