/* SPDX-License-Identifier: MIT */
#include "load/motion.h"
#include <math.h>
#include <string.h>

double motion_time(uint64_t frame, uint32_t numerator, uint32_t denominator)
{
	return (double)(frame - 1) * denominator / numerator;
}

double motion_phase(double seconds, double period)
{
	return period != 0 ? fmod(seconds, period) / period : 0;
}

/** Turns a point about the vertical axis through center: z goes to x, as y points up. */
static void turn(double phase, const float rest[3], const float center[3], float point[3])
{
	double angle = 2 * M_PI * phase;
	double x = (double)rest[0] - center[0], z = (double)rest[2] - center[2];
	point[0] = (float)(center[0] + cos(angle) * x + sin(angle) * z);
	point[2] = (float)(center[2] + cos(angle) * z - sin(angle) * x);
}

bool motion_moves(const struct motion_path *path)
{
	const float *travel = path->travel;
	return path->orbit != 0 || travel[0] != 0 || travel[1] != 0 || travel[2] != 0;
}

void motion_point(const struct motion_path *path, double seconds, const float center[3],
	const float rest[3], float point[3])
{
	double way = motion_phase(seconds, (double)path->travel_time);
	double share = (1 - cos(2 * M_PI * way)) / 2;
	double phase = motion_phase(seconds, path->orbit);
	float there[3];
	/* Even adding nothing changes the sign of a zero, and doubles may round the sums of turn().
	 */
	for (int i = 0; i < 3; i++)
		there[i] = share != 0 && path->travel[i] != 0
				   ? (float)(rest[i] + share * path->travel[i])
				   : rest[i];
	memcpy(point, there, sizeof(there));
	if (phase != 0)
		turn(phase, there, center, point);
}

void motion_camera(const struct motion_path *path, double seconds, const struct sm_camera *rest,
	struct sm_camera *camera)
{
	static const float origin[3];
	double phase = motion_phase(seconds, path->orbit);
	*camera = *rest;
	motion_point(path, seconds, rest->target, rest->eye, camera->eye);
	if (phase != 0)
		turn(phase, rest->up, origin, camera->up);
}

void motion_light(const struct motion_path *path, double seconds, const struct sm_light_desc *rest,
	struct sm_light_desc *light)
{
	*light = *rest;
	motion_point(path, seconds, rest->target, rest->position, light->position);
}
