/* SPDX-License-Identifier: MIT */
/* Fins on both sides of the silhouette: each texel knows the edge that is nearest to it, and a
 * surface sees the part of the light's disc that the edge leaves. */
#include "base/array.h"
#include "base/error.h"
#include "model/fins.h"
#include "model/technique.h"
#include "technique/disc.h"
#include <stdlib.h>

/* Texels that fins are drawn beyond the penumbra. */
#define APRON 1.5f
/* How far beyond the blocker the surface beside it is looked for, texels. */
#define BESIDE 0.75
/* How far from a surface the edge may lie that one of its texels knows, texels. */
#define FIN_REACH 2.0
/* How much farther behind the edge than the surface beside it a receiver may be. */
#define SAME_SURFACE 1.125

/* The edge that is nearest to a texel, as a share of its penumbra there. */
struct edge_texel {
	double offset[2]; /* the way from the edge, texels */
	double depth;     /* window depth of the edge; 1: there is none */
	double beside;    /* of the surface that its shadow falls on */
	float nearness;   /* 0 at the edge; 1: there is none */
	bool inside;      /* of the silhouette */
};

struct two_sided {
	const struct model_light *light;
	struct model_map casters, receivers;
	struct fin_set fins;
	struct edge_texel *texels; /* owned */
	double spread;             /* half-width of a penumbra, texels, over window depth */
};

static double surface_depth(const struct two_sided *model, int x, int y)
{
	return fmin(model_map_at(&model->casters, x, y), model_map_at(&model->receivers, x, y));
}

/* Of the four texels around a place, the one farthest from the light. */
static double farthest_depth(const struct two_sided *model, double x, double y)
{
	int left = (int)floor(x - 0.5), low = (int)floor(y - 0.5);
	double farthest = 0.0;
	for (int i = 0; i < 4; i++)
		farthest = fmax(farthest, surface_depth(model, left + (i & 1), low + (i >> 1)));
	return farthest;
}

static void keep_nearest(void *data, const struct fin_texel *fin)
{
	const struct two_sided *model = data;
	int size = model->light->size;
	struct edge_texel *texel = &model->texels[(size_t)fin->y * (size_t)size + (size_t)fin->x];
	struct edge_texel found = {.depth = fin->depth, .inside = fin->width < 0.0};
	for (int i = 0; i < 2; i++)
		found.offset[i] = fin->offset[i] * 0.5 * size;
	double off = hypot(found.offset[0], found.offset[1]);
	double outward = (found.inside ? -BESIDE : BESIDE) / fmax(off, 1e-6) - 1.0;
	found.beside = farthest_depth(model, fin->x + 0.5 + outward * found.offset[0],
		fin->y + 0.5 + outward * found.offset[1]);
	/* Hidden from the light: no silhouette. */
	if (found.beside < fin->depth - DEPTH_STEP)
		return;
	if (!found.inside)
		found.beside = surface_depth(model, fin->x, fin->y);
	double full = model->spread * fmax(found.beside - fin->depth, 0.0) + APRON;
	if (off >= full || (!found.inside && found.beside <= fin->depth))
		return;
	found.nearness = model_round_depth(off / full);
	if (found.nearness < texel->nearness)
		*texel = found;
}

static bool init(void *state, const struct model_light *light, struct sm_error *error)
{
	static const struct fin_shape shape = {.share = 1.0f, .apron = APRON, .both_sides = true};
	struct two_sided *model = state;
	size_t count = (size_t)light->size * (size_t)light->size;
	model->light = light;
	model->spread = (double)disc_scale(&light->frame) * light->size;
	if (!model_map_init(&model->casters, light, MODEL_CASTERS, error) ||
		!model_map_init(&model->receivers, light, MODEL_RECEIVERS_ONLY, error))
		return false;
	model->texels = array_alloc(count, sizeof(*model->texels));
	if (model->texels == NULL || !fin_set_find(&model->fins, light->scene, &light->frame,
					     &shape, light->options.map_size, false))
		return error_no_memory(error);
	for (size_t i = 0; i < count; i++)
		model->texels[i] = (struct edge_texel){.depth = 1.0, .nearness = 1.0f};
	fins_draw(&model->fins, light, keep_nearest, model);
	return true;
}

static void finish(void *state)
{
	struct two_sided *model = state;
	free(model->texels);
	fin_set_finish(&model->fins);
	model_map_finish(&model->receivers);
	model_map_finish(&model->casters);
}

/* Share of a disc of radius 1 on one side of a line, at s from its centre, [-1, 1]. */
static double disc_area(double s)
{
	return 1.0 - (acos(s) - s * sqrt(1.0 - s * s)) / GLM_PI;
}

/* from: way from the texel's centre to the receiver. */
static double texel_visibility(const struct two_sided *model, const struct receiver *receiver,
	const struct edge_texel *texel, const double from[2], bool lit)
{
	double behind = receiver->depth - texel->depth;
	/* An edge does not darken what is in front of it, nor where the map does not agree on its
	 * sides. */
	if (receiver_depth(receiver, model->light, FIN_REACH) <= texel->depth ||
		lit == texel->inside)
		return lit;
	double off = hypot(texel->offset[0], texel->offset[1]);
	double slope = receiver->depth - receiver_depth(receiver, model->light, 1.0);
	if (texel->inside &&
		behind - slope * (off + FIN_REACH) > SAME_SURFACE * (texel->beside - texel->depth))
		return lit;
	double outward = (texel->offset[0] * (texel->offset[0] + from[0]) +
				 texel->offset[1] * (texel->offset[1] + from[1])) /
			 fmax(off, 1e-6);
	double s = (texel->inside ? -outward : outward) / fmax(model->spread * behind, 1e-6);
	return disc_area(fmin(fmax(s, -1.0), 1.0));
}

static double visibility(const void *state, const struct receiver *receiver)
{
	const struct two_sided *model = state;
	struct taps taps = taps_at(receiver->at, model->light->size);
	double depth = receiver_depth(receiver, model->light, REACH_FOUR), sum = 0.0;
	for (int i = 0; i < 4; i++) {
		double from[2] = {taps.f[0] - (i & 1), taps.f[1] - (i >> 1)};
		bool lit = model->casters.depths[taps.texels[i]] >= depth;
		sum += taps.weights[i] *
		       texel_visibility(model, receiver, &model->texels[taps.texels[i]], from, lit);
	}
	return sum;
}

const struct model_technique model_two_sided = {
	.name = "smoothie-two-sided",
	.state_size = sizeof(struct two_sided),
	.init = init,
	.finish = finish,
	.visibility = visibility,
};
