/* SPDX-License-Identifier: MIT */
#ifndef MODEL_LIGHT_H
#define MODEL_LIGHT_H

#include "model/raster.h"
#include "scene/light.h"

/** What of a light every technique asks for. */
struct model_light {
	const struct sm_scene *scene;
	struct light_frame frame;
	struct sm_shadow_options options; /* every 0 replaced by its default */
	int size;                         /* texels a side of its maps */
	int snap_bits;                    /* of struct raster_area */
};

/** The whole of a map but for its outermost texels. */
struct raster_area model_map_area(const struct model_light *light);

/** (z - near) / (far - near) from window depth. */
double model_linear_depth(const struct model_light *light, double depth);

#endif
