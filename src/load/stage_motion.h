/* SPDX-License-Identifier: MIT */
#ifndef LOAD_STAGE_MOTION_H
#define LOAD_STAGE_MOTION_H

#include "load/plan.h"

struct actor;

/** What takes a light or camera of a model along. */
struct stage_link {
	uint32_t actor;       /**< SM_NONE: nothing does */
	uint32_t node;        /**< of its model's rig */
	float from_start[16]; /**< from the world, at time 0, to the node's space */
};

/** A light that moves. */
struct stage_light {
	uint32_t light;            /**< of the scene */
	struct sm_light_desc rest; /**< at time 0; without its name */
	struct motion_path path;
	struct stage_link link;
	bool aimed; /**< its target is taken along as well */
};

/** What moves, and where it is at time 0. */
struct stage_motion {
	struct sm_camera camera;
	struct motion_path camera_path;
	struct stage_link camera_link;
	struct stage_light *lights; /**< owned, in the order of the scene */
	size_t light_count;
	struct actor *actors; /**< owned; those that do not move are empty */
	size_t actor_count;
};

/** Of a plan that is complete. actors: [plan->object_count], taken over. source: what stands in
 *  front of an error. Fails (INPUT) where two things turn one, (MACHINE) without memory; finish it
 *  also then. */
bool stage_motion_init(struct stage_motion *motion, struct plan *plan, struct actor *actors,
	const char *source, struct sm_error *error);
/** Fine on a zeroed one. */
void stage_motion_finish(struct stage_motion *motion);

bool stage_motion_moves(const struct stage_motion *motion);

/** Puts all but the camera where they are at a time, as stage_set_time(). */
bool stage_motion_set_time(struct stage_motion *motion, double seconds, struct sm_scene *scene,
	struct sm_error *error);
/** And then the camera. */
void stage_motion_camera(
	const struct stage_motion *motion, double seconds, struct sm_camera *camera);

#endif
