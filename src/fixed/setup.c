/* SPDX-License-Identifier: MIT */
#include "fixed/setup.h"
#include "base/array.h"
#include "fixed/field.h"
#include <math.h>
#include <string.h>

/* Values of a corner: window depth is the first of all. */
enum { DEPTH, FIN_X, FIN_Y, FIN_WIDTH, FIN_VALUES };
enum { LIGHT_X = DEPTH + 1, LIGHT_Y, LIGHT_Z, LIGHT_W, RECEIVER_VALUES };

#define DEPTH_ONE (double)(1 << (FIXED_DEPTH_BITS + FIXED_DEPTH_FRACTION))
/* Of the units of fins, and of receivers. */
#define FIN_BITS (14 + FIXED_FIN_FRACTION)
#define RECEIVER_BITS 30
/* Steps of depth: rounding of the blocker's and of the receiver's. */
#define BIAS_STEPS 2

static double half(double value, double w)
{
	return 0.5 * (value + w);
}

static void set_corner(struct polygon *polygon, const double clip[4])
{
	struct polygon_corner *corner = &polygon->corners[polygon->count++];
	*corner = (struct polygon_corner){.values[DEPTH] = half(clip[2], clip[3])};
	memcpy(corner->clip, clip, sizeof(corner->clip));
}

static bool is_drawn(const struct field *field, enum fixed_side side)
{
	return side == FIXED_BOTH_SIDES || field->ccw == (side == FIXED_COUNTER_CLOCKWISE);
}

bool fixed_add_blocker(struct fixed_blockers *blockers, const struct fixed_screen *screen,
	const double clip[3][4], enum fixed_side side)
{
	struct polygon polygon;
	struct field field;
	struct cover_cutter cutter;
	struct fixed_blocker blocker = {0};
	polygon.count = 0;
	for (int i = 0; i < 3; i++)
		set_corner(&polygon, clip[i]);
	if (!field_init(&field, &polygon, DEPTH + 1, screen) || !is_drawn(&field, side))
		return true;
	cover_cutter_init(&cutter, &field.outline, screen);
	while (cover_cutter_next(&cutter, &blocker.cover)) {
		blocker.depth = field_plane(&field, DEPTH, DEPTH_ONE, &blocker.cover);
		if (!array_reserve((void **)&blockers->items, &blockers->capacity,
			    blockers->count + 1, sizeof(*blockers->items)))
			return false;
		blockers->items[blockers->count++] = blocker;
	}
	return true;
}

static void set_fin_corner(struct polygon *polygon, const struct fixed_fin_corner *from)
{
	const double clip[4] = {from->position[0], from->position[1], from->position[2], 1.0};
	set_corner(polygon, clip);
	double *values = polygon->corners[polygon->count - 1].values;
	values[FIN_X] = from->offset[0];
	values[FIN_Y] = from->offset[1];
	values[FIN_WIDTH] = from->width;
}

static void fin_planes(const struct field *field, struct fixed_fin *fin)
{
	const struct fixed_cover *cover = &fin->cover;
	double scale = field_scale(field, FIN_X, 3, FIN_BITS, cover);
	fin->depth = field_plane(field, DEPTH, DEPTH_ONE, cover);
	fin->offset_x = field_plane(field, FIN_X, scale, cover);
	fin->offset_y = field_plane(field, FIN_Y, scale, cover);
	fin->width = field_plane(field, FIN_WIDTH, scale, cover);
}

bool fixed_add_fin(struct fixed_fins *fins, const struct fixed_screen *screen,
	const struct fixed_fin_corner corners[4])
{
	struct polygon polygon;
	struct field field;
	struct cover_cutter cutter;
	struct fixed_fin fin = {0};
	polygon.count = 0;
	for (int i = 0; i < 4; i++)
		set_fin_corner(&polygon, &corners[i]);
	if (!field_init(&field, &polygon, FIN_VALUES, screen))
		return true;
	cover_cutter_init(&cutter, &field.outline, screen);
	while (cover_cutter_next(&cutter, &fin.cover)) {
		fin_planes(&field, &fin);
		if (!array_reserve((void **)&fins->items, &fins->capacity, fins->count + 1,
			    sizeof(*fins->items)))
			return false;
		fins->items[fins->count++] = fin;
	}
	return true;
}

static void set_receiver_corner(
	struct polygon *polygon, const double clip[4], const double light[4])
{
	set_corner(polygon, clip);
	double *values = polygon->corners[polygon->count - 1].values;
	values[LIGHT_X] = half(light[0], light[3]);
	values[LIGHT_Y] = half(light[1], light[3]);
	values[LIGHT_Z] = half(light[2], light[3]);
	values[LIGHT_W] = light[3];
}

/* How window depth grows along window x, plus along y, on the light's screen; returns as
 * field_slope(). */
static int find_rise(const double light[3][4], double *rise)
{
	const double *const clip[3] = {light[0], light[1], light[2]};
	const double q[3] = {light[0][2], light[1][2], light[2][2]};
	double slope[2];
	int side = field_slope(clip, q, slope);
	*rise = side != 0 ? fabs(slope[0]) + fabs(slope[1]) : 0.0;
	return side;
}

static int32_t find_bias(const struct field *field, double rise, const struct fixed_bias *bias,
	const struct fixed_cover *cover)
{
	double w = field_middle(field, LIGHT_W, cover);
	double depth = w > 0.0 ? field_middle(field, LIGHT_Z, cover) / w : 0.0;
	double limit = bias->limit[0] + bias->limit[1] * fmin(fmax(depth, 0.0), 1.0);
	double steps = fmin(rise, limit) * bias->reach * (1 << FIXED_DEPTH_BITS);
	return BIAS_STEPS + (int32_t)ceil(fmin(fmax(steps, 0.0), 1 << FIXED_DEPTH_BITS));
}

static void receiver_planes(const struct field *field, double rise, const struct fixed_bias *bias,
	struct fixed_receiver *receiver)
{
	const struct fixed_cover *cover = &receiver->cover;
	receiver->depth = field_plane(field, DEPTH, DEPTH_ONE, cover);
	if (receiver->kind == FIXED_LIT)
		return;
	double scale = field_scale(field, LIGHT_X, 4, RECEIVER_BITS, cover);
	receiver->x = field_plane(field, LIGHT_X, scale, cover);
	receiver->y = field_plane(field, LIGHT_Y, scale, cover);
	receiver->z = field_plane(field, LIGHT_Z, scale, cover);
	receiver->w = field_plane(field, LIGHT_W, scale, cover);
	receiver->bias = find_bias(field, rise, bias, cover);
}

/* Light and camera see the same side, or they do not. */
static enum fixed_receiver_kind find_kind(
	const struct field *field, const struct fixed_surface *surface, double *rise)
{
	if (find_rise(surface->light, rise) != (field->ccw ? 1 : -1))
		return FIXED_AWAY;
	return surface->receives ? FIXED_RECEIVES : FIXED_LIT;
}

bool fixed_add_receiver(struct fixed_receivers *receivers, const struct fixed_screen *screen,
	const struct fixed_surface *surface, const struct fixed_bias *bias)
{
	struct polygon polygon;
	struct field field;
	struct cover_cutter cutter;
	struct fixed_receiver receiver = {0};
	double rise;
	polygon.count = 0;
	for (int i = 0; i < 3; i++)
		set_receiver_corner(&polygon, surface->clip[i], surface->light[i]);
	if (!field_init(&field, &polygon, RECEIVER_VALUES, screen) ||
		!is_drawn(&field, surface->side))
		return true;
	receiver.kind = find_kind(&field, surface, &rise);
	cover_cutter_init(&cutter, &field.outline, screen);
	while (cover_cutter_next(&cutter, &receiver.cover)) {
		receiver_planes(&field, rise, bias, &receiver);
		if (!array_reserve((void **)&receivers->items, &receivers->capacity,
			    receivers->count + 1, sizeof(*receivers->items)))
			return false;
		receivers->items[receivers->count++] = receiver;
	}
	return true;
}
