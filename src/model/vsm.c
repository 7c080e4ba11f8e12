/* SPDX-License-Identifier: MIT */
/* Variance shadow maps (Donnelly & Lauritzen 2006). */
#include "base/array.h"
#include "base/error.h"
#include "model/technique.h"
#include <stdlib.h>

/* What rounding may take from a variance, with moments of 32 bits. */
#define MIN_VARIANCE 1e-6
/* Shares below this count as none (Lauritzen, GPU Gems 3, chapter 8). */
#define BLEEDING 0.1

/* Mean of depth, and of its square, from the middle of the range. */
struct moments {
	double mean, square;
};

struct vsm {
	const struct model_light *light;
	struct moments *texels; /* owned */
};

static struct moments moments_of(double linear_depth)
{
	double depth = linear_depth - 0.5;
	return (struct moments){depth, depth * depth};
}

/* One direction of the blur. The outermost texels are not blurred, but on the far plane. */
static void blur(const struct moments *from, struct moments *to, int size, int radius, bool upward)
{
	for (int i = 0; i < size * size; i++) {
		int x = i % size, y = i / size;
		struct moments sum = {0.0, 0.0};
		to[i] = moments_of(1.0);
		if (x == 0 || y == 0 || x == size - 1 || y == size - 1)
			continue;
		for (int j = -radius; j <= radius; j++) {
			int along = (upward ? y : x) + j;
			along = along < 0 ? 0 : along < size ? along : size - 1;
			const struct moments *texel =
				&from[upward ? along * size + x : y * size + along];
			sum.mean += texel->mean;
			sum.square += texel->square;
		}
		double count = 2.0 * radius + 1.0;
		to[i] = (struct moments){sum.mean / count, sum.square / count};
	}
}

/* Nearest casters, and where there are none the farthest receivers. */
static void find_moments(const struct vsm *vsm, const struct model_map *casters,
	const struct model_map *receivers, struct moments *moments)
{
	int size = vsm->light->size;
	for (int i = 0; i < size * size; i++) {
		float depth = casters->depths[i];
		if (depth == 1.0f && receivers->depths[i] > 0.0f)
			depth = receivers->depths[i];
		moments[i] = moments_of(model_linear_depth(vsm->light, depth));
	}
}

static bool init(void *state, const struct model_light *light, struct sm_error *error)
{
	struct vsm *vsm = state;
	struct model_map casters = {0}, receivers = {0};
	size_t count = (size_t)light->size * (size_t)light->size;
	struct moments *rows = array_alloc(count, sizeof(*rows));
	int radius = (int)light->options.samples / 2;
	vsm->light = light;
	vsm->texels = array_alloc(count, sizeof(*vsm->texels));
	bool done = rows != NULL && vsm->texels != NULL;
	if (!done)
		error_no_memory(error);
	done = done && model_map_init(&casters, light, MODEL_CASTERS, error) &&
	       model_map_init(&receivers, light, MODEL_FARTHEST_RECEIVERS, error);
	if (done) {
		find_moments(vsm, &casters, &receivers, vsm->texels);
		blur(vsm->texels, rows, light->size, radius, false);
		blur(rows, vsm->texels, light->size, radius, true);
	}
	model_map_finish(&casters);
	model_map_finish(&receivers);
	free(rows);
	return done;
}

static void finish(void *state)
{
	struct vsm *vsm = state;
	free(vsm->texels);
}

/* Chebyshev's inequality. */
static double visibility(const void *state, const struct receiver *receiver)
{
	const struct vsm *vsm = state;
	const struct model_light *light = vsm->light;
	struct taps taps = taps_at(receiver->at, light->size);
	struct moments found = {0.0, 0.0};
	for (int i = 0; i < 4; i++) {
		const struct moments *texel = &vsm->texels[taps.texels[i]];
		found.mean += taps.weights[i] * texel->mean;
		found.square += taps.weights[i] * texel->square;
	}
	double depth = receiver_depth(receiver, light, REACH_FOUR);
	double behind = model_linear_depth(light, depth) - 0.5 - found.mean;
	double variance = fmax(found.square - found.mean * found.mean, MIN_VARIANCE);
	double share = variance / (variance + behind * behind);
	if (behind <= 0.0)
		return 1.0;
	return fmin(fmax((share - BLEEDING) / (1.0 - BLEEDING), 0.0), 1.0);
}

const struct model_technique model_vsm = {
	.name = "vsm",
	.state_size = sizeof(struct vsm),
	.init = init,
	.finish = finish,
	.visibility = visibility,
};
