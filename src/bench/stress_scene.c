/* SPDX-License-Identifier: MIT */
#include "bench/stress_scene.h"
#include "base/array.h"
#include "base/error.h"
#include "load/model.h"
#include <stdlib.h>
#include <string.h>

bool stress_mesh_init(
	struct stress_mesh *mesh, size_t vertex_count, size_t index_count, struct sm_error *error)
{
	*mesh = (struct stress_mesh){
		.positions = array_zalloc(vertex_count, sizeof(*mesh->positions)),
		.indices = array_zalloc(index_count, sizeof(*mesh->indices)),
		.vertex_count = vertex_count,
		.index_count = index_count,
	};
	if (mesh->positions != NULL && mesh->indices != NULL)
		return true;
	stress_mesh_finish(mesh);
	return error_no_memory(error);
}

void stress_mesh_finish(struct stress_mesh *mesh)
{
	free(mesh->positions);
	free(mesh->indices);
	*mesh = (struct stress_mesh){0};
}

static bool copy_mesh(
	struct stress_mesh *copy, const struct stress_mesh *mesh, struct sm_error *error)
{
	if (!stress_mesh_init(copy, mesh->vertex_count, mesh->index_count, error))
		return false;
	memcpy(copy->positions, mesh->positions, mesh->vertex_count * sizeof(*mesh->positions));
	memcpy(copy->indices, mesh->indices, mesh->index_count * sizeof(*mesh->indices));
	return true;
}

bool stress_scene_copy(
	struct stress_scene *copy, const struct stress_scene *scene, struct sm_error *error)
{
	*copy = *scene;
	for (size_t i = 0; i < copy->object_count; i++)
		copy->objects[i].mesh = (struct stress_mesh){0};
	for (size_t i = 0; i < copy->object_count; i++)
		if (!copy_mesh(&copy->objects[i].mesh, &scene->objects[i].mesh, error)) {
			stress_scene_finish(copy);
			return false;
		}
	return true;
}

void stress_scene_finish(struct stress_scene *scene)
{
	for (size_t i = 0; i < scene->object_count; i++)
		stress_mesh_finish(&scene->objects[i].mesh);
	*scene = (struct stress_scene){0};
}

struct stress_object *stress_scene_add(struct stress_scene *scene, struct stress_mesh mesh)
{
	struct stress_object *object = &scene->objects[scene->object_count++];
	*object = (struct stress_object){
		.mesh = mesh, .scale = {1, 1, 1}, .casts = true, .receives = true};
	return object;
}

static bool build_object(
	struct sm_scene *scene, const struct stress_object *object, struct sm_error *error)
{
	const struct sm_mesh_desc mesh = {
		.positions = *object->mesh.positions,
		.vertex_count = object->mesh.vertex_count,
		.indices = object->mesh.indices,
		.index_count = object->mesh.index_count,
	};
	struct sm_object_desc desc = {
		.base_color = {1, 1, 1, 1},
		.image = SM_NONE,
		.casts = object->casts,
		.receives = object->receives,
	};
	uint32_t handle;
	model_transform(object->position, object->rotation, object->scale, desc.transform);
	return sm_scene_add_mesh(scene, &mesh, &desc.mesh, error) &&
	       sm_scene_add_object(scene, &desc, &handle, error);
}

struct sm_scene *stress_scene_build(const struct stress_scene *scene, struct sm_error *error)
{
	struct sm_scene *built = sm_scene_create();
	uint32_t handle;
	bool ok = built != NULL || error_no_memory(error);
	for (size_t i = 0; i < scene->object_count && ok; i++)
		ok = build_object(built, &scene->objects[i], error);
	for (size_t i = 0; i < scene->light_count && ok; i++)
		ok = sm_scene_add_light(built, &scene->lights[i], &handle, error);
	if (ok)
		return built;
	sm_scene_destroy(built);
	return NULL;
}

static void scale_vector(float vector[3], double factor)
{
	for (int axis = 0; axis < 3; axis++)
		vector[axis] = (float)(vector[axis] * factor);
}

void stress_scene_scale(struct stress_scene *scene, double factor)
{
	for (size_t i = 0; i < scene->object_count; i++) {
		scale_vector(scene->objects[i].position, factor);
		scale_vector(scene->objects[i].scale, factor);
	}
	for (size_t i = 0; i < scene->light_count; i++) {
		struct sm_light_desc *light = &scene->lights[i];
		scale_vector(light->position, factor);
		scale_vector(light->target, factor);
		light->radius = (float)(light->radius * factor);
	}
	scale_vector(scene->camera.eye, factor);
	scale_vector(scene->camera.target, factor);
	scene->camera.near = (float)(scene->camera.near * factor);
	scene->camera.far = (float)(scene->camera.far * factor);
}

static void move_point(float point[3], const double offset[3])
{
	for (int axis = 0; axis < 3; axis++)
		point[axis] = (float)(point[axis] + offset[axis]);
}

void stress_scene_move(struct stress_scene *scene, const double offset[3])
{
	for (size_t i = 0; i < scene->object_count; i++)
		move_point(scene->objects[i].position, offset);
	for (size_t i = 0; i < scene->light_count; i++) {
		move_point(scene->lights[i].position, offset);
		move_point(scene->lights[i].target, offset);
	}
	move_point(scene->camera.eye, offset);
	move_point(scene->camera.target, offset);
}
