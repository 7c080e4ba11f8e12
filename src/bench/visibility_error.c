/* SPDX-License-Identifier: MIT */
#include "bench/visibility_error.h"
#include "base/array.h"
#include "bench/statistics.h"
#include <math.h>
#include <stdlib.h>

static bool is_within(enum region region, float truth)
{
	switch (region) {
	case REGION_LIT:
		return truth >= 1;
	case REGION_UMBRA:
		return truth <= 0;
	case REGION_PENUMBRA:
		return truth > 0 && truth < 1;
	default:
		return !isnan(truth);
	}
}

/* offs: room for the absolute errors of all pixels. */
static struct error_summary sum_up(
	const float *seen, const float *truth, size_t count, enum region region, double *offs)
{
	struct error_summary sum = {0};
	double squares = 0;
	for (size_t i = 0; i < count; i++) {
		if (!is_within(region, truth[i]))
			continue;
		double off = (double)seen[i] - (double)truth[i];
		squares += off * off;
		sum.bias += off;
		offs[sum.pixels++] = fabs(off);
	}
	if (sum.pixels == 0)
		return ERROR_NONE;
	sum.rmse = sqrt(squares / (double)sum.pixels);
	sum.bias /= (double)sum.pixels;
	statistics_sort(offs, sum.pixels);
	sum.p95 = statistics_percentile(offs, sum.pixels, 0.95);
	sum.p99 = statistics_percentile(offs, sum.pixels, 0.99);
	sum.max = offs[sum.pixels - 1];
	return sum;
}

bool visibility_error(const float *seen, const float *truth, size_t count,
	struct error_summary error[REGIONS], struct sm_error *failure)
{
	double *offs = array_alloc(count, sizeof(*offs));
	if (offs == NULL)
		return error_no_memory(failure);
	for (int region = 0; region < REGIONS; region++)
		error[region] = sum_up(seen, truth, count, region, offs);
	free(offs);
	return true;
}

double visibility_outside_wrong(const float *seen, const float *truth, size_t count)
{
	size_t wrong = 0, judged = 0;
	for (size_t i = 0; i < count; i++) {
		bool outside = is_within(REGION_LIT, truth[i]) || is_within(REGION_UMBRA, truth[i]);
		wrong += outside && fabs((double)seen[i] - (double)truth[i]) > ERROR_WRONG;
		judged += is_within(REGION_ALL, truth[i]);
	}
	return judged > 0 ? (double)wrong : NAN;
}

double visibility_flicker(struct visibility_pair before, struct visibility_pair after, size_t count)
{
	double sum = 0;
	size_t pixels = 0;
	for (size_t i = 0; i < count; i++) {
		double true_change = (double)after.truth[i] - (double)before.truth[i];
		if (isnan(true_change))
			continue;
		sum += fabs((double)after.seen[i] - (double)before.seen[i] - true_change);
		pixels++;
	}
	return pixels > 0 ? sum / (double)pixels : NAN;
}
