/* SPDX-License-Identifier: MIT */
#ifndef LIGHT_KEY_H
#define LIGHT_KEY_H

#include "local_scene.h"
#include "technique/technique.h"

/** How new a set of objects is: neither number is as before once one of them, or its mesh, has
 *  changed, or one has come or gone. */
struct objects_age {
	uint64_t newest; /* version of an object, which is that of its mesh too */
	size_t count;
};

/** Of those that cast, or of all. */
struct objects_age objects_age(const struct sm_scene *scene, bool casters_only);
bool objects_age_is_same(const struct objects_age *a, const struct objects_age *b);

/** What a camera sees, as far as what is drawn for it depends on that. */
struct view_key {
	mat4 world_to_clip;
	uint32_t width, height;
	bool visibility;
};

struct view_key view_key_of(const struct technique_view *view);
bool view_key_is_same(const struct view_key *a, const struct view_key *b);

/** All that a technique makes of a light from: with the same key it would make the same. Zero is of
 *  nothing. */
struct light_key {
	uint64_t scene; /* id */
	vec3 anchor;    /* of the local scene */
	struct objects_age age;
	struct light_frame frame;
	struct view_key view; /* zero where the technique does not draw for one */
};

struct light_key light_key_of(const struct technique *technique, const struct local_scene *local,
	const struct light_frame *frame, const struct technique_view *view);
bool light_key_is_same(const struct light_key *a, const struct light_key *b);

#endif
