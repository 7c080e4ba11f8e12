/* SPDX-License-Identifier: MIT */
#ifndef LOAD_DEFAULTS_H
#define LOAD_DEFAULTS_H

#include <smoothie.h>

struct model_light;

/** Where a scene's casters are, from which defaults follow. */
struct frame {
	float min[3], max[3];
	float center[3];
	float radius; /**< of the sphere about the box, > 0 */
	float ground; /**< height of the plane that takes their shadows */
};

/** box: min and max of the casters. ground: NaN for the lowest point of the casters. */
void frame_init(struct frame *frame, const float box[2][3], float ground);

/** Puts a light of a model, which is in world space already, in the terms of a scene's light:
 *  a target in the middle of what it shines on, and the illuminance there. NaN: left open. */
void frame_model_light(
	const struct frame *frame, const struct model_light *light, struct sm_light_desc *desc);

/** Fills what is NaN in a light: the spot that photographers call key light. */
void frame_complete_light(const struct frame *frame, struct sm_light_desc *light);

/**
 * Fills what is NaN in a camera: a three-quarter view from a bit above, as near as the casters and
 * the shadows that the light throws from them fit into the picture.
 *
 * aspect: width of the picture over its height.
 */
void frame_complete_camera(const struct frame *frame, const struct sm_light_desc *light,
	float aspect, struct sm_camera *camera);

#endif
