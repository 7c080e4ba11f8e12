/* SPDX-License-Identifier: MIT */
#include "scene/object_watch.h"
#include "base/array.h"
#include "scene/light_reach.h"
#include <stdlib.h>
#include <string.h>

void object_watch_finish(struct object_watch *watch)
{
	free(watch->objects);
	*watch = (struct object_watch){0};
}

void object_watch_forget(struct object_watch *watch)
{
	watch->scene = 0;
}

void object_watch_list_memory(const struct object_watch *watch, const struct memory_list *list)
{
	memory_list_processor(
		list, "objects: as lights saw them", watch->capacity * sizeof(*watch->objects));
}

static bool is_as_before(const struct watched_object *before, const struct object *object)
{
	return before->version == object->version &&
	       memcmp(before->transform, object->transform, sizeof(before->transform)) == 0;
}

/* Middle of the outermost cell. */
#define LAST_CELL (1.0f - 1.0f / SCREEN_GRID_SIZE)

/* Whether what is in one of the cells may depend on an object that is here on the screen; beside
 * that, the nearest cells count: what it throws may reach into them. */
static bool is_seen(const struct screen_grid *seen, const struct screen_box *box)
{
	float min[2], max[2];
	for (int axis = 0; axis < 2; axis++) {
		min[axis] = fminf(fmaxf(box->min[axis], -LAST_CELL), LAST_CELL);
		max[axis] = fminf(fmaxf(box->max[axis], -LAST_CELL), LAST_CELL);
	}
	return screen_grid_touches(seen, min, max);
}

/* before: NULL for an object that was not known. */
static struct watched_object look_at(const struct object_watch *watch,
	const struct watched_object *before, const struct sm_scene *scene,
	const struct light_frame *frame, const struct object *object, bool shown)
{
	struct watched_object now = {
		.version = object->version, .box = disc_box_none(), .shown = shown};
	bool same = before != NULL && is_as_before(before, object);
	if (same)
		now = *before;
	now.changed = !same;
	if (same && !before->left_out)
		return now;
	glm_mat4_copy((vec4 *)object->transform, now.transform);
	if (shown && !same)
		now.box = mesh_disc_box(&scene->meshes[object->mesh], now.transform, frame);
	now.left_out = shown && watch->seen != NULL && !is_seen(watch->seen, &now.box.box);
	now.changed = !same || !now.left_out;
	return now;
}

static void look_again(struct object_watch *watch, size_t index, bool known,
	const struct sm_scene *scene, const struct light_frame *frame, bool shown,
	struct disc_box *changed)
{
	struct watched_object *object = &watch->objects[index];
	struct watched_object now =
		look_at(watch, known ? object : NULL, scene, frame, &scene->objects[index], shown);
	bool tested = shown && watch->seen != NULL && (now.changed || now.left_out);
	if (known && now.changed && !object->left_out)
		disc_box_add(changed, &object->box);
	if (now.changed && !now.left_out)
		disc_box_add(changed, &now.box);
	watch->left_out_count += now.left_out;
	watch->seen_tested += tested;
	watch->seen_left_out += tested && now.left_out;
	*object = now;
}

bool object_watch_look(struct object_watch *watch, const struct sm_scene *scene,
	const struct light_frame *frame, bool (*shows)(const struct object *),
	struct disc_box *changed)
{
	bool known = watch->scene == scene->id && watch->count <= scene->object_count &&
		     light_frame_is_same(&watch->frame, frame);
	size_t count = known ? watch->count : 0;
	watch->scene = 0;
	*changed = known ? disc_box_none() : disc_box_all();
	if (!array_reserve((void **)&watch->objects, &watch->capacity, scene->object_count,
		    sizeof(*watch->objects)))
		return false;
	watch->left_out_count = watch->seen_tested = watch->seen_left_out = 0;
	for (size_t i = 0; i < scene->object_count; i++)
		look_again(watch, i, i < count, scene, frame, shows(&scene->objects[i]), changed);
	watch->count = scene->object_count;
	watch->frame = *frame;
	watch->scene = scene->id;
	return true;
}

bool object_watch_lacks(const struct object_watch *watch, const struct screen_grid *seen)
{
	for (size_t i = 0; i < watch->count && watch->left_out_count > 0; i++) {
		const struct watched_object *object = &watch->objects[i];
		if (object->left_out && is_seen(seen, &object->box.box))
			return true;
	}
	return false;
}
