/* SPDX-License-Identifier: MIT */
#ifndef SCENE_OBJECT_WATCH_H
#define SCENE_OBJECT_WATCH_H

#include "base/memory_list.h"
#include "geom/disc_box.h"
#include "geom/screen_grid.h"
#include "scene/light.h"

/** An object as it was when it was last looked at. */
struct watched_object {
	uint64_t version;
	mat4 transform; /* the same version has another where the scene is counted from elsewhere */
	struct disc_box box; /* on the light's screen */
	bool shown;          /* is one of those that are watched */
	bool left_out;       /* though it is: nothing looks up where it is on the screen */
	bool changed;        /* since it was looked at before */
};

/** What a light's textures show, so that they are drawn anew only where that has changed: which
 *  objects move is learnt from their versions. Zero shows nothing. */
struct object_watch {
	uint64_t scene; /* id; 0: nothing is known */
	struct light_frame frame;
	struct watched_object *objects; /* owned */
	size_t count, capacity;
	/* For the caller to set: cells of the screen beside which nothing is looked up, for the
	 * next looks; not owned. NULL: all may be. */
	const struct screen_grid *seen;
	size_t left_out_count;
	size_t seen_tested, seen_left_out; /* of the last look: objects tested, and left out */
};

void object_watch_finish(struct object_watch *watch);

/** All is to be drawn anew. */
void object_watch_forget(struct object_watch *watch);

void object_watch_list_memory(const struct object_watch *watch, const struct memory_list *list);

/** Looks at the objects, of which those count that `shows` is true for. changed: set to a bound on
 *  where on the light's screen they, before or now, show otherwise than at the last look; all of
 *  it, if the light is another, or nothing is known. Those beside what is seen are left out, but
 *  for what is shown and has not changed; one that was, and is not any more, has changed. False:
 * out of memory, and nothing is known. */
bool object_watch_look(struct object_watch *watch, const struct sm_scene *scene,
	const struct light_frame *frame, bool (*shows)(const struct object *),
	struct disc_box *changed);

/** Whether an object that is left out touches one of these cells of the screen. */
bool object_watch_lacks(const struct object_watch *watch, const struct screen_grid *seen);

#endif
