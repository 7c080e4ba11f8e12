/* SPDX-License-Identifier: MIT */
#include "bench/mean.h"
#include <math.h>

static bool belongs(const struct result *result, const struct result *setting,
	const struct result *technique, const struct result *scene)
{
	return result->error[REGION_PENUMBRA].pixels > 0 && same_setting(result, setting) &&
	       same_technique(result, technique) && (scene == NULL || same_scene(result, scene));
}

/* A time of 0 was not measured. */
static double log_time(double ms)
{
	return ms > 0 ? log(ms) : NAN;
}

struct mean mean_of(const struct result_list *list, const struct result *setting,
	const struct result *technique, const struct result *scene)
{
	struct mean sum = {0};
	for (size_t i = 0; i < list->count; i++) {
		const struct result *result = &list->items[i];
		if (!belongs(result, setting, technique, scene))
			continue;
		sum.scenes++;
		sum.rmse += result->error[REGION_PENUMBRA].rmse;
		sum.bias += result->error[REGION_PENUMBRA].bias;
		sum.p99 += result->error[REGION_PENUMBRA].p99;
		sum.flicker += result->flicker;
		sum.ratio += log_time(result->time[THREADS_DEFAULT].ratio);
		sum.ms += log_time(result->time[THREADS_DEFAULT].median);
	}
	/* No scene makes 0 / 0, which is NAN: not measured. */
	double count = (double)sum.scenes;
	return (struct mean){
		.scenes = sum.scenes,
		.rmse = sum.rmse / count,
		.bias = sum.bias / count,
		.p99 = sum.p99 / count,
		.flicker = sum.flicker / count,
		.ratio = exp(sum.ratio / count),
		.ms = exp(sum.ms / count),
	};
}

bool mean_is_complete(const struct mean *mean)
{
	return mean->scenes > 0 && mean->rmse > 0 && mean->ms > 0;
}
