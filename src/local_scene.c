/* SPDX-License-Identifier: MIT */
#include "local_scene.h"
#include "base/array.h"
#include "base/error.h"
#include <stdlib.h>
#include <string.h>

/* Cells of the grid, in distances from eye to target: then 17 of 24 bits are left for that
 * distance. */
#define CELL_DISTANCES 64.0f

/* False: it is the origin. */
static bool find_anchor(const struct sm_camera *camera, vec3 anchor)
{
	float distance = glm_vec3_distance((float *)camera->eye, (float *)camera->target);
	int exponent;
	frexpf(CELL_DISTANCES * distance, &exponent);
	/* A power of two: subtracting its multiples rounds nothing that is near. */
	float cell = ldexpf(1.0f, exponent);
	bool found = false;
	for (int axis = 0; axis < 3; axis++) {
		/* One zero alone, as two are not the same bits. */
		anchor[axis] = cell * rintf(camera->eye[axis] / cell) + 0.0f;
		/* Of a camera that cannot be, say. */
		if (!isfinite(anchor[axis])) {
			glm_vec3_zero(anchor);
			return false;
		}
		found = found || anchor[axis] != 0.0f;
	}
	return found;
}

static bool copy_parts(struct sm_scene *copy, const struct sm_scene *scene, struct sm_error *error)
{
	struct sm_scene parts = *scene;
	parts.objects = copy->objects;
	parts.lights = copy->lights;
	parts.object_capacity = copy->object_capacity;
	parts.light_capacity = copy->light_capacity;
	bool reserved = array_reserve((void **)&parts.objects, &parts.object_capacity,
				scene->object_count, sizeof(*parts.objects)) &&
			array_reserve((void **)&parts.lights, &parts.light_capacity,
				scene->light_count, sizeof(*parts.lights));
	*copy = parts;
	if (!reserved)
		return error_no_memory(error);
	if (scene->object_count > 0)
		memcpy(copy->objects, scene->objects, scene->object_count * sizeof(*copy->objects));
	if (scene->light_count > 0)
		memcpy(copy->lights, scene->lights, scene->light_count * sizeof(*copy->lights));
	return true;
}

bool local_scene_find(struct local_scene *local, const struct sm_scene *scene,
	const struct sm_camera *camera, struct sm_error *error)
{
	float *anchor = local->anchor;
	local->scene = scene;
	local->camera = *camera;
	if (!find_anchor(camera, anchor))
		return true;
	if (!copy_parts(&local->moved, scene, error))
		return false;
	local->scene = &local->moved;
	for (size_t i = 0; i < scene->object_count; i++) {
		struct object *object = &local->moved.objects[i];
		glm_vec3_sub(object->transform[3], anchor, object->transform[3]);
		object_update_bounds(scene, object);
	}
	for (size_t i = 0; i < scene->light_count; i++) {
		struct sm_light_desc *light = &local->moved.lights[i].desc;
		glm_vec3_sub(light->position, anchor, light->position);
		glm_vec3_sub(light->target, anchor, light->target);
	}
	glm_vec3_sub(local->camera.eye, anchor, local->camera.eye);
	glm_vec3_sub(local->camera.target, anchor, local->camera.target);
	return true;
}

void local_scene_finish(struct local_scene *local)
{
	free(local->moved.objects);
	free(local->moved.lights);
	*local = (struct local_scene){0};
}
