/* SPDX-License-Identifier: MIT */
#ifndef MODEL_RECEIVER_H
#define MODEL_RECEIVER_H

#include "model/depth_map.h"
#include "model/view.h"

/** A surface on the light's screen, window coordinates [0, 1]. */
struct receiver {
	int pixel[2];       /* of the picture, from the lower left */
	bool casts;         /* it is a sheet of a caster too */
	double position[3]; /* light space */
	double at[2], depth;
	double slope[2]; /* how window depth grows along window x and y on its plane; their sum is
			    limited */
	double limit;    /* of that sum */
};

/** How far around a surface the texels' centres lie that are compared, texels: the nearest one, or
 *  the four nearest; a twentieth for what rasterisers snap. */
#define REACH_NEAREST 0.55
#define REACH_FOUR 1.05

/** Rounding of depths of 24 bits, and of their interpolation: as common_depth_step.glsl. */
#define DEPTH_STEP (16.0 / 16777216.0)

struct receiver receiver_of(const struct surface *surface, const struct model_light *light);

/** The sum of both slopes. */
double receiver_rise(const struct receiver *receiver);

/** The depth to compare at texels up to `reach` texels around: in front of what the receiver's own
 *  plane may have left there. The second is within [0, 1]. */
double receiver_plane_depth(
	const struct receiver *receiver, const struct model_light *light, double reach);
double receiver_depth(
	const struct receiver *receiver, const struct model_light *light, double reach);

/** The four texels around a place, in order to the right and then up, and their weights. Beside
 *  the map all four are at its border. */
struct taps {
	size_t texels[4]; /* of the map */
	double weights[4];
	double f[2]; /* where the place is between the texels' centres */
};

struct taps taps_at(const double at[2], int size);

/** A map compared as a linear sampler does: the share of the four nearest texels that are not
 *  before the depth, clamped to [0, 1]. */
double model_map_compare(const struct model_map *map, const double at[2], double depth);

#endif
