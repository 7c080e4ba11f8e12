/* SPDX-License-Identifier: MIT */
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include "scene/scene.h"

/** World to clip space for a picture of width x height pixels; near and far follow from the
 *  scene's bounds where the camera leaves them 0. Fails (INPUT) on a camera that sees nothing. */
bool camera_world_to_clip(const struct sm_camera *camera, const struct sm_scene *scene,
	uint32_t width, uint32_t height, mat4 world_to_clip, struct sm_error *error);

#endif
