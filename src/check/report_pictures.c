/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "bench/difference.h"
#include "bench/report.h"
#include "check/report.h"
#include "page/png.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>

double check_difference_full(double max)
{
	static const double steps[] = {
		1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, .01, .02, .05, .1, .2, .5, 1};
	size_t i = 0;
	while (i + 1 < sizeof(steps) / sizeof(steps[0]) && steps[i] < max)
		i++;
	return steps[i];
}

/* What a picture's bytes are made of: rows from the bottom. */
typedef void (*painter)(const struct check_pair *pair, double full, size_t from, uint8_t rgba[4]);

static void paint_value(uint16_t value, uint8_t rgba[4])
{
	rgba[0] = (uint8_t)(value >> 8);
	rgba[1] = (uint8_t)(value & 255);
}

static void paint_result(const struct check_pair *pair, double full, size_t from, uint8_t rgba[4])
{
	(void)full;
	paint_value(pair->result[from], rgba);
}

static void paint_reference(
	const struct check_pair *pair, double full, size_t from, uint8_t rgba[4])
{
	(void)full;
	paint_value(pair->reference[from], rgba);
}

static double difference_at(const struct check_pair *pair, size_t from)
{
	return ((int)pair->result[from] - (int)pair->reference[from]) / 65535.0;
}

static void paint_difference(
	const struct check_pair *pair, double full, size_t from, uint8_t rgba[4])
{
	difference_color((float)(difference_at(pair, from) / full * DIFFERENCE_FULL), rgba);
}

static double difference_max(const struct check_pair *pair)
{
	double max = 0;
	for (size_t i = 0; i < (size_t)pair->width * pair->height; i++)
		max = fmax(max, fabs(difference_at(pair, i)));
	return max;
}

/* Of each pixel; NULL without memory. */
static uint8_t *paint(const struct check_pair *pair, painter paint_pixel)
{
	double full = check_difference_full(difference_max(pair));
	size_t width = pair->width, height = pair->height;
	uint8_t *rgba = array_alloc(height, 4 * width);
	for (size_t y = 0; y < height && rgba != NULL; y++)
		for (size_t x = 0; x < width; x++)
			paint_pixel(pair, full, (height - 1 - y) * width + x,
				&rgba[4 * (y * width + x)]);
	return rgba;
}

/* Three pictures of a case. */
static const struct kind {
	const char *name;
	painter paint;
	bool (*encode)(struct png *png, const uint8_t *rgba, uint32_t width, uint32_t height,
		struct sm_error *error);
} kinds[] = {
	{"result", paint_result, png_init_visibility},
	{"reference", paint_reference, png_init_visibility},
	{"difference", paint_difference, png_init_picture},
};

static bool encode(struct png *png, const struct check_pair *pair, const struct kind *kind,
	struct sm_error *error)
{
	*png = (struct png){0};
	uint8_t *rgba = paint(pair, kind->paint);
	if (rgba == NULL)
		return error_no_memory(error);
	bool encoded = kind->encode(png, rgba, pair->width, pair->height, error);
	free(rgba);
	return encoded;
}

static bool write_picture(const char *folder, const struct check_pair *pair,
	const struct kind *kind, const char *name, file_writer write, struct sm_error *error)
{
	char path[PATH_MAX];
	struct png png = {0};
	bool written = check_report_path(folder, name, path, error) &&
		       encode(&png, pair, kind, error) && write(path, png.bytes, png.size, error);
	png_finish(&png);
	return written;
}

bool check_pictures_write(const char *folder, const struct check_pair *pair, file_writer write,
	struct check_result *result, struct sm_error *error)
{
	struct check_pictures pictures;
	char *const names[] = {pictures.result, pictures.reference, pictures.difference};
	char path[PATH_MAX];
	result->pictures = (struct check_pictures){0};
	if (!check_report_path(folder, "pictures", path, error) || !report_make_folder(path, error))
		return false;
	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++) {
		snprintf(names[i], sizeof(pictures.result), "pictures/%s-%s.png", result->name,
			kinds[i].name);
		if (!write_picture(folder, pair, &kinds[i], names[i], write, error))
			return false;
	}
	result->pictures = pictures;
	return true;
}
