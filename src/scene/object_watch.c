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

/* before: NULL for an object that was not known. */
static struct watched_object look_at(const struct watched_object *before,
	const struct sm_scene *scene, const struct light_frame *frame, const struct object *object,
	bool shown, struct screen_box *changed)
{
	struct watched_object now = {
		.version = object->version, .box = screen_box_none(), .shown = shown};
	if (before != NULL && is_as_before(before, object)) {
		now = *before;
		now.changed = false;
		return now;
	}
	now.changed = true;
	glm_mat4_copy((vec4 *)object->transform, now.transform);
	if (shown)
		mesh_screen_box(&scene->meshes[object->mesh], now.transform,
			(vec4 *)frame->world_to_clip, &now.box);
	if (before != NULL)
		screen_box_add(changed, &before->box);
	screen_box_add(changed, &now.box);
	return now;
}

bool object_watch_look(struct object_watch *watch, const struct sm_scene *scene,
	const struct light_frame *frame, bool (*shows)(const struct object *),
	struct screen_box *changed)
{
	bool known = watch->scene == scene->id && watch->count <= scene->object_count &&
		     light_frame_is_same(&watch->frame, frame);
	size_t count = known ? watch->count : 0;
	watch->scene = 0;
	*changed = known ? screen_box_none() : screen_box_all();
	if (!array_reserve((void **)&watch->objects, &watch->capacity, scene->object_count,
		    sizeof(*watch->objects)))
		return false;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		watch->objects[i] = look_at(i < count ? &watch->objects[i] : NULL, scene, frame,
			object, shows(object), changed);
	}
	watch->count = scene->object_count;
	watch->frame = *frame;
	watch->scene = scene->id;
	return true;
}
