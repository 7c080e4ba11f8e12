/* SPDX-License-Identifier: MIT */
#ifndef LOAD_ACTOR_H
#define LOAD_ACTOR_H

#include "load/model.h"
#include "load/plan.h"
#include <cglm/cglm.h>

/** An object of a plan, and what shows it in a scene. */
struct actor {
	struct plan_object plan;           /**< without its texts */
	struct model *model;               /**< owned */
	const struct clip *clip;           /**< of the model; NULL: it is at rest */
	struct pose pose;                  /**< empty when the model has no rig */
	uint32_t first_object, first_mesh; /**< of the scene; the model's others follow */
};

/**
 * Takes over a model. source: what stands in front of an error. Fails (INPUT) on an animation that
 * the model does not have, (MACHINE) without memory. Finish it also then.
 */
bool actor_init(struct actor *actor, const struct plan_object *plan, struct model *model,
	const char *source, struct sm_error *error);
/** Fine on a zeroed one. */
void actor_finish(struct actor *actor);

/** Adds the model to a scene, as it is at time 0. */
bool actor_place(
	struct actor *actor, const char *name, struct sm_scene *scene, struct sm_error *error);

/** As model_grow_box(), at time 0; of an animation around all that it does there. */
void actor_grow_box(struct actor *actor, bool casters_only, float box[2][3]);

/** From the space of a node of the model's rig, or of the model where it has none, to the world at
 *  a time: 0, or that which was set last. */
void actor_node_transform(const struct actor *actor, uint32_t node, double seconds, mat4 transform);
/** From the model's space at rest to the world at time 0, for what goes with a node. */
void actor_rest_transform(const struct actor *actor, uint32_t node, mat4 transform);

bool actor_moves(const struct actor *actor);
/** Puts it where it is at a time, which is finite. Fails (INPUT) where that is too far for
 *  numbers. */
bool actor_set_time(
	struct actor *actor, double seconds, struct sm_scene *scene, struct sm_error *error);

#endif
