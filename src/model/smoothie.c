/* SPDX-License-Identifier: MIT */
/* Smoothies (Chan & Durand 2003), and penumbra maps (Wyman & Hansen 2003) as fins of another width
 * and other values. */
#include "base/array.h"
#include "base/error.h"
#include "model/fins.h"
#include "model/technique.h"
#include <stdlib.h>

/* What a smoothie must be in front of a receiver by to darken it, linear depth. */
#define SMOOTHIE_STEP (1.0 / 1024.0)

#define FALLOFF_SIZE 256

/* A texel of the smoothie buffer: of the fins there the nearest depth, linear, and the least
 * value. */
struct soft_texel {
	float depth, value;
};

struct smoothie_model {
	const struct model_light *light;
	struct model_map casters, receivers;
	struct fin_set fins;
	struct soft_texel *texels; /* owned */
	bool cone, sinusoid;
};

/* (1 - cos(pi a)) / 2 from a table of bytes, linear in between. */
static double sinusoid(double a)
{
	double at = a * (FALLOFF_SIZE - 1.0), before = floor(at), values[2];
	for (int i = 0; i < 2; i++) {
		double entry = fmin(before + i, FALLOFF_SIZE - 1.0) / (FALLOFF_SIZE - 1.0);
		values[i] = rint(255.0 * (0.5 - 0.5 * cos(GLM_PI * entry))) / 255.0;
	}
	return values[0] + (at - before) * (values[1] - values[0]);
}

/* What of the way from silhouette to receiver a cone is at, in distance from the light: of window
 * depth it is alpha. */
static double cone_share(const struct smoothie_model *model, double alpha, double b, double r)
{
	double curve = 1.0 - model->light->frame.near_to_far;
	double share = alpha * (1.0 - curve * r) / (1.0 - curve * (b + alpha * (r - b)));
	return model->sinusoid ? share * share * (3.0 - 2.0 * share) : share;
}

static double value_of(const struct smoothie_model *model, double alpha, double b, double r)
{
	if (model->cone)
		return cone_share(model, alpha, b, r);
	return model->sinusoid ? sinusoid(alpha) : alpha;
}

static void keep_least(void *data, const struct fin_texel *fin)
{
	const struct smoothie_model *model = data;
	const struct model_light *light = model->light;
	struct soft_texel *texel =
		&model->texels[(size_t)fin->y * (size_t)light->size + (size_t)fin->x];
	double b = fin->depth, r = model_map_at(&model->casters, fin->x, fin->y);
	r = fmin(r, model_map_at(&model->receivers, fin->x, fin->y));
	if (r <= b)
		return;
	/* alpha' = alpha / (1 - b/r), section 4. */
	double full = fin->width * (r - b) / (light->frame.pole - b);
	double off = hypot(fin->offset[0], fin->offset[1]);
	if (off >= full)
		return;
	texel->depth = fminf(texel->depth, (float)model_linear_depth(light, b));
	texel->value = fminf(texel->value, (float)value_of(model, off / full, b, r));
}

static bool fill(struct smoothie_model *model, const struct model_light *light,
	const struct fin_shape *shape, struct sm_error *error)
{
	size_t count = (size_t)light->size * (size_t)light->size;
	model->light = light;
	model->sinusoid = light->options.falloff == SM_FALLOFF_SINUSOID;
	if (!model_map_init(&model->casters, light, MODEL_CASTERS, error) ||
		!model_map_init(&model->receivers, light, MODEL_RECEIVERS_ONLY, error))
		return false;
	model->texels = array_alloc(count, sizeof(*model->texels));
	if (model->texels == NULL || !fin_set_find(&model->fins, light->scene, &light->frame, shape,
					     light->options.map_size, false))
		return error_no_memory(error);
	for (size_t i = 0; i < count; i++)
		model->texels[i] = (struct soft_texel){1.0f, 1.0f};
	fins_draw(&model->fins, light, keep_least, model);
	return true;
}

static bool smoothie_init(void *state, const struct model_light *light, struct sm_error *error)
{
	struct smoothie_model *model = state;
	const struct fin_shape shape = {
		.width = light->options.width, .share = SMOOTHIE_WIDTH_SHARE};
	return fill(model, light, &shape, error);
}

static bool penumbra_map_init(void *state, const struct model_light *light, struct sm_error *error)
{
	struct smoothie_model *model = state;
	const struct fin_shape shape = {.share = 1.0f};
	model->cone = true;
	return fill(model, light, &shape, error);
}

static void finish(void *state)
{
	struct smoothie_model *model = state;
	free(model->texels);
	fin_set_finish(&model->fins);
	model_map_finish(&model->receivers);
	model_map_finish(&model->casters);
}

/* At each of the four nearest texels: behind the shadow map, else behind a smoothie, else lit. */
static double visibility(const void *state, const struct receiver *receiver)
{
	const struct smoothie_model *model = state;
	const struct model_light *light = model->light;
	struct taps taps = taps_at(receiver->at, light->size);
	double depth = receiver_depth(receiver, light, REACH_FOUR), sum = 0.0;
	double behind = model_linear_depth(light, depth) - SMOOTHIE_STEP;
	for (int i = 0; i < 4; i++) {
		const struct soft_texel *texel = &model->texels[taps.texels[i]];
		if (model->casters.depths[taps.texels[i]] < depth)
			continue;
		sum += taps.weights[i] * (texel->depth < behind ? texel->value : 1.0);
	}
	return sum;
}

const struct model_technique model_smoothie = {
	.name = "smoothie",
	.state_size = sizeof(struct smoothie_model),
	.init = smoothie_init,
	.finish = finish,
	.visibility = visibility,
};

const struct model_technique model_penumbra_map = {
	.name = "penumbra-map",
	.state_size = sizeof(struct smoothie_model),
	.init = penumbra_map_init,
	.finish = finish,
	.visibility = visibility,
};
