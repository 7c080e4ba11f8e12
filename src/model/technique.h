/* SPDX-License-Identifier: MIT */
#ifndef MODEL_TECHNIQUE_H
#define MODEL_TECHNIQUE_H

#include "model/receiver.h"

/** What a technique's look-ups come to, without GL. The state is one light's. */
struct model_technique {
	const char *name;  /* of sm_technique_name() */
	size_t state_size; /* zeroed before init */
	bool fits;         /* the light's screen is that of light_frame_fit() */
	bool finds_middle; /* of pixels, where a coarse raster grid has moved their surfaces */
	/** Draws the maps. light outlives the state. */
	bool (*init)(void *state, const struct model_light *light, struct sm_error *error);
	/** Tolerates a half-made or zeroed state. */
	void (*finish)(void *state);
	/** The share of the light that reaches the receiver, but for rounding in [0, 1]. */
	double (*visibility)(const void *state, const struct receiver *receiver);
};

extern const struct model_technique model_smoothie, model_penumbra_map, model_two_sided;
extern const struct model_technique model_hard, model_pcf, model_pcss, model_vsm, model_maps,
	model_gather;

#endif
