/* SPDX-License-Identifier: MIT */
#include "model/raster.h"
#include <math.h>
#include <stdint.h>
#include <string.h>

#define SUBPIXELS 256

/* Triangles are cut at so many times the viewport, so that edge functions stay within 64 bits:
 * 2^15 pixels of 2^8 steps, twice, squared. */
#define GUARD 2.0

/* Three corners, and one for each plane that cuts. */
#define CORNERS_MAX 9

struct polygon {
	double corners[CORNERS_MAX][4];
	int count;
};

/* The half-spaces p . plane >= 0 of clip space that are drawn. */
static const double planes[][4] = {
	{0, 0, 1, 1},
	{0, 0, -1, 1},
	{1, 0, 0, GUARD},
	{-1, 0, 0, GUARD},
	{0, 1, 0, GUARD},
	{0, -1, 0, GUARD},
};

static double inside_by(const double corner[4], const double plane[4])
{
	double sum = 0.0;
	for (int i = 0; i < 4; i++)
		sum += corner[i] * plane[i];
	return sum;
}

/* Sutherland & Hodgman 1974. From the corner inside, so that triangles that share an edge cut it at
 * the same place. */
static void add_cut(
	struct polygon *kept, const double in[4], const double out[4], double in_by, double out_by)
{
	double t = in_by / (in_by - out_by); /* in_by >= 0 > out_by */
	double *corner = kept->corners[kept->count++];
	for (int i = 0; i < 4; i++)
		corner[i] = in[i] + t * (out[i] - in[i]);
}

static void cut(struct polygon *polygon, const double plane[4])
{
	struct polygon kept = {.count = 0};
	for (int i = 0; i < polygon->count; i++) {
		const double *p = polygon->corners[i];
		const double *q = polygon->corners[(i + 1) % polygon->count];
		double p_by = inside_by(p, plane), q_by = inside_by(q, plane);
		/* Rounding may have left one that is not convex. */
		if (kept.count > CORNERS_MAX - 2)
			break;
		if (p_by >= 0.0)
			memcpy(kept.corners[kept.count++], p, sizeof(kept.corners[0]));
		if (p_by >= 0.0 && q_by < 0.0)
			add_cut(&kept, p, q, p_by, q_by);
		else if (p_by < 0.0 && q_by >= 0.0)
			add_cut(&kept, q, p, q_by, p_by);
	}
	*polygon = kept;
}

/* A plane over normalised device coordinates, x row[0] + y row[1] + row[2], over pixels. */
static struct raster_plane over_pixels(const struct raster_area *area, const double row[3])
{
	double dx = 2.0 * row[0] / area->width, dy = 2.0 * row[1] / area->height;
	return (struct raster_plane){row[2] - row[0] - row[1] + (dx + dy) / 2.0, dx, dy};
}

/* Of homogeneous corners, whatever their w: the inverse of the matrix of their x, y and w (Olano &
 * Greer 1997). False for a triangle that is seen edge on. */
static bool set_up(struct raster_triangle *triangle, const struct raster_area *area,
	const double corners[3][4])
{
	double rows[3][3], depth[3] = {0.0, 0.0, 0.0}, determinant = 0.0;
	for (int i = 0; i < 3; i++) {
		const double *p = corners[(i + 1) % 3], *q = corners[(i + 2) % 3];
		rows[i][0] = p[1] * q[3] - p[3] * q[1];
		rows[i][1] = p[3] * q[0] - p[0] * q[3];
		rows[i][2] = p[0] * q[1] - p[1] * q[0];
	}
	determinant = corners[0][0] * rows[0][0] + corners[0][1] * rows[0][1] +
		      corners[0][3] * rows[0][2];
	if (!isfinite(determinant) || !isfinite(1.0 / determinant))
		return false;
	for (int i = 0; i < 3; i++) {
		for (int j = 0; j < 3; j++) {
			rows[i][j] /= determinant;
			depth[j] += 0.5 * corners[i][2] * rows[i][j];
		}
		triangle->weights[i] = over_pixels(area, rows[i]);
	}
	depth[2] += 0.5;
	triangle->depth = over_pixels(area, depth);
	triangle->front = determinant > 0.0;
	return true;
}

struct point {
	int64_t x, y; /* 1 / SUBPIXELS of a pixel, from the middle of pixel (0, 0) */
};

static int64_t snap(double position, double w, int pixels)
{
	return llrint((position / w * 0.5 + 0.5) * pixels * SUBPIXELS) - SUBPIXELS / 2;
}

/* Counter-clockwise. Returns the number of corners, 0 if one has no place on the screen. */
static int snap_corners(const struct raster_area *area, const struct polygon *polygon, bool front,
	struct point points[CORNERS_MAX])
{
	for (int i = 0; i < polygon->count; i++) {
		const double *p = polygon->corners[front ? i : polygon->count - 1 - i];
		if (!(p[3] > 0.0))
			return 0;
		points[i] = (struct point){
			snap(p[0], p[3], area->width), snap(p[1], p[3], area->height)};
	}
	return polygon->count;
}

static int64_t floor_divide(int64_t a, int64_t b)
{
	int64_t quotient = a / b;
	return quotient - (a % b != 0 && (a < 0) != (b < 0));
}

/* Narrows the pixels first <= x < end of a row to those on the inner side of an edge. */
static void narrow(struct point a, struct point b, int row, int64_t *first, int64_t *end)
{
	int64_t dx = b.x - a.x, dy = b.y - a.y;
	bool kept = dy < 0 || (dy == 0 && dx < 0); /* a left or upper edge */
	/* Inside: at - slope x >= 0. */
	int64_t slope = dy * SUBPIXELS;
	int64_t at = dx * ((int64_t)row * SUBPIXELS - a.y) + dy * a.x - (kept ? 0 : 1);
	if (slope == 0) {
		if (at < 0)
			*end = *first;
		return;
	}
	int64_t last = floor_divide(at, slope);
	if (slope > 0 && last + 1 < *end)
		*end = last + 1;
	/* x >= at / slope, rounded up. */
	if (slope < 0 && -floor_divide(at, -slope) > *first)
		*first = -floor_divide(at, -slope);
}

static double plane_at(const struct raster_plane *plane, int x, int y)
{
	return plane->at + plane->dx * x + plane->dy * y;
}

static double depth_at(const struct raster_triangle *triangle, int x, int y)
{
	return fmin(fmax(plane_at(&triangle->depth, x, y), 0.0), 1.0);
}

/* The pixels of a row within all sides of a polygon: first <= x < end. */
static void find_span(const struct point *points, int count, int row, int64_t *first, int64_t *end)
{
	for (int i = 0; i < count && *first < *end; i++)
		narrow(points[i], points[(i + 1) % count], row, first, end);
}

/* First and last row that a polygon may have pixels in. */
static void find_rows(const struct point *points, int count, int64_t *bottom, int64_t *top)
{
	*bottom = *top = points[0].y;
	for (int i = 1; i < count; i++) {
		*bottom = points[i].y < *bottom ? points[i].y : *bottom;
		*top = points[i].y > *top ? points[i].y : *top;
	}
	*bottom = floor_divide(*bottom, SUBPIXELS);
	*top = floor_divide(*top, SUBPIXELS);
}

static void fill(const struct raster_area *area, const struct raster_triangle *triangle,
	const struct point *points, int count, raster_fragment fragment, void *data)
{
	int64_t bottom, top;
	find_rows(points, count, &bottom, &top);
	int y = bottom > area->min[1] ? (int)bottom : area->min[1];
	for (; y <= top && y < area->max[1]; y++) {
		int64_t first = area->min[0], end = area->max[0];
		find_span(points, count, y, &first, &end);
		for (int x = (int)first; x < end; x++)
			fragment(data, triangle, x, y, depth_at(triangle, x, y));
	}
}

static bool is_beside(const double corners[3][4])
{
	for (int axis = 0; axis < 3; axis++)
		for (int sign = -1; sign <= 1; sign += 2) {
			int count = 0;
			for (int i = 0; i < 3; i++)
				count += sign * corners[i][axis] > corners[i][3];
			if (count == 3)
				return true;
		}
	return false;
}

/* Also of corners behind the eye, where their lines meet the screen. */
static void move_to_grid(const struct raster_area *area, double corners[3][4])
{
	for (int i = 0; i < 3; i++)
		for (int axis = 0; axis < 2; axis++) {
			double w = corners[i][3];
			double steps =
				ldexp(axis == 0 ? area->width : area->height, area->snap_bits - 1);
			/* NDC 0 is on the grid, which bits >= 1 make of an odd size too. */
			if (w != 0.0)
				corners[i][axis] = rint(corners[i][axis] / w * steps) / steps * w;
		}
}

/* moved: the corners that coverage is of, and all that does not stay. */
static void draw(const struct raster_area *area, const double corners[3][4],
	const double moved[3][4], raster_fragment fragment, void *data)
{
	struct raster_triangle triangle, still;
	if (!set_up(&triangle, area, moved) || !set_up(&still, area, corners))
		return;
	if (area->kept != RASTER_ALL && triangle.front != (area->kept == RASTER_FRONT))
		return;
	if (area->weights_stay)
		memcpy(triangle.weights, still.weights, sizeof(triangle.weights));
	if (area->depth_stays)
		triangle.depth = still.depth;
	struct polygon polygon = {.count = 3};
	memcpy(polygon.corners, moved, 3 * sizeof(polygon.corners[0]));
	for (size_t i = 0; i < sizeof(planes) / sizeof(planes[0]) && polygon.count > 0; i++)
		cut(&polygon, planes[i]);
	struct point points[CORNERS_MAX];
	int count = snap_corners(area, &polygon, triangle.front, points);
	if (count > 2)
		fill(area, &triangle, points, count, fragment, data);
}

void raster_draw(const struct raster_area *area, const double corners[3][4],
	raster_fragment fragment, void *data)
{
	double moved[3][4];
	if (is_beside(corners))
		return;
	memcpy(moved, corners, sizeof(moved));
	if (area->snap_bits > 0)
		move_to_grid(area, moved);
	draw(area, corners, (const double(*)[4])moved, fragment, data);
}

void raster_weights(const struct raster_triangle *triangle, int x, int y, double weights[3])
{
	double sum = 0.0;
	for (int i = 0; i < 3; i++) {
		weights[i] = plane_at(&triangle->weights[i], x, y);
		sum += weights[i];
	}
	/* The sum is 1 / w: above 0 in front of the near plane. */
	for (int i = 0; i < 3; i++)
		weights[i] /= sum;
}
