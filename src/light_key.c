/* SPDX-License-Identifier: MIT */
#include "light_key.h"
#include <string.h>

struct objects_age objects_age(const struct sm_scene *scene, bool casters_only)
{
	struct objects_age age = {0};
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (casters_only && !object->casts)
			continue;
		age.newest = object->version > age.newest ? object->version : age.newest;
		age.count++;
	}
	return age;
}

bool objects_age_is_same(const struct objects_age *a, const struct objects_age *b)
{
	return a->newest == b->newest && a->count == b->count;
}

struct view_key view_key_of(const struct technique_view *view)
{
	struct view_key key = {
		.width = view->width, .height = view->height, .visibility = view->visibility};
	glm_mat4_copy(view->world_to_clip, key.world_to_clip);
	return key;
}

bool view_key_is_same(const struct view_key *a, const struct view_key *b)
{
	return memcmp(a->world_to_clip, b->world_to_clip, sizeof(a->world_to_clip)) == 0 &&
	       a->width == b->width && a->height == b->height && a->visibility == b->visibility;
}

struct light_key light_key_of(const struct technique *technique, const struct local_scene *local,
	const struct light_frame *frame, const struct technique_view *view)
{
	struct light_key key = {
		.scene = local->scene->id,
		.age = objects_age(local->scene, !technique->reads_receivers),
		.frame = *frame,
	};
	glm_vec3_copy((float *)local->anchor, key.anchor);
	if (technique->prepare_view != NULL)
		key.view = view_key_of(view);
	return key;
}

bool light_key_is_same(const struct light_key *a, const struct light_key *b)
{
	return a->scene == b->scene && memcmp(a->anchor, b->anchor, sizeof(a->anchor)) == 0 &&
	       objects_age_is_same(&a->age, &b->age) && light_frame_is_same(&a->frame, &b->frame) &&
	       view_key_is_same(&a->view, &b->view);
}
