/* SPDX-License-Identifier: MIT */
#ifndef MODEL_FINS_H
#define MODEL_FINS_H

#include "model/light.h"
#include "scene/fin_set.h"

/** A texel of a fin. */
struct fin_texel {
	int x, y;
	double depth;     /* window depth */
	double offset[2]; /* from the silhouette, NDC */
	double width;     /* NDC; below 0: inside */
};

/** Tells each texel of a map that fins cover, in the order of drawing, but for the outermost
 *  ones. */
void fins_draw(const struct fin_set *fins, const struct model_light *light,
	void (*draw)(void *data, const struct fin_texel *texel), void *data);

#endif
