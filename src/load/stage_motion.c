/* SPDX-License-Identifier: MIT */
#include "load/stage_motion.h"
#include "base/array.h"
#include "load/actor.h"
#include <cglm/cglm.h>
#include <stdlib.h>
#include <string.h>

/** Takes what [motion] turns into the path of the camera or a light. */
static bool resolve_turn(struct plan *plan, const char *source, struct sm_error *error)
{
	bool of_light = plan->motion.turns == PLAN_TURNS_LIGHT;
	const char *name = plan->motion.light;
	if (name != NULL && !of_light)
		return error_set(error, SM_ERROR_INPUT,
			"%s: [motion] light is given, but turns is camera", source);
	size_t light = name != NULL ? plan_find(plan, SECTION_LIGHT, name) : 0;
	if (light == SIZE_MAX) {
		char known[200];
		plan_list_names(plan, SECTION_LIGHT, known, sizeof(known));
		return error_set(error, SM_ERROR_INPUT,
			"%s: [motion] no light is called \"%.40s\"; known: %s", source, name,
			known);
	}
	struct motion_path *path = of_light ? &plan->lights[light].path : &plan->camera.path;
	if (plan->motion.period == 0)
		return true;
	if (path->orbit != 0)
		return error_set(error, SM_ERROR_INPUT,
			"%s: [motion] turns what has an orbit of its own", source);
	path->orbit = plan->motion.period;
	return true;
}

/* ---- links ---- */

/* Nothing is taken along by what stands still or has no size. */
static void link_to(struct stage_link *link, const struct plan_origin *origin,
	const struct stage_motion *motion)
{
	mat4 start;
	*link = (struct stage_link){.actor = SM_NONE};
	if (origin->object == SM_NONE || !actor_moves(&motion->actors[origin->object]))
		return;
	actor_node_transform(&motion->actors[origin->object], origin->node, 0, start);
	if (!matrix_invert(start, start))
		return;
	link->actor = origin->object;
	link->node = origin->node;
	memcpy(link->from_start, start, sizeof(start));
}

/* From where something was at time 0 to where it is taken. False: it stays, in each bit. */
static bool find_way(
	const struct stage_motion *motion, const struct stage_link *link, double seconds, mat4 way)
{
	mat4 start, now;
	if (link->actor == SM_NONE || seconds == 0)
		return false;
	memcpy(start, link->from_start, sizeof(start));
	actor_node_transform(&motion->actors[link->actor], link->node, seconds, now);
	glm_mat4_mul(now, start, way);
	return true;
}

/* ---- the whole ---- */

/* Where someone said where it is, it is not the model's any more. */
static bool is_placed(const struct plan_light *light)
{
	return (light->given >> key_find(SECTION_LIGHT, "position") & 1) ||
	       (light->given >> key_find(SECTION_LIGHT, "target") & 1);
}

static void add_light(struct stage_motion *motion, const struct plan_light *light, size_t index)
{
	struct stage_light *added = &motion->lights[motion->light_count];
	*added = (struct stage_light){
		.light = (uint32_t)index,
		.rest = light->desc,
		.path = light->path,
		.link = {.actor = SM_NONE},
		.aimed = light->origin.aimed,
	};
	/* The scene would copy it each time, and the plan's does not last. */
	added->rest.name = NULL;
	if (!is_placed(light))
		link_to(&added->link, &light->origin, motion);
	motion->light_count += motion_moves(&light->path) || added->link.actor != SM_NONE;
}

bool stage_motion_init(struct stage_motion *motion, struct plan *plan, struct actor *actors,
	const char *source, struct sm_error *error)
{
	*motion = (struct stage_motion){.camera = plan->camera.desc,
		.camera_link = {.actor = SM_NONE},
		.actors = actors,
		.actor_count = plan->object_count};
	if (!resolve_turn(plan, source, error))
		return false;
	motion->camera_path = plan->camera.path;
	motion->lights = array_alloc(plan->light_count, sizeof(*motion->lights));
	if (motion->lights == NULL)
		return error_no_memory(error);
	link_to(&motion->camera_link, &plan->camera.origin, motion);
	for (size_t i = 0; i < plan->light_count; i++)
		add_light(motion, &plan->lights[i], i);
	for (size_t i = 0; i < motion->actor_count; i++)
		if (!actor_moves(&motion->actors[i]))
			actor_finish(&motion->actors[i]);
	return true;
}

void stage_motion_finish(struct stage_motion *motion)
{
	for (size_t i = 0; i < motion->actor_count; i++)
		actor_finish(&motion->actors[i]);
	free(motion->actors);
	free(motion->lights);
	*motion = (struct stage_motion){0};
}

bool stage_motion_moves(const struct stage_motion *motion)
{
	for (size_t i = 0; i < motion->actor_count; i++)
		if (actor_moves(&motion->actors[i]))
			return true;
	return motion_moves(&motion->camera_path) || motion->light_count > 0;
}

static bool set_light(const struct stage_motion *motion, const struct stage_light *moved,
	double seconds, struct sm_scene *scene, struct sm_error *error)
{
	struct sm_light_desc rest = moved->rest, light;
	mat4 way;
	if (find_way(motion, &moved->link, seconds, way)) {
		glm_mat4_mulv3(way, rest.position, 1, rest.position);
		if (moved->aimed)
			glm_mat4_mulv3(way, rest.target, 1, rest.target);
	}
	motion_light(&moved->path, seconds, &rest, &light);
	return sm_scene_set_light(scene, moved->light, &light, error);
}

bool stage_motion_set_time(
	struct stage_motion *motion, double seconds, struct sm_scene *scene, struct sm_error *error)
{
	for (size_t i = 0; i < motion->actor_count; i++)
		if (actor_moves(&motion->actors[i]) &&
			!actor_set_time(&motion->actors[i], seconds, scene, error))
			return false;
	for (size_t i = 0; i < motion->light_count; i++)
		if (!set_light(motion, &motion->lights[i], seconds, scene, error))
			return false;
	return true;
}

void stage_motion_camera(
	const struct stage_motion *motion, double seconds, struct sm_camera *camera)
{
	struct sm_camera rest = motion->camera;
	mat4 way;
	if (find_way(motion, &motion->camera_link, seconds, way)) {
		glm_mat4_mulv3(way, rest.eye, 1, rest.eye);
		glm_mat4_mulv3(way, rest.target, 1, rest.target);
		glm_mat4_mulv3(way, rest.up, 0, rest.up);
	}
	motion_camera(&motion->camera_path, seconds, &rest, camera);
}
