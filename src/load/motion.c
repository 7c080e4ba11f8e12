/* SPDX-License-Identifier: MIT */
#include "load/motion.h"
#include <math.h>

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

void motion_turn_camera(double phase, const struct sm_camera *rest, struct sm_camera *camera)
{
	static const float origin[3];
	*camera = *rest;
	if (phase == 0) /* even doubles may round the sums of turn() */
		return;
	turn(phase, rest->eye, rest->target, camera->eye);
	turn(phase, rest->up, origin, camera->up);
}

void motion_turn_light(double phase, const struct sm_light_desc *rest, struct sm_light_desc *light)
{
	*light = *rest;
	if (phase != 0)
		turn(phase, rest->position, rest->target, light->position);
}
