/* SPDX-License-Identifier: MIT */
#include "ref/pinhole.h"
#include "base/error.h"
#include "ref/vector.h"

static bool find_axes(struct pinhole *pinhole, const struct sm_camera *camera)
{
	double up[3];
	for (int i = 0; i < 3; i++) {
		pinhole->axis[i] = (double)camera->target[i] - camera->eye[i];
		up[i] = camera->up[i];
	}
	if (!vector_normalise(pinhole->axis))
		return false;
	vector_cross(pinhole->axis, up, pinhole->right);
	if (!vector_normalise(pinhole->right))
		return false;
	vector_cross(pinhole->right, pinhole->axis, pinhole->up);
	return true;
}

bool pinhole_init(struct pinhole *pinhole, const struct sm_camera *camera, uint32_t width,
	uint32_t height, const struct tracer *tracer, struct sm_error *error)
{
	*pinhole = (struct pinhole){.width = width, .height = height, .far = INFINITY};
	if (!find_axes(pinhole, camera))
		return error_set(error, SM_ERROR_INPUT,
			"camera: it has no direction, or looks along its up direction");
	if (!(camera->fov > 0.0f && camera->fov < 179.0f))
		return error_set(error, SM_ERROR_INPUT,
			"camera: its field of view is not between 0 and 179 degrees");
	tracer_place(tracer, camera->eye, pinhole->eye);
	pinhole->half_height = tan(camera->fov * (M_PI / 360.0));
	pinhole->half_width = pinhole->half_height * width / height;
	if (camera->near != 0.0f || camera->far != 0.0f) {
		pinhole->near = camera->near * tracer->scale;
		pinhole->far = camera->far * tracer->scale;
	}
	return true;
}

void pinhole_sight(const struct pinhole *pinhole, uint32_t x, uint32_t y, struct sight *sight)
{
	double right = (2.0 * (x + 0.5) / pinhole->width - 1.0) * pinhole->half_width;
	double up = (1.0 - 2.0 * (y + 0.5) / pinhole->height) * pinhole->half_height;
	*sight = (struct sight){0};
	vector_add(pinhole->axis, right, pinhole->right, sight->direction);
	vector_add(sight->direction, up, pinhole->up, sight->direction);
	/* At least 1 long. */
	double stretch = vector_length(sight->direction);
	vector_scale(sight->direction, 1.0 / stretch);
	vector_add(sight->origin, 1.0, pinhole->eye, sight->origin);
	sight->near = pinhole->near * stretch;
	sight->far = pinhole->far * stretch;
}
