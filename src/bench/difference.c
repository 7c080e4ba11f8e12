/* SPDX-License-Identifier: MIT */
#include "bench/difference.h"
#include "base/array.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels between pictures. */
#define GUTTER 4

static const uint8_t background[3] = {24, 26, 32};

/* IEC 61966-2-1 */
static uint8_t encode_srgb(float linear)
{
	float value = fminf(fmaxf(linear, 0), 1);
	value = value <= 0.0031308f ? 12.92f * value : 1.055f * powf(value, 1 / 2.4f) - 0.055f;
	return (uint8_t)(255 * value + 0.5f);
}

/* Oklab (Ottosson 2020), in which equal distances look alike. */
static void encode_oklab(const float lab[3], uint8_t rgb[3])
{
	float l = lab[0] + 0.3963377774f * lab[1] + 0.2158037573f * lab[2];
	float m = lab[0] - 0.1055613458f * lab[1] - 0.0638541728f * lab[2];
	float s = lab[0] - 0.0894841775f * lab[1] - 1.2914855480f * lab[2];
	l = l * l * l;
	m = m * m * m;
	s = s * s * s;
	rgb[0] = encode_srgb(4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s);
	rgb[1] = encode_srgb(-1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s);
	rgb[2] = encode_srgb(-0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s);
}

void difference_color(float error, uint8_t rgb[3])
{
	/* Both ends are as dark and as colourful as each other. */
	static const float grey[3] = {0.85f, 0, 0}, red[3] = {0.5f, 0.17f, 0.09f},
			   blue[3] = {0.5f, -0.03f, -0.19f};
	const float *end = error > 0 ? red : blue;
	float share = fminf(fabsf(error) / DIFFERENCE_FULL, 1), lab[3];
	for (int i = 0; i < 3; i++)
		lab[i] = grey[i] + share * (end[i] - grey[i]);
	encode_oklab(lab, rgb);
}

void difference_write_gradient(FILE *file)
{
	fputs("linear-gradient(90deg", file);
	for (int i = -4; i <= 4; i++) {
		uint8_t rgb[3];
		difference_color((float)i / 4 * DIFFERENCE_FULL, rgb);
		fprintf(file, ",#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
	}
	fputc(')', file);
}

void difference_grey(float visibility, uint8_t rgb[3])
{
	memset(rgb, encode_srgb(visibility), 3);
}

static void paint(struct picture *picture, size_t x, size_t y, const uint8_t rgb[3])
{
	memcpy(&picture->rgba[4 * (y * picture->width + x)], rgb, 3);
}

static void paint_pixel(struct picture *picture, size_t x, size_t y, size_t stride,
	float visibility, float reference)
{
	uint8_t rgb[3];
	if (isnan(visibility) || isnan(reference))
		return;
	difference_grey(reference, rgb);
	paint(picture, x, y, rgb);
	difference_grey(visibility, rgb);
	paint(picture, x + stride, y, rgb);
	difference_color(visibility - reference, rgb);
	paint(picture, x + 2 * stride, y, rgb);
}

bool difference_montage(struct picture *picture, const float *visibility, const float *reference,
	uint32_t width, uint32_t height, struct sm_error *error)
{
	size_t stride = (size_t)width + GUTTER;
	*picture = (struct picture){0};
	if (width > UINT32_MAX / 12 - GUTTER)
		return error_no_memory(error);
	picture->width = (uint32_t)(2 * stride + width);
	picture->height = height;
	picture->rgba = array_alloc(height, 4 * (size_t)picture->width);
	if (picture->rgba == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < (size_t)picture->width * height; i++) {
		memcpy(&picture->rgba[4 * i], background, 3);
		picture->rgba[4 * i + 3] = 255;
	}
	for (size_t y = 0; y < height; y++)
		for (size_t x = 0; x < width; x++) {
			size_t from = (height - 1 - y) * width + x;
			paint_pixel(picture, x, y, stride, visibility[from], reference[from]);
		}
	return true;
}

void difference_finish(struct picture *picture)
{
	free(picture->rgba);
	*picture = (struct picture){0};
}
