/* SPDX-License-Identifier: MIT */
#ifndef MODEL_LAYERS_H
#define MODEL_LAYERS_H

#include "model/light.h"
#include "technique/gather.h"

/** Of the casters at a texel's centre, one that counts (geom/sheets.h). */
struct sheet {
	float depth;     /* window depth; 2, behind all there is: none */
	double slope[2]; /* over window x and y */
};

/** The casters' first sheets as a light sees them. */
struct layers {
	struct sheet *of[GATHER_LAYERS]; /* each behind the one before; [size * size] of the
				     light's, rows from the lower one, owned */
};

/** Draws the layers, of zeroed ones. False: out of memory. */
bool layers_init(struct layers *layers, const struct model_light *light);
/** Fine on zeroed or half-made ones. */
void layers_finish(struct layers *layers);

#endif
