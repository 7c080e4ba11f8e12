/* SPDX-License-Identifier: MIT */
#include "bench/paper_fit.h"
#include <math.h>

/* Sums of pairs, about their means. */
struct moments {
	size_t count;
	double mean_x, mean_y, xx, yy, xy;
};

/* Welford's way, one pair at a time. */
static void add(struct moments *moments, double x, double y)
{
	moments->count++;
	double n = (double)moments->count, dx = x - moments->mean_x, dy = y - moments->mean_y;
	moments->mean_x += dx / n;
	moments->mean_y += dy / n;
	moments->xx += dx * (x - moments->mean_x);
	moments->yy += dy * (y - moments->mean_y);
	moments->xy += dx * (y - moments->mean_y);
}

double fit_correlation(const double *x, const double *y, size_t count)
{
	struct moments moments = {0};
	for (size_t i = 0; i < count; i++)
		if (isfinite(x[i]) && isfinite(y[i]))
			add(&moments, x[i], y[i]);
	if (moments.count < 3 || !(moments.xx > 0) || !(moments.yy > 0))
		return NAN;
	return moments.xy / sqrt(moments.xx * moments.yy);
}

double fit_exponent(const double *x, const double *y, size_t count)
{
	struct moments moments = {0};
	for (size_t i = 0; i < count; i++)
		if (x[i] > 0 && y[i] > 0)
			add(&moments, log(x[i]), log(y[i]));
	return moments.count >= 3 && moments.xx > 0 ? moments.xy / moments.xx : NAN;
}

bool fit_two(
	const double *x1, const double *x2, const double *y, size_t count, double *p, double *q)
{
	double aa = 0, ab = 0, bb = 0, ay = 0, by = 0;
	for (size_t i = 0; i < count; i++) {
		if (!(x1[i] > 0) || !(x2[i] > 0) || !(y[i] > 0))
			continue;
		double a = x1[i] / y[i], b = x2[i] / y[i];
		aa += a * a;
		ab += a * b;
		bb += b * b;
		ay += a;
		by += b;
	}
	double determinant = aa * bb - ab * ab;
	/* As good as parallel: rounding alone would decide. */
	if (!(determinant > 1e-9 * aa * bb))
		return false;
	*p = (ay * bb - by * ab) / determinant;
	*q = (aa * by - ab * ay) / determinant;
	return true;
}
