/* SPDX-License-Identifier: MIT */
#include "load/actor.h"
#include "load/motion.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool has_rig(const struct actor *actor)
{
	return actor->model->rig.node_count > 0;
}

/* By name, or else by number; NULL: there is none. */
static const struct clip *find_clip(const struct rig *rig, const char *text)
{
	for (size_t i = 0; i < rig->clip_count; i++)
		if (strcmp(rig->clips[i].name, text) == 0)
			return &rig->clips[i];
	size_t digits = strspn(text, "0123456789");
	if (digits == 0 || digits > 9 || text[digits] != '\0')
		return NULL;
	size_t index = strtoul(text, NULL, 10);
	return index < rig->clip_count ? &rig->clips[index] : NULL;
}

static void list_clips(const struct rig *rig, char *text, size_t size)
{
	size_t used = (size_t)snprintf(text, size, "%s", rig->clip_count > 0 ? "" : "none");
	for (size_t i = 0; i < rig->clip_count && used < size; i++)
		used += (size_t)snprintf(
			text + used, size - used, "%s%.40s", i > 0 ? ", " : "", rig->clips[i].name);
}

static bool choose_clip(struct actor *actor, const struct plan_object *plan, const char *source,
	struct sm_error *error)
{
	const struct rig *rig = &actor->model->rig;
	const char *wanted = plan->animation;
	if (wanted == NULL && rig->clip_count > 0)
		actor->clip = &rig->clips[0];
	if (wanted == NULL || strcmp(wanted, "none") == 0)
		return true;
	actor->clip = find_clip(rig, wanted);
	if (actor->clip != NULL)
		return true;
	char known[200];
	list_clips(rig, known, sizeof(known));
	return error_set(error, SM_ERROR_INPUT,
		"%s: [object %s] no animation is called \"%.40s\"; known: %s", source, plan->name,
		wanted, known);
}

bool actor_init(struct actor *actor, const struct plan_object *plan, struct model *model,
	const char *source, struct sm_error *error)
{
	*actor = (struct actor){.plan = *plan, .model = model};
	actor->plan.name = actor->plan.model = actor->plan.animation = NULL;
	return choose_clip(actor, plan, source, error) &&
	       (!has_rig(actor) || pose_init(&actor->pose, &model->rig, model->meshes, error));
}

void actor_finish(struct actor *actor)
{
	if (actor->model != NULL)
		pose_finish(&actor->pose, &actor->model->rig);
	model_destroy(actor->model);
	*actor = (struct actor){0};
}

/* The part of a turn of the object and its part about each axis come from the time at rest, so that
 * nothing adds up. */
static void find_transform(const struct plan_object *plan, double seconds, float transform[16])
{
	float position[3], rotation[3];
	mat4 turned, rest;
	motion_point(&plan->path, seconds, plan->center, plan->position, position);
	for (int i = 0; i < 3; i++)
		rotation[i] = (float)(plan->rotation[i] + fmod(plan->spin[i] * seconds, 360));
	model_transform(position, rotation, plan->scale, transform);
	double phase = motion_phase(seconds, plan->path.orbit);
	if (phase == 0)
		return;
	memcpy(rest, transform, sizeof(rest));
	glm_vec3_zero(rest[3]);
	glm_rotate_make(turned, (float)(2 * M_PI * phase), GLM_YUP);
	glm_mat4_mul(turned, rest, turned);
	glm_vec3_copy(position, turned[3]);
	memcpy(transform, turned, sizeof(turned));
}

static void placement_at(
	const struct actor *actor, double seconds, struct model_placement *placement)
{
	const struct plan_object *plan = &actor->plan;
	*placement = (struct model_placement){.casts = plan->casts, .receives = plan->receives};
	memcpy(placement->color, plan->color, sizeof(placement->color));
	find_transform(plan, seconds, placement->transform);
}

/* The clip's time counts from 0 at the scene's. */
static void find_pose(struct actor *actor, double seconds)
{
	if (has_rig(actor))
		pose_find(&actor->pose, &actor->model->rig, actor->model->meshes, actor->clip,
			seconds * (double)actor->plan.speed);
}

bool actor_place(
	struct actor *actor, const char *name, struct sm_scene *scene, struct sm_error *error)
{
	struct model_placement placement;
	actor->first_object = sm_scene_object_count(scene);
	actor->first_mesh = sm_scene_mesh_count(scene);
	placement_at(actor, 0, &placement);
	placement.name = name;
	return model_place(actor->model, &placement, scene, error) &&
	       (!has_rig(actor) || actor_set_time(actor, 0, scene, error));
}

void actor_grow_box(struct actor *actor, bool casters_only, float box[2][3])
{
	enum { POSES = 16 };
	double duration = actor->clip != NULL ? actor->clip->duration : 0;
	struct model_placement placement;
	placement_at(actor, 0, &placement);
	for (int i = 0; i < (duration > 0 ? POSES : 1); i++) {
		/* From its start to its very end, which is where it starts again. */
		double time = fmin(duration * i / (POSES - 1), nextafter(duration, 0));
		if (has_rig(actor))
			pose_find(&actor->pose, &actor->model->rig, actor->model->meshes,
				actor->clip, time);
		model_grow_box(actor->model, has_rig(actor) ? &actor->pose : NULL, &placement,
			casters_only, box);
	}
	find_pose(actor, 0);
}

void actor_node_transform(const struct actor *actor, uint32_t node, double seconds, mat4 transform)
{
	struct model_placement placement;
	mat4 inner;
	placement_at(actor, seconds, &placement);
	memcpy(transform, placement.transform, sizeof(placement.transform));
	if (!has_rig(actor))
		return;
	memcpy(inner, actor->pose.nodes[node], sizeof(inner));
	glm_mat4_mul(transform, inner, transform);
}

void actor_rest_transform(const struct actor *actor, uint32_t node, mat4 transform)
{
	struct model_placement placement;
	mat4 rest;
	rig_node_rest(&actor->model->rig, node, rest);
	if (matrix_invert(rest, rest)) {
		actor_node_transform(actor, node, 0, transform);
		glm_mat4_mul(transform, rest, transform);
		return;
	}
	/* A node without size: nobody can tell where things are in it. */
	placement_at(actor, 0, &placement);
	memcpy(transform, placement.transform, sizeof(placement.transform));
}

static bool is_animated(const struct actor *actor)
{
	return actor->clip != NULL && actor->clip->duration > 0 && actor->plan.speed != 0;
}

bool actor_moves(const struct actor *actor)
{
	const float *spin = actor->plan.spin;
	return is_animated(actor) || motion_moves(&actor->plan.path) || spin[0] != 0 ||
	       spin[1] != 0 || spin[2] != 0;
}

static bool set_vertices(const struct actor *actor, struct sm_scene *scene, struct sm_error *error)
{
	const struct rig *rig = &actor->model->rig;
	for (size_t i = 0; i < rig->shape_count; i++) {
		const struct posed_vertices *vertices = &actor->pose.shapes[i];
		if (!sm_scene_set_vertices(scene, actor->first_mesh + rig->shapes[i].mesh,
			    vertices->positions, vertices->normals, error))
			return false;
	}
	return true;
}

bool actor_set_time(
	struct actor *actor, double seconds, struct sm_scene *scene, struct sm_error *error)
{
	const struct model *model = actor->model;
	struct model_placement placement;
	placement_at(actor, seconds, &placement);
	find_pose(actor, seconds);
	for (size_t i = 0; i < model->object_count; i++) {
		float transform[16];
		model_object_transform(
			model, has_rig(actor) ? &actor->pose : NULL, &placement, i, transform);
		if (!sm_scene_set_transform(
			    scene, actor->first_object + (uint32_t)i, transform, error))
			return false;
	}
	return !has_rig(actor) || set_vertices(actor, scene, error);
}
