/* SPDX-License-Identifier: MIT */
#ifndef SCENE_DRAW_ORDER_H
#define SCENE_DRAW_ORDER_H

#include "scene/scene.h"

struct draw_item {
	const struct object *object; /* of the scene */
	float farthest;              /* w of clip space */
};

/** The objects of a scene in the order of drawing: what ends nearer to the eye first, so that the
 *  ground, which reaches farther than what stands on it, is shaded only where it is seen. Kept
 *  between frames for its memory; zero is empty. */
struct draw_order {
	struct draw_item *items; /* owned */
	size_t count, capacity;
};

/** False: out of memory. */
bool draw_order_find(struct draw_order *order, const struct sm_scene *scene, mat4 world_to_clip);
void draw_order_finish(struct draw_order *order);

#endif
