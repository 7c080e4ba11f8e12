/* SPDX-License-Identifier: MIT */
#include "model/light.h"

struct raster_area model_map_area(const struct model_light *light)
{
	int size = light->size;
	return (struct raster_area){
		.width = size,
		.height = size,
		.min = {1, 1},
		.max = {size - 1, size - 1},
		.snap_bits = light->snap_bits,
	};
}

double model_linear_depth(const struct model_light *light, double depth)
{
	double k = light->frame.near_to_far;
	return depth * k / (1.0 - depth * (1.0 - k));
}
