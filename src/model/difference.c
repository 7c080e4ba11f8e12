/* SPDX-License-Identifier: MIT */
#include "model/difference.h"
#include <math.h>

struct model_difference model_difference(
	const uint16_t *drawn, const uint16_t *model, size_t count, double tolerance)
{
	struct model_difference difference = {0};
	for (size_t i = 0; i < count; i++) {
		double off = fabs((drawn[i] - model[i]) / 65535.0);
		difference.mean += off / (double)count;
		difference.max = fmax(difference.max, off);
		difference.failing += off > tolerance;
	}
	return difference;
}
