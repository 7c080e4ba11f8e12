/* SPDX-License-Identifier: MIT */
#include "load/image.h"
#include <turbojpeg.h>

static const char *decode(tjhandle decoder, struct model *model, const unsigned char *bytes,
	unsigned long size, struct model_image *image)
{
	int width = 0, height = 0, subsampling, colors;
	/* It also succeeds on a file of tables alone, and then tells no size. */
	if (tjDecompressHeader3(decoder, bytes, size, &width, &height, &subsampling, &colors) !=
			0 ||
		width < 1 || height < 1)
		return "a damaged JPEG";
	uint8_t *rgba = image_alloc(model, (uint64_t)width, (uint64_t)height);
	if (rgba == NULL)
		return "too large";
	/* A warning leaves a picture with some texels wrong, as of a file cut short. */
	if (tjDecompress2(decoder, bytes, size, rgba, width, 0, height, TJPF_RGBA, 0) != 0 &&
		tjGetErrorCode(decoder) != TJERR_WARNING)
		return "a damaged JPEG";
	*image = (struct model_image){(uint32_t)width, (uint32_t)height, rgba};
	return NULL;
}

const char *jpeg_decode(
	struct model *model, const void *bytes, size_t size, struct model_image *image)
{
	tjhandle decoder = tjInitDecompress();
	if (decoder == NULL)
		return "more than memory holds";
	const char *problem = decode(decoder, model, bytes, size, image);
	tjDestroy(decoder);
	return problem;
}
