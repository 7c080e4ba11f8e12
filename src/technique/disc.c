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

/* R (1/b - 1/r) at distance 1 of a spot; 1/z is (K - d) / (K near) at window depth d. For a
 * directional light R (r - b). The screen is 2 half_extent wide. Finite, so that a difference of 0
 * gives 0, also times the texels of a map: a disc of 1e6 before a near plane of 1e-30 is not. */
float disc_scale(const struct light_frame *frame)
{
	float per_depth = frame->parallel ? frame->far - frame->near
					  : 1.0f / (frame->pole * frame->near); /* near > 0 */
	return fminf(frame->disc * per_depth / (2.0f * frame->half_extent), 1e30f);
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
