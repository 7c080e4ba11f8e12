/* SPDX-License-Identifier: MIT */
#ifndef LOAD_STAGE_CLIPS_H
#define LOAD_STAGE_CLIPS_H

#include "load/plan.h"

struct actor;

/** An animation that an object can play. */
struct stage_clip {
	char *object, *name; /**< owned */
	size_t number;       /**< among those of the object's model */
	double seconds;
	size_t nodes, morphs; /**< nodes that it moves, and meshes whose targets it blends */
};

/** What could move by itself, whether it does or not. */
struct stage_clips {
	struct stage_clip *clips; /**< owned, in the order of the objects */
	size_t clip_count;
	size_t skins, bones, targets; /**< skins: meshes on bones; the others of all meshes */
};

/** actors: [plan->object_count]. Fails (MACHINE) without memory; finish it also then. */
bool stage_clips_init(struct stage_clips *clips, const struct plan *plan,
	const struct actor *actors, struct sm_error *error);
/** Fine on a zeroed one. */
void stage_clips_finish(struct stage_clips *clips);

#endif
