/* SPDX-License-Identifier: MIT */
#include "bench/stress_base.h"
#include "bench/stress_shape.h"

bool stress_base_init(struct stress_scene *scene, enum sm_light_type type, struct sm_error *error)
{
	*scene = (struct stress_scene){
		.lights = {{
			.type = type,
			.position = {1.5f, 4, 1},
			.radius = .25f,
			.angle = 75,
			.softness = .5f,
			.color = {1, 1, 1},
			.intensity = 1,
		}},
		.light_count = 1,
		.camera = {.eye = {-3, 4, 5}, .target = {0, .5f, 0}, .up = {0, 1, 0}, .fov = 40},
		.shadow = {.map_size = 128},
		.width = 64,
		.height = 64,
	};
	struct stress_mesh floor, block, ball;
	if (!stress_shape_square(&floor, error))
		return false;
	struct stress_object *object = stress_scene_add(scene, floor);
	object->casts = false;
	object->scale[0] = object->scale[2] = 3;
	if (!stress_shape_cube(&block, error))
		return false;
	object = stress_scene_add(scene, block);
	object->scale[0] = object->scale[1] = object->scale[2] = .5f;
	object->rotation[1] = 30;
	object->position[1] = 1.25f;
	if (!stress_shape_sphere(&ball, 8, error))
		return false;
	object = stress_scene_add(scene, ball);
	object->scale[0] = object->scale[1] = object->scale[2] = .5f;
	object->position[0] = 1.25f;
	object->position[1] = .5f;
	object->position[2] = -1;
	return true;
}
