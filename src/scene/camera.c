/* SPDX-License-Identifier: MIT */
#include "scene/camera.h"
#include "base/error.h"

/* Near:far at most 1:20000: a 24-bit depth buffer then still tells depths at the far plane apart
 * that differ by about a thousandth. */
#define NEAR_TO_FAR_MIN (1.0f / 20000.0f)

static bool camera_check(const struct sm_camera *camera, struct sm_error *error)
{
	vec3 view, side;
	glm_vec3_sub((float *)camera->target, (float *)camera->eye, view);
	glm_vec3_cross(view, (float *)camera->up, side);
	/* false for NaN too */
	if (!(glm_vec3_norm2(view) > 0.0f) || !isfinite(glm_vec3_norm2(view)))
		return error_set(
			error, SM_ERROR_INPUT, "camera: its target is its eye, or not finite");
	if (!(glm_vec3_norm2(side) > 0.0f) || !isfinite(glm_vec3_norm2(side)))
		return error_set(error, SM_ERROR_INPUT, "camera: it looks along its up direction");
	if (!(camera->fov > 0.0f && camera->fov < 179.0f))
		return error_set(error, SM_ERROR_INPUT,
			"camera: its field of view is not between 0 and 179 degrees");
	bool automatic = camera->near == 0.0f && camera->far == 0.0f;
	if (!automatic && !(camera->near > 0.0f && camera->far > camera->near))
		return error_set(error, SM_ERROR_INPUT, "camera: not 0 < near < far (or both 0)");
	return true;
}

static void fit_depth_range(
	const struct sm_scene *scene, mat4 view, float *near_plane, float *far_plane)
{
	float nearest = FLT_MAX, farthest = 0.0f;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		vec3 box[2];
		glm_vec3_copy((float *)object->min, box[0]);
		glm_vec3_copy((float *)object->max, box[1]);
		glm_aabb_transform(box, view, box);
		nearest = fminf(nearest, -box[1][2]);
		farthest = fmaxf(farthest, -box[0][2]);
	}
	/* All behind the camera, or no object: any range will do. */
	if (!(farthest > 0.0f && isfinite(farthest)))
		farthest = 1.0f;
	/* A thousandth more on either side, for what rounding may have cut off. */
	*far_plane = farthest * 1.001f;
	*near_plane = fmaxf(fminf(nearest, farthest) * 0.999f, *far_plane * NEAR_TO_FAR_MIN);
}

bool camera_world_to_clip(const struct sm_camera *camera, const struct sm_scene *scene,
	uint32_t width, uint32_t height, mat4 world_to_clip, struct sm_error *error)
{
	if (!camera_check(camera, error))
		return false;
	mat4 view, projection;
	glm_lookat((float *)camera->eye, (float *)camera->target, (float *)camera->up, view);
	float near_plane = camera->near, far_plane = camera->far;
	if (near_plane == 0.0f)
		fit_depth_range(scene, view, &near_plane, &far_plane);
	glm_perspective(glm_rad(camera->fov), (float)width / (float)height, near_plane, far_plane,
		projection);
	glm_mat4_mul(projection, view, world_to_clip);
	return true;
}
