/* SPDX-License-Identifier: MIT */
#ifndef EXACT_SCENE_H
#define EXACT_SCENE_H

#include "fixed/scene.h"
#include "scene/fin_set.h"

/** A scene as the exact passes draw it, of one light and one view. Zero is empty; memory is kept
 *  from one frame to the next. */
struct exact_scene {
	struct fixed_scene fixed;
	/* Working memory; owned */
	struct fin_set fins;
	double (*clip)[4], (*light)[4]; /* of a mesh's vertices */
	size_t clip_capacity, light_capacity;
};

void exact_scene_finish(struct exact_scene *exact);

/** Tells what it holds. */
void exact_scene_list_memory(const struct exact_scene *exact, const struct memory_list *list);

struct exact_view {
	const struct light_frame *frame;
	mat4 world_to_clip;
	uint32_t width, height, map_size; /* up to SM_EXACT_SIZE_MAX */
	float fin_width;                  /* as in struct sm_shadow_options */
	bool sinusoid;
};

/** Overwrites exact->fixed. scene: as light and view were made for. False: out of memory. */
bool exact_scene_find(
	struct exact_scene *exact, const struct sm_scene *scene, const struct exact_view *view);

#endif
