/* SPDX-License-Identifier: MIT */
#include "technique/disc.h"
#include <assert.h>

/* Vogel, "A better way to construct the sunflower head", 1979: each point has the same area. */
void disc_init(struct disc *disc, uint32_t count)
{
	assert(count > 0 && count <= DISC_POINTS_MAX);
	const double golden_angle = GLM_PI * (3.0 - sqrt(5.0));
	disc->count = (GLsizei)count;
	for (uint32_t i = 0; i < count; i++) {
		double radius = sqrt((i + 0.5) / count), angle = i * golden_angle;
		disc->points[i][0] = (float)(radius * cos(angle));
		disc->points[i][1] = (float)(radius * sin(angle));
	}
}

struct light_frame disc_frame(const struct light_frame *frame, const float point[2])
{
	struct light_frame sheared = *frame;
	float scale = disc_scale(frame);
	for (int column = 0; column < 4; column++) {
		float *entries = sheared.world_to_clip[column];
		float before_far = entries[3] - entries[2];
		for (int axis = 0; axis < 2; axis++)
			entries[axis] -= scale * point[axis] * before_far;
	}
	return sheared;
}

void disc_bind(const struct disc *disc, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program)
{
	gpu->gl.Uniform2fv(program->uniform.disc_points, disc->count, disc->points[0]);
	gpu->gl.Uniform1i(program->uniform.disc_count, disc->count);
	gpu->gl.Uniform1f(program->uniform.disc_scale, disc_scale(frame));
}
