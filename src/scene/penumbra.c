/* SPDX-License-Identifier: MIT */
#include "scene/penumbra.h"

/* Texels: a map's edges are steps of one, and a penumbra that is narrower does not smooth them. */
#define WIDTH_SHOWN 1.0f
#define WIDTH_HIDDEN 0.75f

/* Window depth of a point at that distance along the axis, held between the planes. */
static float depth_at(const struct light_frame *frame, float z)
{
	float held = fminf(fmaxf(z, frame->near), frame->far);
	if (frame->parallel)
		return (held - frame->near) / (frame->far - frame->near); /* far > near */
	return frame->pole * (1.0f - frame->near / held);                 /* near > 0 */
}

/* Nearest and farthest distance of an object's box along the axis. */
static void box_range(const struct light_frame *frame, const struct object *object, float range[2])
{
	float middle = frame->world_to_light[3][2], reach = 0.0f;
	for (int axis = 0; axis < 3; axis++) {
		float along = frame->world_to_light[axis][2];
		middle += along * (object->min[axis] + object->max[axis]) / 2.0f;
		reach += fabsf(along) * (object->max[axis] - object->min[axis]) / 2.0f;
	}
	range[0] = middle - reach;
	range[1] = middle + reach;
}

/* By how much more depth than the nearest caster the farthest receiver has; below 0 if none casts
 * or none receives. */
static float deepest_gap(const struct sm_scene *scene, const struct light_frame *frame)
{
	float caster = 2.0f, receiver = -1.0f; /* beyond all depths */
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		float range[2];
		box_range(frame, object, range);
		if (object->casts)
			caster = fminf(caster, depth_at(frame, range[0]));
		if (object->receives)
			receiver = fmaxf(receiver, depth_at(frame, range[1]));
	}
	return receiver - caster;
}

/* Where the light's rays meet the screen at a slant the disc, which faces the receiver, throws a
 * penumbra on it that is wider than one of a disc in the screen's plane. */
static float slant(const struct light_frame *frame)
{
	float corner = 2.0f * frame->half_extent * frame->half_extent;
	return frame->parallel ? 1.0f : sqrtf(1.0f + corner);
}

float penumbra_texels(
	const struct sm_scene *scene, const struct light_frame *frame, uint32_t map_size)
{
	float gap = fmaxf(deepest_gap(scene, frame), 0.0f);
	return 2.0f * disc_scale(frame) * slant(frame) * gap * (float)map_size;
}

bool penumbra_shows(float texels, bool shown)
{
	return texels > (shown ? WIDTH_HIDDEN : WIDTH_SHOWN);
}
