/* SPDX-License-Identifier: MIT */
#ifndef LOAD_IMAGE_H
#define LOAD_IMAGE_H

#include "load/model.h"

/** Decodes a PNG or JPEG file in memory into texels that belong to the model. Returns NULL, or why
 *  it cannot be used; then *image is unchanged. */
const char *image_decode(
	struct model *model, const void *bytes, size_t size, struct model_image *image);

/** The same for JPEG alone. */
const char *jpeg_decode(
	struct model *model, const void *bytes, size_t size, struct model_image *image);

/** Memory for [height][width][4] bytes of a model, or NULL when the sides are not between 1 and
 *  MODEL_IMAGE_MAX or the model is full. */
uint8_t *image_alloc(struct model *model, uint64_t width, uint64_t height);

#endif
