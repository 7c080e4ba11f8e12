/* SPDX-License-Identifier: MIT */
#include "bench/statistics.h"
#include <stdlib.h>

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

void statistics_sort(double *values, size_t count)
{
	if (count > 0)
		qsort(values, count, sizeof(*values), compare);
}

double statistics_percentile(const double *sorted, size_t count, double share)
{
	if (count == 0)
		return 0;
	double rank = share * (double)(count - 1);
	size_t below = (size_t)rank;
	size_t above = below + 1 < count ? below + 1 : below;
	return sorted[below] + (rank - (double)below) * (sorted[above] - sorted[below]);
}

double statistics_median(double *values, size_t count)
{
	statistics_sort(values, count);
	return statistics_percentile(values, count, 0.5);
}
