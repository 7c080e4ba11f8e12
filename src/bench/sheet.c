/* SPDX-License-Identifier: MIT */
#include "bench/sheet.h"
#include "base/array.h"
#include "bench/glyph.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels of a part a side at most, and how much it is enlarged. */
#define PART 144
#define ZOOM 2
#define CELL (PART * ZOOM)
/* Between cells, and of what is written above them: two lines of enlarged characters. */
#define GUTTER 6
#define LINE (ZOOM * (GLYPH_HEIGHT + GLYPH_DESCENT + 1))
#define HEAD (2 * LINE + GUTTER)
#define BAND (HEAD + 2 * (CELL + GUTTER))

static const uint8_t background[3] = {24, 26, 32}, ink[3] = {236, 238, 242},
		     frame_color[3] = {255, 140, 0};

static size_t smaller(size_t a, size_t b)
{
	return a < b ? a : b;
}

static bool is_mixed(float visibility)
{
	return visibility > 0 && visibility < 1;
}

/* sums: [height + 1][width + 1], of mixed pixels above and to the left. */
static void sum_mixed(const struct sheet *sheet, uint32_t *sums)
{
	size_t stride = (size_t)sheet->width + 1;
	memset(sums, 0, stride * sizeof(*sums));
	for (size_t y = 0; y < sheet->height; y++) {
		uint32_t *row = sums + (y + 1) * stride, count = 0;
		row[0] = 0;
		for (size_t x = 0; x < sheet->width; x++) {
			count += is_mixed(sheet->reference[y * sheet->width + x]);
			row[x + 1] = row[x + 1 - stride] + count;
		}
	}
}

/* Finds the part with the most penumbra, the first of equals. */
static bool find_part(struct sheet *sheet, struct sm_error *error)
{
	size_t stride = (size_t)sheet->width + 1, side = sheet->side;
	uint32_t *sums = array_alloc((size_t)sheet->height + 1, stride * sizeof(*sums)), most = 0;
	if (sums == NULL)
		return error_no_memory(error);
	sum_mixed(sheet, sums);
	for (size_t y = 0; y + side <= sheet->height; y++)
		for (size_t x = 0; x + side <= sheet->width; x++) {
			const uint32_t *high = sums + y * stride + x, *low = high + side * stride;
			uint32_t count = low[side] - low[0] - high[side] + high[0];
			if (count <= most)
				continue;
			most = count;
			sheet->left = (uint32_t)x;
			sheet->top = (uint32_t)y;
		}
	free(sums);
	return true;
}

/* x to the right, y down. */
static void paint(struct sheet *sheet, size_t x, size_t y, const uint8_t rgb[3])
{
	size_t row = sheet->picture.height - 1 - y;
	memcpy(&sheet->picture.rgba[4 * (row * sheet->picture.width + x)], rgb, 3);
}

static void paint_character(struct sheet *sheet, size_t x, size_t y, char c)
{
	const uint8_t *rows = glyph_rows(c);
	y += ZOOM * (size_t)glyph_drop(c);
	for (size_t v = 0; v < ZOOM * GLYPH_HEIGHT; v++)
		for (size_t u = 0; u < ZOOM * GLYPH_WIDTH; u++)
			if (rows[v / ZOOM] >> (GLYPH_WIDTH - 1 - u / ZOOM) & 1)
				paint(sheet, x + u, y + v, ink);
}

/* What does not fit into the cell's width is left out. */
static void paint_text(struct sheet *sheet, size_t x, size_t y, const char *text)
{
	const size_t advance = ZOOM * (GLYPH_WIDTH + 1);
	for (size_t end = x + CELL; *text != '\0' && x + advance <= end; text++, x += advance)
		paint_character(sheet, x, y, *text);
}

/* The corner of a cell: column 0 is the reference's, row 1 the lower one. */
static size_t cell_x(size_t column)
{
	return GUTTER + column * (CELL + GUTTER);
}

static size_t cell_y(size_t band, size_t row)
{
	return GUTTER + band * BAND + HEAD + row * (CELL + GUTTER);
}

static void paint_head(
	struct sheet *sheet, size_t column, size_t band, const char *name, const char *note)
{
	size_t y = cell_y(band, 0) - HEAD;
	paint_text(sheet, cell_x(column), y, name);
	paint_text(sheet, cell_x(column), y + LINE, note);
}

/* The part of a picture, and below it its difference from the reference or, for the reference
 * itself, nothing. */
static void paint_part(struct sheet *sheet, size_t column, size_t band, const float *visibility)
{
	size_t left = cell_x(column), top = cell_y(band, 0), below = cell_y(band, 1);
	for (size_t y = 0; y < ZOOM * sheet->side; y++)
		for (size_t x = 0; x < ZOOM * sheet->side; x++) {
			size_t from =
				(sheet->top + y / ZOOM) * sheet->width + sheet->left + x / ZOOM;
			float truth = sheet->reference[from], seen = visibility[from];
			uint8_t rgb[3];
			if (isnan(truth) || isnan(seen))
				continue;
			difference_grey(seen, rgb);
			paint(sheet, left + x, top + y, rgb);
			if (visibility == sheet->reference)
				continue;
			difference_color(seen - truth, rgb);
			paint(sheet, left + x, below + y, rgb);
		}
}

/* Whether a point of the whole picture, in its pixels, is on the frame of the part, `thickness`
 * thick. */
static bool is_on_frame(const struct sheet *sheet, double x, double y, double thickness)
{
	double u = x - sheet->left, v = y - sheet->top, side = sheet->side;
	bool inside = u >= 0 && v >= 0 && u < side && v < side;
	return inside &&
	       (u < thickness || v < thickness || u >= side - thickness || v >= side - thickness);
}

/* The whole reference, as large as a cell allows, with the part framed. */
static void paint_whole(struct sheet *sheet, size_t band)
{
	uint32_t longer = sheet->width > sheet->height ? sheet->width : sheet->height;
	double step = longer / (double)CELL;
	for (size_t y = 0; (double)y * step + step / 2 < sheet->height; y++)
		for (size_t x = 0; (double)x * step + step / 2 < sheet->width; x++) {
			double u = ((double)x + 0.5) * step, v = ((double)y + 0.5) * step;
			float truth = sheet->reference[(size_t)v * sheet->width + (size_t)u];
			uint8_t rgb[3];
			if (is_on_frame(sheet, u, v, 2 * step))
				memcpy(rgb, frame_color, sizeof(rgb));
			else if (isnan(truth))
				continue;
			else
				difference_grey(truth, rgb);
			paint(sheet, cell_x(0) + x, cell_y(band, 1) + y, rgb);
		}
}

static bool make_picture(struct sheet *sheet, struct sm_error *error)
{
	size_t bands = (sheet->count + SHEET_COLUMNS - 1) / SHEET_COLUMNS;
	size_t width = cell_x(1 + smaller(sheet->count, SHEET_COLUMNS));
	if (bands > UINT32_MAX / (2 * BAND))
		return error_no_memory(error);
	struct picture *picture = &sheet->picture;
	picture->width = (uint32_t)width;
	picture->height = (uint32_t)(GUTTER + bands * BAND);
	picture->rgba = array_alloc(picture->height, 4 * width);
	if (picture->rgba == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < width * picture->height; i++) {
		memcpy(&picture->rgba[4 * i], background, 3);
		picture->rgba[4 * i + 3] = 255;
	}
	for (size_t band = 0; band < bands; band++) {
		paint_head(sheet, 0, band, "reference", "");
		paint_part(sheet, 0, band, sheet->reference);
		paint_whole(sheet, band);
	}
	return true;
}

bool sheet_init(struct sheet *sheet, const float *reference, uint32_t width, uint32_t height,
	size_t count, struct sm_error *error)
{
	assert(count > 0 && width > 0 && height > 0);
	*sheet = (struct sheet){
		.reference = reference, .width = width, .height = height, .count = count};
	sheet->side = (uint32_t)smaller(smaller(width, height), PART);
	return find_part(sheet, error) && make_picture(sheet, error);
}

void sheet_add(struct sheet *sheet, const char *name, const char *note, const float *visibility)
{
	assert(sheet->added < sheet->count);
	size_t column = 1 + sheet->added % SHEET_COLUMNS, band = sheet->added / SHEET_COLUMNS;
	paint_head(sheet, column, band, name, note);
	paint_part(sheet, column, band, visibility);
	sheet->added++;
}

void sheet_finish(struct sheet *sheet)
{
	difference_finish(&sheet->picture);
	*sheet = (struct sheet){0};
}
