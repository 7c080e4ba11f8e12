/* SPDX-License-Identifier: MIT */
#include "fixed/polygon.h"
#include <math.h>
#include <string.h>

void polygon_copy(struct polygon *copy, const struct polygon *polygon)
{
	copy->count = polygon->count;
	memcpy(copy->corners, polygon->corners, (size_t)polygon->count * sizeof(*copy->corners));
}

/* How far inside one side a corner is, times something above 0. */
static double inside_by(const struct polygon_corner *corner, int axis, double sign)
{
	return corner->clip[3] - sign * corner->clip[axis];
}

/* Always from inside to outside, so that the edge's direction makes no difference. */
static void cut_edge(const struct polygon_corner *in, const struct polygon_corner *out, double t,
	struct polygon_corner *cut)
{
	for (int i = 0; i < 4; i++)
		cut->clip[i] = in->clip[i] + t * (out->clip[i] - in->clip[i]);
	for (int i = 0; i < POLYGON_VALUES; i++)
		cut->values[i] = in->values[i] + t * (out->values[i] - in->values[i]);
}

/* Sutherland & Hodgman 1974. */
static void cut(const struct polygon *polygon, int axis, double sign, struct polygon *kept)
{
	kept->count = 0;
	for (int i = 0; i < polygon->count && kept->count + 2 <= POLYGON_CORNERS_MAX; i++) {
		const struct polygon_corner *p = &polygon->corners[i];
		const struct polygon_corner *q = &polygon->corners[(i + 1) % polygon->count];
		double inside_p = inside_by(p, axis, sign), inside_q = inside_by(q, axis, sign);
		if (inside_p >= 0.0)
			kept->corners[kept->count++] = *p;
		/* One is below 0 and the other is not: the divisor is neither's 0. */
		if (inside_p >= 0.0 && inside_q < 0.0)
			cut_edge(p, q, inside_p / (inside_p - inside_q),
				&kept->corners[kept->count++]);
		else if (inside_p < 0.0 && inside_q >= 0.0)
			cut_edge(q, p, inside_q / (inside_q - inside_p),
				&kept->corners[kept->count++]);
	}
}

static bool is_finite(const struct polygon *polygon)
{
	for (int i = 0; i < polygon->count; i++) {
		const struct polygon_corner *corner = &polygon->corners[i];
		for (int c = 0; c < 4; c++)
			if (!isfinite(corner->clip[c]))
				return false;
		for (int v = 0; v < POLYGON_VALUES; v++)
			if (!isfinite(corner->values[v]))
				return false;
	}
	return true;
}

static bool is_inside(const struct polygon *polygon, int axis, double sign)
{
	for (int i = 0; i < polygon->count; i++)
		if (inside_by(&polygon->corners[i], axis, sign) < 0.0)
			return false;
	return true;
}

bool polygon_clip(struct polygon *polygon)
{
	if (!is_finite(polygon))
		return false;
	/* Near and far first: what is left is before the eye. */
	for (int side = 0; side < 6; side++) {
		int axis = 2 - side / 2;
		double sign = side % 2 ? 1.0 : -1.0;
		if (is_inside(polygon, axis, sign))
			continue;
		struct polygon kept;
		cut(polygon, axis, sign, &kept);
		polygon_copy(polygon, &kept);
	}
	for (int i = 0; i < polygon->count; i++)
		/* Only x = y = z = w = 0 is left on the wrong side of the division. */
		if (!(polygon->corners[i].clip[3] > 0.0))
			return false;
	return polygon->count >= 3 && is_finite(polygon);
}
