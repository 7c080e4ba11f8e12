/* SPDX-License-Identifier: MIT */
#ifndef SCENE_PENUMBRA_H
#define SCENE_PENUMBRA_H

#include "scene/light.h"

/** A bound on the width of every penumbra that the scene's casters throw on its receivers, in
 *  texels of a map of the light's screen, `map_size` a side. From the boxes of objects: what it
 *  takes grows with their number alone. 0 for a point, and without casters or receivers. */
float penumbra_texels(
	const struct sm_scene *scene, const struct light_frame *frame, uint32_t map_size);

/** Whether a light is drawn with its radius: from a penumbra of more than a texel on, and once it
 * is, down to three quarters of one, so that a width that wavers about one of these changes
 * nothing. */
bool penumbra_shows(float texels, bool shown);

#endif
