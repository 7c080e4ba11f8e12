/* SPDX-License-Identifier: MIT */
/* A shadow map for each of many points of the light (Heckbert & Herf 1997). */
#include "model/technique.h"
#include "technique/disc.h"

struct maps {
	const struct model_light *light;
	struct model_map layers[DISC_POINTS_MAX];
	struct disc disc;
};

static bool init(void *state, const struct model_light *light, struct sm_error *error)
{
	struct maps *maps = state;
	maps->light = light;
	disc_init(&maps->disc, light->options.samples);
	for (int i = 0; i < maps->disc.count; i++) {
		struct light_frame frame = disc_frame(&light->frame, maps->disc.points[i]);
		if (!model_map_init_from(&maps->layers[i], light, &frame, MODEL_CASTERS, error))
			return false;
	}
	return true;
}

static void finish(void *state)
{
	struct maps *maps = state;
	for (int i = 0; i < maps->disc.count; i++)
		model_map_finish(&maps->layers[i]);
}

/* On a point's screen a receiver is beside where the middle sees it in proportion to its distance
 * from the far plane, and its plane is as much larger as it is turned towards the point. */
static double visibility(const void *state, const struct receiver *receiver)
{
	const struct maps *maps = state;
	double scale = disc_scale(&maps->light->frame), lit = 0.0;
	double reach = REACH_FOUR / maps->light->size;
	for (int i = 0; i < maps->disc.count; i++) {
		const double point[2] = {
			scale * maps->disc.points[i][0], scale * maps->disc.points[i][1]};
		double facing =
			fabs(1.0 + receiver->slope[0] * point[0] + receiver->slope[1] * point[1]);
		double bias = fmin(receiver_rise(receiver) * reach / fmax(facing, 1e-6),
			receiver->limit * reach);
		double at[2];
		for (int axis = 0; axis < 2; axis++)
			at[axis] = receiver->at[axis] - point[axis] * (1.0 - receiver->depth);
		lit += model_map_compare(&maps->layers[i], at, receiver->depth - DEPTH_STEP - bias);
	}
	return lit / maps->disc.count;
}

const struct model_technique model_maps = {
	.name = "maps",
	.state_size = sizeof(struct maps),
	.init = init,
	.finish = finish,
	.visibility = visibility,
};
