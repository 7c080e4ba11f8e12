/* SPDX-License-Identifier: MIT */
/* One shadow map, compared at the texels around a surface: at the nearest one, at four or sixteen
 * of them, or at as many as the penumbra is wide. */
#include "model/technique.h"
#include "technique/disc.h"

struct one_map {
	const struct model_light *light;
	struct model_map map;
	struct disc disc; /* pcss */
};

static bool init(void *state, const struct model_light *light, struct sm_error *error)
{
	struct one_map *model = state;
	model->light = light;
	return model_map_init(&model->map, light, MODEL_CASTERS, error);
}

static void finish(void *state)
{
	struct one_map *model = state;
	model_map_finish(&model->map);
}

static double nearest_at(const struct model_map *map, const double at[2])
{
	double texel[2];
	for (int i = 0; i < 2; i++)
		texel[i] = fmin(fmax(floor(at[i] * map->size), 0.0), map->size - 1.0);
	return model_map_at(map, (int)texel[0], (int)texel[1]);
}

static double hard_visibility(const void *state, const struct receiver *receiver)
{
	const struct one_map *model = state;
	double depth = receiver_depth(receiver, model->light, REACH_NEAREST);
	return nearest_at(&model->map, receiver->at) >= depth ? 1.0 : 0.0;
}

/* Of a cubic B-spline, at the texels at -1, 0, 1 and 2 from the one that is f before the place. */
static double spline_weight(int i, double f)
{
	double distance = fabs(i - 1 - f), rest = 2.0 - distance;
	if (distance < 1.0)
		return (4.0 + distance * distance * (3.0 * distance - 6.0)) / 6.0;
	return rest > 0.0 ? rest * rest * rest / 6.0 : 0.0;
}

/* Four texels at a time are compared at the receiver's plane amid them. */
static double bicubic(const struct one_map *model, const struct receiver *receiver)
{
	double texel[2], base[2], sum = 0.0;
	double depth = receiver_plane_depth(receiver, model->light, REACH_FOUR);
	int size = model->light->size;
	for (int i = 0; i < 2; i++) {
		texel[i] = fmin(fmax(receiver->at[i] * size - 0.5, -2.0), size + 1.0);
		base[i] = floor(texel[i]);
	}
	for (int i = 0; i < 16; i++) {
		int x = i % 4, y = i / 4;
		/* From the place to the middle of the block of four. */
		double dx = base[0] - 0.5 + x / 2 * 2 - texel[0];
		double dy = base[1] - 0.5 + y / 2 * 2 - texel[1];
		double compared =
			depth + (receiver->slope[0] * dx + receiver->slope[1] * dy) / size;
		double found =
			model_map_at(&model->map, (int)base[0] + x - 1, (int)base[1] + y - 1);
		if (found >= fmin(compared, 1.0))
			sum += spline_weight(x, texel[0] - base[0]) *
			       spline_weight(y, texel[1] - base[1]);
	}
	return sum;
}

static double pcf_visibility(const void *state, const struct receiver *receiver)
{
	const struct one_map *model = state;
	if (model->light->options.samples == 16)
		return bicubic(model, receiver);
	return model_map_compare(
		&model->map, receiver->at, receiver_depth(receiver, model->light, REACH_FOUR));
}

static bool pcss_init(void *state, const struct model_light *light, struct sm_error *error)
{
	struct one_map *model = state;
	disc_init(&model->disc, light->options.samples);
	return init(state, light, error);
}

/* Interleaved gradient noise (Jimenez 2014), in float as drivers have it: the factor 53 spreads its
 * rounding. */
static double noise_angle(const int pixel[2])
{
	float x = (float)pixel[0] + 0.5f, y = (float)pixel[1] + 0.5f;
	float along = x * 0.06711056f + y * 0.00583715f;
	float noise = 52.9829189f * (along - floorf(along));
	return 2.0 * GLM_PI * (double)(noise - floorf(noise));
}

/* Of a disc that faces the receiver: turned, then longer on the screen from the axis of a spot on.
 */
static void disc_axes(
	const struct one_map *model, const struct receiver *receiver, double axes[2][2])
{
	const struct light_frame *frame = &model->light->frame;
	double angle = noise_angle(receiver->pixel), c = cos(angle), s = sin(angle);
	double aside[2] = {0.0, 0.0};
	for (int i = 0; i < 2 && !frame->parallel; i++)
		aside[i] = receiver->position[i] / fmax(receiver->position[2], frame->near * 1e-3);
	double longer = 1.0 / (1.0 + sqrt(1.0 + aside[0] * aside[0] + aside[1] * aside[1]));
	const double turned[2][2] = {{c, s}, {-s, c}};
	for (int column = 0; column < 2; column++) {
		double along = turned[column][0] * aside[0] + turned[column][1] * aside[1];
		for (int i = 0; i < 2; i++)
			axes[column][i] = turned[column][i] + longer * along * aside[i];
	}
}

/* A point of the disc at this half-width, from the receiver. */
static void place_tap(
	const double axes[2][2], double half_width, const float point[2], double tap[2])
{
	for (int i = 0; i < 2; i++)
		tap[i] = half_width * (axes[0][i] * point[0] + axes[1][i] * point[1]);
}

/* Mean depth of the texels that are before the receiver; 1 if there are none. */
static double blocker_depth(const struct one_map *model, const struct receiver *receiver,
	const double axes[2][2], double depth, double half_width)
{
	double sum = 0.0;
	int count = 0;
	for (int i = 0; i < model->disc.count; i++) {
		double tap[2];
		place_tap(axes, half_width, model->disc.points[i], tap);
		double at[2] = {receiver->at[0] + tap[0], receiver->at[1] + tap[1]};
		double found = nearest_at(&model->map, at);
		double plane = depth + receiver->slope[0] * tap[0] + receiver->slope[1] * tap[1];
		if (found < fmin(plane, 1.0)) {
			sum += found;
			count++;
		}
	}
	return count > 0 ? sum / count : 1.0;
}

static double pcss_visibility(const void *state, const struct receiver *receiver)
{
	const struct one_map *model = state;
	double axes[2][2], lit = 0.0;
	double spread = disc_scale(&model->light->frame);
	double depth = receiver_plane_depth(receiver, model->light, REACH_FOUR);
	disc_axes(model, receiver, axes);
	double search = fmin(spread * fmin(fmax(receiver->depth, 0.0), 1.0), 0.5);
	double blocker = blocker_depth(model, receiver, (const double(*)[2])axes, depth, search);
	if (blocker == 1.0)
		return 1.0;
	double half_width = fmin(spread * fmax(receiver->depth - blocker, 0.0), 0.5);
	for (int i = 0; i < model->disc.count; i++) {
		double tap[2];
		place_tap((const double(*)[2])axes, half_width, model->disc.points[i], tap);
		double at[2] = {receiver->at[0] + tap[0], receiver->at[1] + tap[1]};
		lit += model_map_compare(&model->map, at,
			depth + receiver->slope[0] * tap[0] + receiver->slope[1] * tap[1]);
	}
	return lit / model->disc.count;
}

const struct model_technique model_hard = {
	.name = "hard",
	.state_size = sizeof(struct one_map),
	.init = init,
	.finish = finish,
	.visibility = hard_visibility,
};

const struct model_technique model_pcf = {
	.name = "pcf",
	.state_size = sizeof(struct one_map),
	.init = init,
	.finish = finish,
	.visibility = pcf_visibility,
};

const struct model_technique model_pcss = {
	.name = "pcss",
	.state_size = sizeof(struct one_map),
	.init = pcss_init,
	.finish = finish,
	.visibility = pcss_visibility,
};
