/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_PIXEL_FORMAT_H
#define PLATFORM_PIXEL_FORMAT_H

#include <smoothie.h>

/** How a screen's buffer stores a pixel. */
struct pixel_format {
	const char *name;     /**< as the command line has it: "xrgb8888" */
	uint32_t code;        /**< DRM_FORMAT_* */
	uint8_t depth, bytes; /**< bits that tell colours apart; bytes of a pixel */
	uint8_t bits[3];      /**< of red, green and blue */
	uint8_t shift[3];     /**< of red, green and blue from the lowest bit of the pixel */
};

/** The formats that a picture can be shown in, the most wanted first; NULL past the last. */
const struct pixel_format *pixel_format_at(size_t index);
/** NULL when there is none of that name, or of that code. */
const struct pixel_format *pixel_format_find(const char *name);
const struct pixel_format *pixel_format_of(uint32_t code);

/** Packs count pixels of R,G,B,A bytes, little-endian as DRM has them; a channel that has fewer
 *  bits than 8 is rounded, one that has more is stretched. pixels: aligned as the pixels are. */
void pixel_format_pack(
	const struct pixel_format *format, const uint8_t *rgba, size_t count, void *pixels);

#endif
