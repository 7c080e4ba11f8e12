/* SPDX-License-Identifier: MIT */
#include "load/defaults.h"
#include "load/model.h"
#include <cglm/cglm.h>
#include <math.h>

/* Taste, in degrees and in radii of the casters' sphere. Azimuths count from +z towards +x. */
static const float camera_azimuth = 32, camera_elevation = 24, camera_fov = 35;
static const float camera_margin = 1.06f;
static const float light_azimuth = -40, light_elevation = 52, light_distance = 5;
static const float light_radius = .04f; /* of the distance to the target */
static const float light_reach = 3;     /* radius of the lit circle about the target */
static const float fullness = .6f;      /* share of the box's sides that casts shadows */
static const float shadow_reach = 2;    /* how much of a long shadow is worth showing */

static bool is_open(const float vector[3])
{
	return isnan(vector[0]);
}

static void towards(float azimuth, float elevation, vec3 direction)
{
	float level = cosf(glm_rad(elevation));
	direction[0] = level * sinf(glm_rad(azimuth));
	direction[1] = sinf(glm_rad(elevation));
	direction[2] = level * cosf(glm_rad(azimuth));
}

void frame_init(struct frame *frame, const float box[2][3], float ground)
{
	*frame = (struct frame){0};
	glm_vec3_copy((float *)box[0], frame->min);
	glm_vec3_copy((float *)box[1], frame->max);
	glm_vec3_center(frame->min, frame->max, frame->center);
	frame->radius = glm_vec3_distance(frame->min, frame->max) / 2;
	if (frame->radius == 0) /* a single point: any size will do */
		frame->radius = 1;
	frame->ground = isnan(ground) ? frame->min[1] : ground;
}

/** Illuminance at a distance, of a light that may leave its law open as older formats do. */
static float faded(const struct model_light *light, float distance)
{
	float fade =
		light->fade[0] + light->fade[1] * distance + light->fade[2] * distance * distance;
	return fade > 0 ? light->desc.intensity / fade : light->desc.intensity;
}

void frame_model_light(
	const struct frame *frame, const struct model_light *light, struct sm_light_desc *desc)
{
	*desc = light->desc;
	if (!light->physical)
		return;
	vec3 direction, center;
	glm_vec3_sub((float *)frame->center, desc->position, center);
	glm_vec3_sub(desc->target, desc->position, direction);
	glm_vec3_normalize(direction);
	float distance = light->aimed ? glm_vec3_dot(center, direction) : glm_vec3_norm(center);
	if (distance <= 0) /* it looks away from the scene */
		distance = frame->radius;
	desc->intensity = faded(light, distance);
	if (!light->aimed) {
		glm_vec3_broadcast(NAN, desc->target);
	} else if (desc->type == SM_LIGHT_DIRECTIONAL) {
		glm_vec3_copy((float *)frame->center, desc->target);
		glm_vec3_copy((float *)frame->center, desc->position);
		glm_vec3_muladds(direction, -light_distance * frame->radius, desc->position);
	} else {
		glm_vec3_copy(desc->position, desc->target);
		glm_vec3_muladds(direction, distance, desc->target);
	}
}

void frame_complete_light(const struct frame *frame, struct sm_light_desc *light)
{
	if (is_open(light->target))
		glm_vec3_copy((float *)frame->center, light->target);
	if (is_open(light->position)) {
		vec3 direction;
		towards(light_azimuth, light_elevation, direction);
		glm_vec3_copy(light->target, light->position);
		glm_vec3_muladds(direction, light_distance * frame->radius, light->position);
	}
	float distance = glm_vec3_distance(light->position, light->target);
	if (isnan(light->radius))
		light->radius = light_radius * distance;
	if (isnan(light->angle))
		light->angle =
			fminf(glm_deg(2 * atan2f(light_reach * frame->radius, distance)), 120);
}

/** Where the light throws the shadow of a point; shadow_reach away at most. */
static void shadow_of(
	const struct frame *frame, const struct sm_light_desc *light, vec3 point, vec3 shadow)
{
	vec3 ray;
	const float *from = light->type == SM_LIGHT_DIRECTIONAL ? light->target : point;
	glm_vec3_sub((float *)from, (float *)light->position, ray);
	float level = hypotf(ray[0], ray[2]), drop = fmaxf(point[1] - frame->ground, 0);
	float reach = shadow_reach * frame->radius;
	/* A ray that rises or grazes the ground throws it to the horizon. */
	float away = ray[1] < 0 ? fminf(level * drop / -ray[1], reach) : reach;
	vec3 aside = {0, 0, 0}; /* straight down: right below */
	/* Each is 1 at most, however short the level. */
	if (level > 0) {
		aside[0] = ray[0] / level;
		aside[2] = ray[2] / level;
	}
	shadow[0] = point[0] + away * aside[0];
	shadow[1] = frame->ground;
	shadow[2] = point[2] + away * aside[2];
}

enum { POINTS = 16 };

/** Corners of the casters' box, and the shadows of those of a smaller one, because few casters
 *  fill their box. */
static void points_of_interest(
	const struct frame *frame, const struct sm_light_desc *light, vec3 points[POINTS])
{
	for (int i = 0; i < 8; i++) {
		vec3 inner;
		for (int axis = 0; axis < 3; axis++)
			points[i][axis] = i >> axis & 1 ? frame->max[axis] : frame->min[axis];
		glm_vec3_lerp((float *)frame->center, points[i], fullness, inner);
		shadow_of(frame, light, inner, points[8 + i]);
	}
}

static void middle_of(vec3 points[POINTS], vec3 middle)
{
	vec3 min, max;
	glm_vec3_copy(points[0], min);
	glm_vec3_copy(points[0], max);
	for (int i = 1; i < POINTS; i++) {
		glm_vec3_minv(min, points[i], min);
		glm_vec3_maxv(max, points[i], max);
	}
	glm_vec3_center(min, max, middle);
}

/** How far back from the target the eye must go for all points to be within the picture. */
static float distance_to_fit(
	vec3 points[POINTS], vec3 target, vec3 backwards, float fov, float aspect)
{
	vec3 right, up;
	glm_vec3_crossn(GLM_YUP, backwards, right);
	glm_vec3_cross(backwards, right, up);
	float tangent = tanf(glm_rad(fov) / 2);
	float distance = 0;
	for (int i = 0; i < POINTS; i++) {
		vec3 point;
		glm_vec3_sub(points[i], target, point);
		float across = fabsf(glm_vec3_dot(point, right)) / (tangent * aspect);
		float upwards = fabsf(glm_vec3_dot(point, up)) / tangent;
		float needed = glm_vec3_dot(point, backwards) + fmaxf(across, upwards);
		distance = fmaxf(distance, needed);
	}
	return distance;
}

void frame_complete_camera(const struct frame *frame, const struct sm_light_desc *light,
	float aspect, struct sm_camera *camera)
{
	vec3 points[POINTS];
	points_of_interest(frame, light, points);
	if (isnan(camera->fov))
		camera->fov = camera_fov;
	if (is_open(camera->up))
		glm_vec3_copy(GLM_YUP, camera->up);
	if (is_open(camera->target))
		middle_of(points, camera->target);
	if (is_open(camera->eye)) {
		vec3 backwards;
		towards(camera_azimuth, camera_elevation, backwards);
		float distance = camera_margin * distance_to_fit(points, camera->target, backwards,
							 camera->fov, aspect);
		glm_vec3_copy(camera->target, camera->eye);
		glm_vec3_muladds(backwards, distance, camera->eye);
	}
	if (isnan(camera->near) && isnan(camera->far))
		camera->near = camera->far = 0;
}
