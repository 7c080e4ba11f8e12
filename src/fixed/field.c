/* SPDX-License-Identifier: MIT */
#include "fixed/field.h"
#include <math.h>
#include <stdlib.h>

/* Corners move by up to half a subpixel. On what is thinner a plane may rise far beyond all that
 * the polygon has: values are allowed to leave its range by this share of it. */
#define OVERSHOOT 0.25

/* x / w, y / w of three corners from a place, in homogeneous coordinates. */
struct basis {
	double cofactors[3][3], det;
};

/* Whatever is linear in clip space is affine on the screen when divided by w: the three
 * coefficients solve a system of the corners' x, y and w (Olano & Greer 1997). From a place nearby
 * small differences keep their digits. */
static bool basis_init(struct basis *basis, const double *const clip[3], const double place[2])
{
	double rows[3][3];
	for (int i = 0; i < 3; i++) {
		rows[i][0] = clip[i][0] - place[0] * clip[i][3];
		rows[i][1] = clip[i][1] - place[1] * clip[i][3];
		rows[i][2] = clip[i][3];
	}
	for (int i = 0; i < 3; i++) {
		const double *p = rows[(i + 1) % 3], *q = rows[(i + 2) % 3];
		basis->cofactors[i][0] = p[1] * q[2] - p[2] * q[1];
		basis->cofactors[i][1] = p[2] * q[0] - p[0] * q[2];
		basis->cofactors[i][2] = p[0] * q[1] - p[1] * q[0];
	}
	basis->det = rows[0][0] * basis->cofactors[0][0] + rows[0][1] * basis->cofactors[0][1] +
		     rows[0][2] * basis->cofactors[0][2];
	return basis->det != 0.0;
}

static bool basis_slope(const struct basis *basis, const double q[3], double slope[2])
{
	for (int axis = 0; axis < 2; axis++) {
		double sum = 0.0;
		for (int i = 0; i < 3; i++)
			sum += q[i] * basis->cofactors[i][axis];
		slope[axis] = sum / basis->det;
	}
	return isfinite(slope[0]) && isfinite(slope[1]);
}

int field_slope(const double *const clip[3], const double q[3], double slope[2])
{
	static const double middle[2] = {0.0, 0.0};
	struct basis basis;
	if (!basis_init(&basis, clip, middle) || !basis_slope(&basis, q, slope))
		return 0;
	return basis.det > 0.0 ? 1 : -1;
}

/* Of a quad, the three corners that leave out the one that adds least. */
static void largest_triangle(const struct polygon *polygon, int corners[3])
{
	static const int choices[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
	double most = -1.0;
	for (int i = 0; i < (polygon->count > 3 ? 4 : 1); i++) {
		struct basis basis;
		const double *clip[3];
		for (int c = 0; c < 3; c++)
			clip[c] = polygon->corners[choices[i][c]].clip;
		basis_init(&basis, clip, (const double[2]){0.0, 0.0});
		if (!(fabs(basis.det) > most))
			continue;
		most = fabs(basis.det);
		for (int c = 0; c < 3; c++)
			corners[c] = choices[i][c];
	}
}

/* From the clipped polygon: its corners on the grid, and the middle of where they were. */
static void place(
	struct field *field, const struct polygon *clipped, const struct fixed_screen *screen)
{
	const int32_t size[2] = {screen->width, screen->height};
	field->outline.count = clipped->count;
	for (int axis = 0; axis < 2; axis++) {
		double sum = 0.0;
		for (int i = 0; i < clipped->count; i++) {
			const double *clip = clipped->corners[i].clip;
			double p = (clip[axis] / clip[3] + 1.0) * 0.5 * size[axis];
			p = fmin(fmax(p, 0.0), size[axis]);
			field->outline.corners[i][axis] = (int32_t)floor(p * FIXED_SUBPIXELS + 0.5);
			sum += p;
		}
		field->center[axis] = sum / clipped->count;
	}
}

static bool find_slopes(
	struct field *field, const struct polygon *polygon, const struct fixed_screen *screen)
{
	const double size[2] = {screen->width, screen->height};
	const double middle[2] = {
		2.0 * field->center[0] / size[0] - 1.0, 2.0 * field->center[1] / size[1] - 1.0};
	int corners[3] = {0, 1, 2};
	const double *clip[3];
	struct basis basis;
	largest_triangle(polygon, corners);
	for (int i = 0; i < 3; i++)
		clip[i] = polygon->corners[corners[i]].clip;
	if (!basis_init(&basis, clip, middle))
		return false;
	field->ccw = basis.det > 0.0;
	for (int value = 0; value < field->count; value++) {
		double q[3];
		for (int i = 0; i < 3; i++)
			q[i] = polygon->corners[corners[i]].values[value];
		if (!basis_slope(&basis, q, field->slope[value]))
			return false;
		for (int axis = 0; axis < 2; axis++)
			field->slope[value][axis] *= 2.0 / size[axis];
	}
	return true;
}

static double value_at(const struct field *field, int value, double x, double y)
{
	return field->at[value] + field->slope[value][0] * (x - field->center[0]) +
	       field->slope[value][1] * (y - field->center[1]);
}

static double value_at_corner(const struct field *field, int value, int corner)
{
	const int32_t *p = field->outline.corners[corner];
	return value_at(
		field, value, (double)p[0] / FIXED_SUBPIXELS, (double)p[1] / FIXED_SUBPIXELS);
}

struct range {
	double low, high;
};

/* Of a value over the clipped corners; also sets its mean, which is that in their middle. */
static struct range find_range(struct field *field, const struct polygon *clipped, int value)
{
	struct range range = {HUGE_VAL, -HUGE_VAL};
	double sum = 0.0;
	for (int i = 0; i < clipped->count; i++) {
		double v = clipped->corners[i].values[value] / clipped->corners[i].clip[3];
		range.low = fmin(range.low, v);
		range.high = fmax(range.high, v);
		sum += v;
	}
	field->at[value] = fmin(fmax(sum / clipped->count, range.low), range.high);
	return range;
}

/* By how much the slopes of a value have to be less for it not to leave its range by more than the
 * overshoot. */
static double share_of(const struct field *field, int value, struct range range)
{
	double share = 1.0, middle = field->at[value];
	double slack = OVERSHOOT * (range.high - range.low);
	/* Rounding is no rise: of what is the same everywhere, say. */
	double least = 1e-12 * fmax(fabs(range.low), fabs(range.high));
	for (int i = 0; i < field->outline.count; i++) {
		double rise = value_at_corner(field, value, i) - middle;
		double limit = rise < 0.0 ? middle - range.low : range.high - middle;
		if (fabs(rise) > limit + slack + least)
			share = fmin(share, (limit + slack) / fabs(rise));
	}
	return share;
}

/* The same for all values, which together are those of a place on the plane. */
static double find_share(const struct field *field, const struct range *ranges)
{
	double share = 1.0;
	for (int value = 0; value < field->count; value++)
		share = fmin(share, share_of(field, value, ranges[value]));
	return share;
}

/* The corners of the largest triangle on the grid; its area, doubled. */
static int64_t largest_on_grid(const struct outline *outline, int corners[3])
{
	int64_t most = 0;
	for (int i = 1; i < outline->count; i++)
		for (int j = i + 1; j < outline->count; j++) {
			int64_t area = outline_turn(outline, 0, i, j);
			if (llabs(area) <= llabs(most))
				continue;
			most = area;
			corners[1] = i;
			corners[2] = j;
		}
	return most;
}

/* Slopes of the largest triangle as the corners are on the grid: it keeps to its range. */
static bool fit_to_grid(struct field *field, const struct polygon *clipped)
{
	int corners[3] = {0};
	double area = (double)largest_on_grid(&field->outline, corners) / FIXED_SUBPIXELS;
	const int32_t *a = field->outline.corners[corners[0]];
	const int32_t *b = field->outline.corners[corners[1]];
	const int32_t *c = field->outline.corners[corners[2]];
	if (area == 0.0)
		return false;
	for (int axis = 0; axis < 2; axis++)
		field->center[axis] = (a[axis] + b[axis] + c[axis]) / (3.0 * FIXED_SUBPIXELS);
	for (int value = 0; value < field->count; value++) {
		double v[3];
		for (int i = 0; i < 3; i++) {
			const struct polygon_corner *corner = &clipped->corners[corners[i]];
			v[i] = corner->values[value] / corner->clip[3];
		}
		double to_b = v[1] - v[0], to_c = v[2] - v[0];
		field->at[value] = (v[0] + v[1] + v[2]) / 3.0;
		field->slope[value][0] = (to_b * (c[1] - a[1]) - to_c * (b[1] - a[1])) / area;
		field->slope[value][1] = (to_c * (b[0] - a[0]) - to_b * (c[0] - a[0])) / area;
	}
	return true;
}

/* Makes slopes less where they must be. */
static bool limit_slopes(struct field *field, const struct polygon *clipped)
{
	struct range ranges[POLYGON_VALUES] = {{0}};
	for (int value = 0; value < field->count; value++) {
		ranges[value] = find_range(field, clipped, value);
		if (!isfinite(ranges[value].high - ranges[value].low))
			return false;
	}
	if (find_share(field, ranges) == 1.0)
		return true;
	if (!fit_to_grid(field, clipped))
		return false;
	double share = find_share(field, ranges);
	for (int value = 0; value < field->count; value++)
		for (int axis = 0; axis < 2; axis++)
			field->slope[value][axis] *= share;
	return true;
}

static void find_most(struct field *field)
{
	for (int value = 0; value < field->count; value++) {
		field->most[value] = 0.0;
		for (int i = 0; i < field->outline.count; i++)
			field->most[value] =
				fmax(field->most[value], fabs(value_at_corner(field, value, i)));
	}
}

bool field_init(struct field *field, const struct polygon *polygon, int count,
	const struct fixed_screen *screen)
{
	struct polygon clipped;
	field->count = count;
	polygon_copy(&clipped, polygon);
	if (!polygon_clip(&clipped))
		return false;
	place(field, &clipped, screen);
	if (!outline_has_pixels(&field->outline, screen) || !find_slopes(field, polygon, screen) ||
		!limit_slopes(field, &clipped))
		return false;
	find_most(field);
	return true;
}

static void middle_of(const struct fixed_cover *cover, int32_t pixel[2])
{
	for (int axis = 0; axis < 2; axis++)
		pixel[axis] = (cover->rect[axis] + cover->rect[2 + axis]) / 2;
}

double field_middle(const struct field *field, int value, const struct fixed_cover *cover)
{
	int32_t pixel[2];
	middle_of(cover, pixel);
	return value_at(field, value, pixel[0] + 0.5, pixel[1] + 0.5);
}

/* Of a value in a cover, at most. */
static double most_in(const struct field *field, int value, const struct fixed_cover *cover)
{
	double most = 0.0;
	for (int corner = 0; corner < 4; corner++) {
		double x = cover->rect[corner & 1 ? 2 : 0], y = cover->rect[corner & 2 ? 3 : 1];
		most = fmax(most, fabs(value_at(field, value, x, y)));
	}
	return fmin(most, field->most[value]);
}

double field_scale(
	const struct field *field, int first, int count, int bits, const struct fixed_cover *cover)
{
	double most = 0.0;
	int exponent;
	for (int value = first; value < first + count; value++)
		most = fmax(most, most_in(field, value, cover));
	/* A little more, for what planes are rounded by. */
	frexp(most * 1.0001, &exponent);
	return ldexp(1.0, bits - exponent);
}

/* Modulo 2^32. Beyond 2^62 nothing is left of the bits below that, so that any will do. */
static int32_t low_bits(double value)
{
	double limited = fmin(fmax(floor(value + 0.5), -0x1p62), 0x1p62);
	return (int32_t)(uint32_t)(uint64_t)(int64_t)limited;
}

struct fixed_plane field_plane(
	const struct field *field, int value, double scale, const struct fixed_cover *cover)
{
	int32_t pixel[2];
	middle_of(cover, pixel);
	struct fixed_plane plane = {
		.dx = low_bits(field->slope[value][0] * scale),
		.dy = low_bits(field->slope[value][1] * scale),
	};
	uint32_t at = (uint32_t)low_bits(field_middle(field, value, cover) * scale);
	at -= (uint32_t)plane.dx * (uint32_t)pixel[0] + (uint32_t)plane.dy * (uint32_t)pixel[1];
	plane.at = (int32_t)at;
	return plane;
}
