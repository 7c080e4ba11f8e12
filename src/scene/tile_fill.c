/* SPDX-License-Identifier: MIT */
#include "scene/tile_fill.h"
#include "base/float4.h"
#include "base/float_range.h"

/* Of a triangle cut by a plane. */
#define CORNERS_MAX 4

/* A triangle over no more tiles than these fills the box around it, which is quicker. */
#define SMALL_TILES 16

/* Depths of a polygon's plane: at the origin, and what a tile to the right and one up add. */
struct plane {
	float origin, dx, dy;
};

static void set_point(struct tile_point *point, const struct tile_fill *fill, float4 clip)
{
	float scale = 0.5f / clip[3], tiles = (float)fill->tiles;
	point->x = (0.5f + clip[0] * scale) * tiles;
	point->y = (0.5f + clip[1] * scale) * tiles;
	point->depth = 0.5f + clip[2] * scale;
	point->beyond = clip[2] + clip[3] >= 0.0f ? 1.0f : -1.0f;
}

void tile_vertex_set(struct tile_vertex *vertex, const struct tile_fill *fill, mat4 to_clip,
	const float position[3])
{
	float4 clip = load4(to_clip[3]) + load4(to_clip[2]) * position[2];
	clip = clip + load4(to_clip[1]) * position[1];
	clip = clip + load4(to_clip[0]) * position[0];
	store4(vertex->clip, clip);
	set_point(&vertex->point, fill, clip);
}

/* The tile that a coordinate is in, or the nearest: from -1 to tiles, that of no number -1. What is
 * rounded is far less than any margin. */
static int tile_at(const struct tile_fill *fill, float coordinate)
{
	return (int)(larger(-1.0f, smaller(coordinate, (float)fill->tiles)) + 1.0f) - 1;
}

/* Without a branch, which would go either way at each tile. */
static void raise_to(float *value, float depth)
{
	*value = larger(depth, *value);
}

/* Tiles [first, last] of a row. */
static void fill_row(const struct tile_fill *fill, int row, int first, int last, float depth)
{
	float *values = &fill->values[(size_t)row * fill->tiles];
	for (int x = first; x <= last; x++)
		raise_to(&values[x], depth);
}

static int largest(int a, int b)
{
	return a > b ? a : b;
}

static int smallest(int a, int b)
{
	return a < b ? a : b;
}

/* The range of tiles that touch [low, high] grown by the margin; false where it is empty. */
static bool tile_range(const struct tile_fill *fill, float low, float high, int *first, int *last)
{
	*first = largest(tile_at(fill, low - fill->margin), 0);
	*last = smallest(tile_at(fill, high + fill->margin), (int)fill->tiles - 1);
	return *first <= *last;
}

/* Around points as they are stored. */
struct bounds {
	float4 low, high;
};

static const struct bounds no_bounds = {
	{INFINITY, INFINITY, 1.0f, INFINITY}, {-INFINITY, -INFINITY, 0.0f, -INFINITY}};

static inline void widen(struct bounds *bounds, const struct tile_point *by)
{
	float4 point = load4(&by->x);
	bounds->low = smaller4(point, bounds->low);
	bounds->high = larger4(point, bounds->high);
}

/* What is covered: tiles, and the largest depth. */
struct cover {
	int left, right, bottom, top; /* up to and with these */
	float depth;
};

/* The tiles that touch what is within bounds, grown by the margin; false where there are none. */
static inline bool cover_bounds(
	const struct tile_fill *fill, const struct bounds *bounds, struct cover *cover)
{
	float4 low = bounds->low, high = bounds->high;
	cover->depth = smaller(high[2], 1.0f);
	return tile_range(fill, low[0], high[0], &cover->left, &cover->right) &&
	       tile_range(fill, low[1], high[1], &cover->bottom, &cover->top);
}

static bool cover_box(const struct tile_fill *fill, mat4 to_clip, const float min[3],
	const float max[3], struct cover *cover)
{
	struct bounds bounds = no_bounds;
	for (int i = 0; i < 8; i++) {
		const float p[3] = {
			i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1], i & 4 ? max[2] : min[2]};
		struct tile_vertex corner;
		tile_vertex_set(&corner, fill, to_clip, p);
		if (!(corner.clip[2] >= -corner.clip[3]) || !(corner.clip[3] > 0.0f)) {
			int last = (int)fill->tiles - 1;
			*cover = (struct cover){0, last, 0, last, 1.0f};
			return true;
		}
		widen(&bounds, &corner.point);
	}
	return cover_bounds(fill, &bounds, cover);
}

static void fill_cover(const struct tile_fill *fill, const struct cover *cover)
{
	for (int row = cover->bottom; row <= cover->top; row++)
		fill_row(fill, row, cover->left, cover->right, cover->depth);
}

void tile_fill_box(
	const struct tile_fill *fill, mat4 to_clip, const float min[3], const float max[3])
{
	struct cover cover;
	if (cover_box(fill, to_clip, min, max, &cover))
		fill_cover(fill, &cover);
}

bool tile_fill_has_box(
	const struct tile_fill *fill, mat4 to_clip, const float min[3], const float max[3])
{
	struct cover cover;
	if (!cover_box(fill, to_clip, min, max, &cover))
		return true;
	for (int row = cover.bottom; row <= cover.top; row++) {
		const float *values = &fill->values[(size_t)row * fill->tiles];
		for (int x = cover.left; x <= cover.right; x++)
			if (values[x] < cover.depth)
				return false;
	}
	return true;
}

/* What of a triangle is beyond the near plane (Sutherland & Hodgman 1974). */
static int clip_near(const struct tile_fill *fill, const struct tile_vertex *const corners[3],
	struct tile_point clipped[CORNERS_MAX])
{
	int count = 0;
	for (int k = 0; k < 3; k++) {
		const struct tile_vertex *p = corners[k], *q = corners[(k + 1) % 3];
		float inside_p = p->clip[2] + p->clip[3], inside_q = q->clip[2] + q->clip[3];
		if (inside_p >= 0.0f)
			clipped[count++] = p->point;
		if ((inside_p >= 0.0f) == (inside_q >= 0.0f))
			continue;
		vec4 cut;
		glm_vec4_lerp(
			(float *)p->clip, (float *)q->clip, inside_p / (inside_p - inside_q), cut);
		set_point(&clipped[count++], fill, load4(cut));
	}
	return count;
}

/* Without a plane where the first three corners hardly span one. */
static bool find_plane(const struct tile_point *corners, struct plane *plane)
{
	double ux = (double)corners[1].x - corners[0].x, uy = (double)corners[1].y - corners[0].y;
	double vx = (double)corners[2].x - corners[0].x, vy = (double)corners[2].y - corners[0].y;
	double ud = (double)corners[1].depth - corners[0].depth;
	double vd = (double)corners[2].depth - corners[0].depth;
	double area = ux * vy - uy * vx;
	if (!(fabs(area) > 1e-6 * (fabs(ux * vy) + fabs(uy * vx))))
		return false;
	double dx = (ud * vy - vd * uy) / area, dy = (ux * vd - vx * ud) / area;
	*plane = (struct plane){(float)(corners[0].depth - dx * corners[0].x - dy * corners[0].y),
		(float)dx, (float)dy};
	return true;
}

/* Widens [*low, *high] to the x of the part of a side that is between y = bottom and y = top. */
static void widen_by_side(const struct tile_point *a, const struct tile_point *b, float bottom,
	float top, float *low, float *high)
{
	const struct tile_point *lower = a->y < b->y ? a : b, *upper = lower == a ? b : a;
	if (lower->y > top || upper->y < bottom)
		return;
	float rise = upper->y - lower->y, run = upper->x - lower->x;
	float from = lower->x, to = upper->x;
	if (lower->y < bottom)
		from += run * ((bottom - lower->y) / rise);
	if (upper->y > top)
		to = lower->x + run * ((top - lower->y) / rise);
	*low = smaller(smaller(from, to), *low);
	*high = larger(larger(from, to), *high);
}

static void fill_polygon_row(const struct tile_fill *fill, const struct tile_point *corners,
	int count, int row, const struct plane *plane, float deepest)
{
	float low = INFINITY, high = -INFINITY;
	float bottom = (float)row - fill->margin, top = (float)(row + 1) + fill->margin;
	for (int k = 0; k < count; k++)
		widen_by_side(&corners[k], &corners[(k + 1) % count], bottom, top, &low, &high);
	int first, last;
	if (!tile_range(fill, low, high, &first, &last))
		return;
	if (plane == NULL) {
		fill_row(fill, row, first, last, deepest);
		return;
	}
	/* At the deepest corner of each tile. */
	float slack = (0.5f + fill->margin) * (fabsf(plane->dx) + fabsf(plane->dy)) +
		      1e-6f * (1.0f + fabsf(plane->origin));
	float depth = plane->origin + plane->dy * ((float)row + 0.5f) + slack;
	float *values = &fill->values[(size_t)row * fill->tiles];
	for (int x = first; x <= last; x++)
		raise_to(&values[x], smaller(deepest, depth + plane->dx * ((float)x + 0.5f)));
}

/* Row by row, as deep as the polygon's plane is in each tile. */
static void fill_polygon(const struct tile_fill *fill, const struct tile_point *corners, int count,
	const struct cover *cover)
{
	struct plane plane;
	bool has_plane = find_plane(corners, &plane);
	for (int row = cover->bottom; row <= cover->top; row++)
		fill_polygon_row(
			fill, corners, count, row, has_plane ? &plane : NULL, cover->depth);
}

void tile_fill_triangle(
	const struct tile_fill *fill, const struct tile_vertex *vertices, const uint32_t corners[3])
{
	struct tile_point clipped[CORNERS_MAX];
	const struct tile_vertex *of[3];
	bool beyond = true;
	for (int k = 0; k < 3; k++) {
		of[k] = &vertices[corners[k]];
		clipped[k] = of[k]->point;
		beyond = beyond && of[k]->point.beyond > 0.0f;
	}
	int count = beyond ? 3 : clip_near(fill, of, clipped);
	struct bounds bounds = no_bounds;
	for (int k = 0; k < count; k++)
		widen(&bounds, &clipped[k]);
	struct cover cover;
	if (!cover_bounds(fill, &bounds, &cover))
		return;
	if ((cover.right - cover.left + 1) * (cover.top - cover.bottom + 1) <= SMALL_TILES)
		fill_cover(fill, &cover);
	else
		fill_polygon(fill, clipped, count, &cover);
}
