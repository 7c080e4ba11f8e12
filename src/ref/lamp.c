/* SPDX-License-Identifier: MIT */
#include "ref/lamp.h"
#include "ref/vector.h"

/* Sine above the surface that the lowest point of the light must have: below, visibility hangs on
 * the last digits of the surface. As in the ground truth of the study (docs/reference.md). */
#define CLEARANCE 0.02

/* Two unit vectors that are perpendicular to a unit vector and to each other. */
static void find_sides(const double axis[3], double u[3], double v[3])
{
	int least = 0;
	for (int i = 1; i < 3; i++)
		if (fabs(axis[i]) < fabs(axis[least]))
			least = i;
	double other[3] = {0.0, 0.0, 0.0};
	other[least] = 1.0;
	vector_cross(axis, other, u);
	/* At least sqrt(2/3) long. */
	vector_normalise(u);
	vector_cross(axis, u, v);
}

/* The square that a spot lights, turned as smoothie.h's user sees it: upright, or where the light
 * falls within 26 degrees of the vertical, along z. */
static void init_screen(struct lamp *lamp, const struct sm_light_desc *light)
{
	const double y[3] = {0.0, 1.0, 0.0}, z[3] = {0.0, 0.0, 1.0};
	vector_cross(lamp->axis, fabs(lamp->axis[1]) > 0.9 ? z : y, lamp->right);
	vector_normalise(lamp->right);
	vector_cross(lamp->right, lamp->axis, lamp->up);
	lamp->half_extent = tan(light->angle * (M_PI / 360.0));
}

void lamp_init(struct lamp *lamp, const struct sm_light_desc *light, const struct tracer *tracer)
{
	*lamp = (struct lamp){.parallel = light->type == SM_LIGHT_DIRECTIONAL};
	for (int i = 0; i < 3; i++)
		lamp->axis[i] = (double)light->target[i] - light->position[i];
	double distance = vector_length(lamp->axis);
	vector_normalise(lamp->axis);
	if (lamp->parallel) {
		/* The scene has no light whose target is its position. */
		lamp->radius = light->radius / distance;
		vector_add(lamp->origin, -1.0, lamp->axis, lamp->origin);
		return;
	}
	tracer_place(tracer, light->position, lamp->origin);
	lamp->radius = light->radius * tracer->scale;
	init_screen(lamp, light);
}

static bool is_on_screen(const struct lamp *lamp, const double towards[3])
{
	double depth = -vector_dot(towards, lamp->axis);
	double reach = depth * lamp->half_extent;
	return depth > 0.0 && fabs(vector_dot(towards, lamp->right)) <= reach &&
	       fabs(vector_dot(towards, lamp->up)) <= reach;
}

bool lamp_fan(const struct lamp *lamp, const struct surface *surface, struct fan *fan)
{
	double distance = 1.0;
	*fan = (struct fan){.end = INFINITY};
	vector_add(fan->axis, 1.0, lamp->origin, fan->axis);
	if (!lamp->parallel) {
		vector_subtract(lamp->origin, surface->point, fan->axis);
		distance = vector_length(fan->axis);
		fan->end = 1.0;
	}
	double needed = lamp->radius + CLEARANCE * distance;
	/* Also false at distance 0. */
	if (!(vector_dot(surface->normal, fan->axis) > needed))
		return false;
	if (!lamp->parallel && !is_on_screen(lamp, fan->axis))
		return false;
	double direction[3] = {0.0, 0.0, 0.0};
	vector_add(direction, 1.0 / distance, fan->axis, direction);
	find_sides(direction, fan->u, fan->v);
	vector_scale(fan->u, lamp->radius);
	vector_scale(fan->v, lamp->radius);
	return true;
}
