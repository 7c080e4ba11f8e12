/* SPDX-License-Identifier: MIT */
#ifndef LOCAL_SCENE_H
#define LOCAL_SCENE_H

#include "scene/scene.h"

/**
 * A scene as seen from near by: far from the origin, floats have no digits left for what is small
 * beside that distance, and matrices that lead there and back lose what there is. So what is drawn
 * counts from an anchor: a place near the camera, on a grid of 64 to 128 times the distance from
 * its eye to its target. Within half of that from the world's origin the anchor is the origin, and
 * the scene its own local scene.
 */
struct local_scene {
	const struct sm_scene *scene; /* the local one: refers to the other's meshes and images */
	struct sm_camera camera;
	vec3 anchor;
	/* Where the scene is not its own: owned */
	struct sm_scene moved;
};

/** Zero is empty; what it holds is kept for the next frame. The scene must outlive its use. Fails
 *  (MACHINE) without memory. */
bool local_scene_find(struct local_scene *local, const struct sm_scene *scene,
	const struct sm_camera *camera, struct sm_error *error);
void local_scene_finish(struct local_scene *local);

#endif
