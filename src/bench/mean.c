/* SPDX-License-Identifier: MIT */
#include "bench/mean.h"
#include <math.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct mean_column columns[] = {
	{"RMSE", "%.4f", offsetof(struct mean, rmse)},
	{"bias", "%+.4f", offsetof(struct mean, bias)},
	{"p99", "%.4f", offsetof(struct mean, p99)},
	{"RMSE of all", "%.4f", offsetof(struct mean, all_rmse)},
	{"wrong outside", "%.0f", offsetof(struct mean, outside_wrong)},
	{"flicker", "%.4f", offsetof(struct mean, flicker)},
	{"ms", "%.2f", offsetof(struct mean, ms)},
	{"ms / hard", "%.2f", offsetof(struct mean, ratio)},
	{"ms / pcss-16", "%.2f", offsetof(struct mean, ratio_pcss)},
};

static bool belongs(const struct result *result, const struct result *setting,
	const struct result *technique, const struct result *scene)
{
	return same_setting(result, setting) && same_technique(result, technique) &&
	       (scene == NULL || same_scene(result, scene));
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
	size_t penumbrae = 0, judged = 0; /* scenes that have such pixels */
	for (size_t i = 0; i < list->count; i++) {
		const struct result *result = &list->items[i];
		const struct error_summary *penumbra = &result->error[REGION_PENUMBRA];
		if (!belongs(result, setting, technique, scene))
			continue;
		sum.scenes++;
		sum.ratio += log_time(result->time[THREADS_DEFAULT].ratio);
		sum.ratio_pcss += log_time(result->time[THREADS_DEFAULT].ratio_pcss);
		sum.ms += log_time(result->time[THREADS_DEFAULT].median);
		if (penumbra->pixels > 0) {
			penumbrae++;
			sum.rmse += penumbra->rmse;
			sum.bias += penumbra->bias;
			sum.p99 += penumbra->p99;
		}
		if (result->error[REGION_ALL].pixels > 0) {
			judged++;
			sum.all_rmse += result->error[REGION_ALL].rmse;
			sum.outside_wrong += result->outside_wrong;
			sum.flicker += result->flicker;
		}
	}
	/* No scene makes 0 / 0, which is NAN: not measured. */
	return (struct mean){
		.scenes = sum.scenes,
		.rmse = sum.rmse / (double)penumbrae,
		.bias = sum.bias / (double)penumbrae,
		.p99 = sum.p99 / (double)penumbrae,
		.all_rmse = sum.all_rmse / (double)judged,
		.outside_wrong = sum.outside_wrong / (double)judged,
		.flicker = sum.flicker / (double)judged,
		.ratio = exp(sum.ratio / (double)sum.scenes),
		.ratio_pcss = exp(sum.ratio_pcss / (double)sum.scenes),
		.ms = exp(sum.ms / (double)sum.scenes),
	};
}

bool mean_is_complete(const struct mean *mean)
{
	return mean->scenes > 0 && mean->rmse > 0 && mean->ms > 0;
}

const struct mean_column *mean_column_at(size_t i)
{
	return i < COUNT(columns) ? &columns[i] : NULL;
}

void mean_write(const struct mean_column *column, const struct mean *mean, FILE *file)
{
	double value = *(const double *)(const void *)((const char *)mean + column->offset);
	if (isnan(value))
		fputc('-', file);
	else
		fprintf(file, column->format, value);
}
