/* SPDX-License-Identifier: MIT */
#include "load/stage.h"
#include "base/array.h"
#include "load/actor.h"
#include "load/builtin.h"
#include "load/defaults.h"
#include "load/import.h"
#include "load/scene_file.h"
#include "load/setting.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char builtin_prefix[] = "builtin:";

/** A stage under construction. */
struct builder {
	const char *source;
	struct plan plan;
	struct actor *actors;       /* [plan.object_count], may be NULL */
	struct model_light *lights; /* [plan.light_count] if they come from models, else NULL */
	size_t light_count, light_capacity;
	struct sm_scene *scene;
	struct frame frame;
};

static bool is_builtin(const char *source)
{
	return strncmp(source, builtin_prefix, strlen(builtin_prefix)) == 0;
}

/** A scene of one object, called like the file without folder and extension. */
static bool plan_single(struct plan *plan, const char *source, struct sm_error *error)
{
	const char *slash = strrchr(source, '/');
	const char *start = is_builtin(source) ? source + strlen(builtin_prefix)
			    : slash != NULL    ? slash + 1
					       : source;
	char name[100];
	snprintf(name, sizeof(name), "%s", start);
	char *dot = strrchr(name, '.');
	if (dot != NULL && dot > name)
		*dot = '\0';
	struct plan_object *object = plan_add_object(plan, name, error);
	if (object == NULL)
		return false;
	object->model = strdup(source);
	return object->model != NULL || error_no_memory(error);
}

static bool read_source(struct builder *builder, struct sm_error *error)
{
	const char *source = builder->source;
	return is_builtin(source) || !scene_file_is(source)
		       ? plan_single(&builder->plan, source, error)
		       : scene_file_read(source, &builder->plan, error);
}

static struct model *load_model(const struct plan_object *object, struct sm_error *error)
{
	struct model *model = model_create(error);
	if (model == NULL)
		return NULL;
	bool ok = is_builtin(object->model)
			  ? builtin_build(object->model + strlen(builtin_prefix), model, error)
			  : import_model(object->model, object->up, model, error);
	if (ok)
		return model;
	model_destroy(model);
	return NULL;
}

static bool load_actors(struct builder *builder, struct sm_error *error)
{
	struct plan *plan = &builder->plan;
	builder->actors = array_zalloc(plan->object_count, sizeof(*builder->actors));
	if (builder->actors == NULL)
		return error_no_memory(error);
	if (plan->object_count == 0)
		return error_set(error, SM_ERROR_INPUT, "%s: no [object NAME], so nothing to draw",
			builder->source);
	for (size_t i = 0; i < plan->object_count; i++) {
		const struct plan_object *object = &plan->objects[i];
		if (object->model == NULL)
			return error_set(error, SM_ERROR_INPUT, "%s: [object %s] has no model",
				builder->source, object->name);
		struct model *model = load_model(object, error);
		if (model == NULL ||
			!actor_init(&builder->actors[i], object, model, builder->source, error))
			return false;
	}
	return true;
}

/** Takes what models suggest and the plan leaves open, but for lights. */
static void adopt_suggestions(struct builder *builder)
{
	struct plan *plan = &builder->plan;
	bool has_camera = false, has_ground = false;
	for (size_t i = 0; i < plan->object_count; i++) {
		const struct model *model = builder->actors[i].model;
		has_camera = has_camera || model->has_camera;
		if (model->ground_size > 0) {
			has_ground = true;
			if (isnan(plan->ground.height))
				plan->ground.height = 0;
			if (isnan(plan->ground.size))
				plan->ground.size = model->ground_size;
		}
		if (model->has_camera && plan->output.width == 0) {
			plan->output.width = model->width;
			plan->output.height = model->height;
		}
	}
	if (plan->ground.show == PLAN_SHOW_AUTO)
		plan->ground.show = has_ground || !has_camera ? PLAN_SHOW_YES : PLAN_SHOW_NO;
	if (plan->output.width == 0) {
		plan->output.width = 1280;
		plan->output.height = 960;
	}
}

/** The ground comes first, as a square of side 1 that gets its place when the rest has its own. */
static bool add_ground(struct builder *builder, struct sm_error *error)
{
	static const float positions[4][3] = {
		{-.5f, 0, .5f}, {.5f, 0, .5f}, {.5f, 0, -.5f}, {-.5f, 0, -.5f}};
	static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
	const struct sm_mesh_desc mesh = {
		.name = "ground",
		.positions = *positions,
		.vertex_count = 4,
		.indices = indices,
		.index_count = 6,
	};
	struct sm_object_desc object = {
		.name = "ground",
		.transform = {[0] = 1, [5] = 1, [10] = 1, [15] = 1},
		.image = SM_NONE,
		.receives = true,
	};
	if (builder->plan.ground.show == PLAN_SHOW_NO)
		return true;
	memcpy(object.base_color, builder->plan.ground.color, sizeof(builder->plan.ground.color));
	uint32_t handle;
	return sm_scene_add_mesh(builder->scene, &mesh, &object.mesh, error) &&
	       sm_scene_add_object(builder->scene, &object, &handle, error);
}

static bool place_ground(const struct builder *builder, struct sm_error *error)
{
	const struct frame *frame = &builder->frame;
	const struct plan_ground *ground = &builder->plan.ground;
	const float radii = 60; /* reaches out of the default camera's picture */
	float size = isnan(ground->size) ? radii * frame->radius : ground->size;
	bool is_at_origin = !isnan(ground->height) && !isnan(ground->size);
	vec3 position = {is_at_origin ? 0 : frame->center[0], frame->ground,
		is_at_origin ? 0 : frame->center[2]};
	float transform[16];
	if (ground->show == PLAN_SHOW_NO)
		return true;
	model_transform(position, GLM_VEC3_ZERO, (vec3){size, 1, size}, transform);
	return sm_scene_set_transform(builder->scene, 0, transform, error);
}

/** Products of two lengths must stay well below the largest float, 3.4e38. */
static bool check_place(
	const char *source, const char *what, const float point[3], struct sm_error *error)
{
	for (int i = 0; i < 3; i++)
		if (!(fabsf(point[i]) <= 1e15f))
			return error_set(error, SM_ERROR_INPUT,
				"%s: %s is farther than 1e15 from the origin", source, what);
	return true;
}

static bool check_view(const char *source, const struct sm_camera *camera, struct sm_error *error)
{
	return check_place(source, "the camera's eye", camera->eye, error) &&
	       check_place(source, "the camera's target", camera->target, error) &&
	       check_place(source, "the tip of the camera's up", camera->up, error);
}

/** Takes a light of a model into the plan, with its place in the world. */
static bool adopt_light(struct builder *builder, uint32_t object, const struct model_light *source,
	struct sm_error *error)
{
	const float *scale = builder->plan.objects[object].scale;
	const char *name = source->desc.name != NULL ? source->desc.name : "light";
	if (!array_reserve((void **)&builder->lights, &builder->light_capacity,
		    builder->light_count + 1, sizeof(*builder->lights)))
		return error_no_memory(error);
	struct plan_light *added = plan_add_light(&builder->plan, name, error);
	if (added == NULL)
		return false;
	added->origin = (struct plan_origin){object, source->node, source->aimed};
	struct model_light *light = &builder->lights[builder->light_count++];
	mat4 world;
	actor_rest_transform(&builder->actors[object], source->node, world);
	*light = *source;
	glm_mat4_mulv3(world, light->desc.position, 1, light->desc.position);
	glm_mat4_mulv3(world, light->desc.target, 1, light->desc.target);
	light->desc.radius *= fmaxf(scale[0], fmaxf(scale[1], scale[2]));
	return check_place(builder->source, "the place of a light", light->desc.position, error);
}

static bool adopt_camera(struct builder *builder, uint32_t object, struct sm_error *error)
{
	const struct model *model = builder->actors[object].model;
	const struct sm_camera *source = &model->camera;
	struct sm_camera *camera = &builder->plan.camera.desc;
	mat4 world;
	if (!model->has_camera)
		return true;
	actor_rest_transform(&builder->actors[object], model->camera_node, world);
	if (isnan(camera->eye[0]) && isnan(camera->target[0]))
		builder->plan.camera.origin =
			(struct plan_origin){object, model->camera_node, true};
	if (isnan(camera->eye[0]))
		glm_mat4_mulv3(world, (float *)source->eye, 1, camera->eye);
	if (isnan(camera->target[0]))
		glm_mat4_mulv3(world, (float *)source->target, 1, camera->target);
	if (isnan(camera->up[0]))
		glm_mat4_mulv3(world, (float *)source->up, 0, camera->up);
	if (isnan(camera->fov))
		camera->fov = source->fov;
	return check_view(builder->source, camera, error);
}

/** The box around the casters, or around everything if nothing casts. */
static void find_box(const struct builder *builder, float box[2][3])
{
	glm_vec3_broadcast(INFINITY, box[0]);
	glm_vec3_broadcast(-INFINITY, box[1]);
	for (int pass = 0; pass < 2 && box[0][0] > box[1][0]; pass++) {
		for (size_t i = 0; i < builder->plan.object_count; i++)
			actor_grow_box(&builder->actors[i], pass == 0, box);
	}
}

/** Puts the model of an object into the scene, and its lights and camera into the plan. */
static bool place_model(
	struct builder *builder, uint32_t index, bool with_lights, struct sm_error *error)
{
	const struct plan_object *object = &builder->plan.objects[index];
	struct actor *actor = &builder->actors[index];
	const struct model *model = actor->model;
	struct sm_error cause;
	if (!actor_place(actor, object->name, builder->scene, &cause))
		return error_set(error, cause.status, "%s: %s", object->model, cause.text);
	if (!adopt_camera(builder, index, error))
		return false;
	for (size_t i = 0; with_lights && i < model->light_count; i++)
		if (!adopt_light(builder, index, &model->lights[i], error))
			return false;
	return true;
}

static bool fill_scene(struct builder *builder, struct sm_error *error)
{
	struct plan *plan = &builder->plan;
	bool with_lights = plan->light_count == 0;
	builder->scene = sm_scene_create();
	if (builder->scene == NULL)
		return error_no_memory(error);
	sm_scene_set_environment(builder->scene, &plan->environment);
	if (!add_ground(builder, error))
		return false;
	for (uint32_t i = 0; i < plan->object_count; i++)
		if (!place_model(builder, i, with_lights, error))
			return false;
	float box[2][3];
	find_box(builder, box);
	if (!check_place(builder->source, "a corner", box[0], error) ||
		!check_place(builder->source, "a corner", box[1], error))
		return false;
	frame_init(&builder->frame, box, plan->ground.height);
	return place_ground(builder, error);
}

/** Lights of models have physical units but the scene no exposure: the brightest becomes 1. */
static void resolve_model_lights(struct builder *builder)
{
	float brightest = 0;
	for (size_t i = 0; i < builder->light_count; i++) {
		struct sm_light_desc *desc = &builder->plan.lights[i].desc;
		frame_model_light(&builder->frame, &builder->lights[i], desc);
		if (builder->lights[i].physical)
			brightest = fmaxf(brightest, desc->intensity);
	}
	for (size_t i = 0; brightest > 0 && i < builder->light_count; i++)
		if (builder->lights[i].physical)
			builder->plan.lights[i].desc.intensity /= brightest;
}

static bool add_lights(struct builder *builder, const char *const *settings, size_t setting_count,
	struct sm_error *error)
{
	struct plan *plan = &builder->plan;
	resolve_model_lights(builder);
	if (plan->light_count == 0 && plan_add_light(plan, "key", error) == NULL)
		return false;
	if (!settings_apply(plan, settings, setting_count, true, error))
		return false;
	for (size_t i = 0; i < plan->light_count; i++) {
		struct sm_light_desc *desc = &plan->lights[i].desc;
		frame_complete_light(&builder->frame, desc);
		desc->name = plan->lights[i].name;
		uint32_t light;
		struct sm_error cause;
		if (!sm_scene_add_light(builder->scene, desc, &light, &cause))
			return error_set(
				error, cause.status, "%s: %s", builder->source, cause.text);
	}
	return true;
}

static bool check_camera(const struct sm_camera *camera, const char *source, struct sm_error *error)
{
	vec3 ahead, side;
	glm_vec3_sub((float *)camera->target, (float *)camera->eye, ahead);
	glm_vec3_cross(ahead, (float *)camera->up, side);
	const char *problem = NULL;
	if (glm_vec3_norm2(ahead) == 0)
		problem = "eye and target are the same point";
	else if (glm_vec3_norm2(side) == 0)
		problem = "up is along the view";
	else if (isnan(camera->near) || isnan(camera->far))
		problem = "near and far go together";
	else if (camera->near > 0 && camera->near >= camera->far)
		problem = "near is not less than far";
	return problem == NULL ||
	       error_set(error, SM_ERROR_INPUT, "%s: [camera] %s", source, problem);
}

/** Hands the results over to the stage. */
static bool finish_stage(struct builder *builder, struct stage *stage, struct sm_error *error)
{
	struct plan *plan = &builder->plan;
	struct sm_camera *camera = &plan->camera.desc;
	const struct plan_shadow *shadow = &plan->shadow;
	float aspect = (float)plan->output.width / (float)plan->output.height;
	struct stage_framing framing = {
		.frame = builder->frame, .light = plan->lights[0].desc, .open = *camera};
	framing.light.name = NULL;
	frame_complete_camera(&builder->frame, &plan->lights[0].desc, aspect, camera);
	if (!check_camera(camera, builder->source, error))
		return false;
	struct stage_clips clips;
	struct stage_motion motion = {0};
	bool ok = stage_clips_init(&clips, plan, builder->actors, error);
	if (ok) {
		struct actor *actors = builder->actors;
		builder->actors = NULL;
		ok = stage_motion_init(&motion, plan, actors, builder->source, error);
	}
	if (!ok) {
		stage_clips_finish(&clips);
		stage_motion_finish(&motion);
		return false;
	}
	*stage = (struct stage){
		.scene = builder->scene,
		.camera = *camera,
		.framing = framing,
		.motion = motion,
		.clips = clips,
		.shadow = {.technique = shadow->technique,
			.map_size = shadow->map,
			.width = isnan(shadow->width) ? 0 : shadow->width,
			.falloff = shadow->falloff,
			.samples = shadow->samples,
			.passes = shadow->passes,
			.precision = shadow->precision,
			.sampling = shadow->sampling},
		.output = {plan->output.width, plan->output.height,
			plan->output.samples == PLAN_SAMPLES_4 ? 4 : 1},
		.technique = shadow->technique,
	};
	plan->shadow.technique = NULL;
	builder->scene = NULL;
	return true;
}

static void builder_finish(struct builder *builder)
{
	for (size_t i = 0; builder->actors != NULL && i < builder->plan.object_count; i++)
		actor_finish(&builder->actors[i]);
	free(builder->actors);
	free(builder->lights);
	sm_scene_destroy(builder->scene);
	plan_finish(&builder->plan);
}

bool stage_load(struct stage *stage, const char *source, const char *const *settings,
	size_t setting_count, struct sm_error *error)
{
	struct builder builder = {.source = source};
	*stage = (struct stage){0};
	bool ok = plan_init(&builder.plan, error) && read_source(&builder, error) &&
		  settings_apply(&builder.plan, settings, setting_count, false, error) &&
		  load_actors(&builder, error);
	if (ok)
		adopt_suggestions(&builder);
	ok = ok && fill_scene(&builder, error) &&
	     add_lights(&builder, settings, setting_count, error) &&
	     finish_stage(&builder, stage, error);
	builder_finish(&builder);
	return ok;
}

void stage_finish(struct stage *stage)
{
	stage_clips_finish(&stage->clips);
	stage_motion_finish(&stage->motion);
	sm_scene_destroy(stage->scene);
	free(stage->technique);
	*stage = (struct stage){0};
}

void stage_set_size(struct stage *stage, uint32_t width, uint32_t height)
{
	const struct stage_framing *framing = &stage->framing;
	stage->output.width = width;
	stage->output.height = height;
	stage->camera = framing->open;
	frame_complete_camera(
		&framing->frame, &framing->light, (float)width / (float)height, &stage->camera);
	stage->motion.camera = stage->camera;
}

bool stage_moves(const struct stage *stage)
{
	return stage_motion_moves(&stage->motion);
}

bool stage_set_time(struct stage *stage, double seconds, struct sm_error *error)
{
	if (!stage_motion_set_time(&stage->motion, seconds, stage->scene, error))
		return false;
	struct sm_camera camera;
	stage_motion_camera(&stage->motion, seconds, &camera);
	if (!check_view("animation", &camera, error))
		return false;
	stage->camera = camera;
	return true;
}
