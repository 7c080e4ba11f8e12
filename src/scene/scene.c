/* SPDX-License-Identifier: MIT */
#include "scene/scene.h"
#include "base/array.h"
#include "base/error.h"
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define IMAGE_SIZE_MAX 16384

struct sm_scene *sm_scene_create(void)
{
	static atomic_uint_fast64_t last_id;
	struct sm_scene *scene = calloc(1, sizeof(*scene));
	if (scene == NULL)
		return NULL;
	scene->id = atomic_fetch_add(&last_id, 1) + 1;
	scene->version = 1;
	scene->environment = (struct sm_environment){
		.sky = {0.12f, 0.13f, 0.15f},
		.ground = {0.06f, 0.06f, 0.06f},
		.background = {0.35f, 0.38f, 0.42f},
	};
	return scene;
}

uint64_t scene_next_version(struct sm_scene *scene)
{
	return ++scene->version;
}

void sm_scene_destroy(struct sm_scene *scene)
{
	if (scene == NULL)
		return;
	for (size_t i = 0; i < scene->mesh_count; i++)
		mesh_finish(&scene->meshes[i]);
	for (size_t i = 0; i < scene->image_count; i++)
		free(scene->images[i].rgba);
	for (size_t i = 0; i < scene->object_count; i++)
		free(scene->objects[i].name);
	for (size_t i = 0; i < scene->light_count; i++)
		free(scene->lights[i].name);
	free(scene->meshes);
	free(scene->images);
	free(scene->objects);
	free(scene->lights);
	free(scene);
}

/* Room for one more element behind *items, which handles count with 32 bits. */
static bool reserve_one(
	void *items, size_t *capacity, size_t count, size_t size, struct sm_error *error)
{
	if (count >= SM_NONE)
		return error_set(error, SM_ERROR_INPUT, "too many parts in the scene");
	if (!array_reserve(items, capacity, count + 1, size))
		return error_no_memory(error);
	return true;
}

static bool copy_name(const char *name, char **copy, struct sm_error *error)
{
	*copy = NULL;
	if (name == NULL)
		return true;
	*copy = strdup(name);
	return *copy != NULL || error_no_memory(error);
}

static bool all_finite(const float *values, size_t count)
{
	for (size_t i = 0; i < count; i++)
		if (!isfinite(values[i]))
			return false;
	return true;
}

bool sm_scene_add_mesh(struct sm_scene *scene, const struct sm_mesh_desc *desc, uint32_t *mesh,
	struct sm_error *error)
{
	if (!reserve_one(&scene->meshes, &scene->mesh_capacity, scene->mesh_count,
		    sizeof(*scene->meshes), error))
		return false;
	if (!mesh_init(&scene->meshes[scene->mesh_count], desc, error))
		return false;
	scene->meshes[scene->mesh_count].version = scene_next_version(scene);
	*mesh = (uint32_t)scene->mesh_count++;
	return true;
}

void sm_scene_get_mesh_stats(
	const struct sm_scene *scene, uint32_t mesh, struct sm_mesh_stats *stats)
{
	*stats = scene->meshes[mesh].stats;
}

bool sm_scene_add_image(struct sm_scene *scene, uint32_t width, uint32_t height,
	const uint8_t *rgba, uint32_t *image, struct sm_error *error)
{
	if (width == 0 || height == 0 || width > IMAGE_SIZE_MAX || height > IMAGE_SIZE_MAX)
		return error_set(error, SM_ERROR_INPUT,
			"an image of %ux%u texels; sizes go from 1 to %d", width, height,
			IMAGE_SIZE_MAX);
	if (!reserve_one(&scene->images, &scene->image_capacity, scene->image_count,
		    sizeof(*scene->images), error))
		return false;
	uint8_t *copy = array_copy(rgba, (size_t)width * height, 4);
	if (copy == NULL)
		return error_no_memory(error);
	scene->images[scene->image_count] =
		(struct image){.width = width, .height = height, .rgba = copy};
	*image = (uint32_t)scene->image_count++;
	return true;
}

static void find_bounds(
	const float min[3], const float max[3], const float transform[16], vec3 box[2])
{
	mat4 world;
	memcpy(world, transform, sizeof(world));
	glm_vec3_copy((float *)min, box[0]);
	glm_vec3_copy((float *)max, box[1]);
	glm_aabb_transform(box, world, box);
}

void object_update_bounds(const struct sm_scene *scene, struct object *object)
{
	const struct mesh *mesh = &scene->meshes[object->mesh];
	vec3 box[2];
	find_bounds(mesh->min, mesh->max, *object->transform, box);
	glm_vec3_copy(box[0], object->min);
	glm_vec3_copy(box[1], object->max);
}

static const char *name_of(const struct object *object)
{
	return object->name != NULL ? object->name : "without a name";
}

/* Whether floats hold where a box comes to lie. */
static bool check_bounds(const struct object *object, const float min[3], const float max[3],
	const float transform[16], struct sm_error *error)
{
	vec3 box[2];
	find_bounds(min, max, transform, box);
	return all_finite(box[0], 6) ||
	       error_set(error, SM_ERROR_INPUT, "object %s: it reaches too far for numbers",
		       name_of(object));
}

/* Of all objects that have the mesh. */
static bool check_vertices(
	const struct sm_scene *scene, uint32_t mesh, const float *positions, struct sm_error *error)
{
	float min[3], max[3];
	mesh_box_of(&scene->meshes[mesh], positions, min, max);
	if (!all_finite(min, 3) || !all_finite(max, 3))
		return true; /* the mesh says which vertex */
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (object->mesh == mesh &&
			!check_bounds(object, min, max, *object->transform, error))
			return false;
	}
	return true;
}

bool sm_scene_set_vertices(struct sm_scene *scene, uint32_t mesh, const float *positions,
	const float *normals, struct sm_error *error)
{
	bool changed;
	if (mesh >= scene->mesh_count)
		return error_set(error, SM_ERROR_INPUT, "no mesh %u", mesh);
	struct mesh *moved = &scene->meshes[mesh];
	if (!check_vertices(scene, mesh, positions, error))
		return false;
	if (!mesh_set_vertices(moved, positions, normals, &changed, error))
		return false;
	if (!changed)
		return true;
	moved->version = scene_next_version(scene);
	for (size_t i = 0; i < scene->object_count; i++) {
		struct object *object = &scene->objects[i];
		if (object->mesh != mesh)
			continue;
		object_update_bounds(scene, object);
		object->version = moved->version;
	}
	return true;
}

static bool transform_is_valid(const float transform[16])
{
	return all_finite(transform, 16) && transform[3] == 0.0f && transform[7] == 0.0f &&
	       transform[11] == 0.0f && transform[15] == 1.0f;
}

static bool object_set_transform(struct sm_scene *scene, struct object *object,
	const float transform[16], struct sm_error *error)
{
	if (!transform_is_valid(transform))
		return error_set(error, SM_ERROR_INPUT,
			"object %s: its transform is not finite and affine", name_of(object));
	const struct mesh *mesh = &scene->meshes[object->mesh];
	if (!check_bounds(object, mesh->min, mesh->max, transform, error))
		return false;
	if (object->version > 0 &&
		memcmp(object->transform, transform, sizeof(object->transform)) == 0)
		return true;
	memcpy(object->transform, transform, sizeof(object->transform));
	object_update_bounds(scene, object);
	object->version = scene_next_version(scene);
	return true;
}

bool sm_scene_add_object(struct sm_scene *scene, const struct sm_object_desc *desc,
	uint32_t *object, struct sm_error *error)
{
	const char *name = desc->name != NULL ? desc->name : "without a name";
	if (desc->mesh >= scene->mesh_count)
		return error_set(error, SM_ERROR_INPUT, "object %s: no mesh %u", name, desc->mesh);
	if (desc->image != SM_NONE && desc->image >= scene->image_count)
		return error_set(
			error, SM_ERROR_INPUT, "object %s: no image %u", name, desc->image);
	if (!all_finite(desc->base_color, 4))
		return error_set(
			error, SM_ERROR_INPUT, "object %s: its colour is not finite", name);
	if (!reserve_one(&scene->objects, &scene->object_capacity, scene->object_count,
		    sizeof(*scene->objects), error))
		return false;
	struct object *added = &scene->objects[scene->object_count];
	*added = (struct object){
		.mesh = desc->mesh,
		.image = desc->image,
		.base_color = {desc->base_color[0], desc->base_color[1], desc->base_color[2]},
		.casts = desc->casts,
		.receives = desc->receives,
		.single_sided = desc->single_sided,
	};
	if (!copy_name(desc->name, &added->name, error))
		return false;
	if (!object_set_transform(scene, added, desc->transform, error)) {
		free(added->name);
		return false;
	}
	*object = (uint32_t)scene->object_count++;
	return true;
}

bool sm_scene_set_transform(
	struct sm_scene *scene, uint32_t object, const float transform[16], struct sm_error *error)
{
	if (object >= scene->object_count)
		return error_set(error, SM_ERROR_INPUT, "no object %u", object);
	return object_set_transform(scene, &scene->objects[object], transform, error);
}

static bool light_check(const struct sm_light_desc *desc, struct sm_error *error)
{
	const char *problem = NULL;
	vec3 path;
	glm_vec3_sub((float *)desc->target, (float *)desc->position, path);
	if (!all_finite(desc->position, 3) || !all_finite(desc->target, 3))
		problem = "its position or target is not finite";
	else if (!(glm_vec3_norm(path) > 0.0f))
		problem = "its target is its position";
	else if (!isfinite(desc->radius) || desc->radius < 0.0f)
		problem = "its radius is not a length";
	else if (desc->type == SM_LIGHT_SPOT && !(desc->angle > 0.0f && desc->angle <= 170.0f))
		problem = "its angle is not above 0 and up to 170 degrees";
	else if (!(desc->softness >= 0.0f && desc->softness <= 1.0f))
		problem = "its softness is not from 0 to 1";
	else if (!all_finite(desc->color, 3) || !isfinite(desc->intensity))
		problem = "its colour or intensity is not finite";
	if (problem == NULL)
		return true;
	return error_set(error, SM_ERROR_INPUT, "light %s: %s",
		desc->name != NULL ? desc->name : "without a name", problem);
}

static bool is_same_name(const char *a, const char *b)
{
	return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

/* But for the name. */
static bool is_same_light(const struct sm_light_desc *a, const struct sm_light_desc *b)
{
	return a->type == b->type && memcmp(a->position, b->position, sizeof(a->position)) == 0 &&
	       memcmp(a->target, b->target, sizeof(a->target)) == 0 && a->radius == b->radius &&
	       a->angle == b->angle && a->softness == b->softness &&
	       memcmp(a->color, b->color, sizeof(a->color)) == 0 && a->intensity == b->intensity;
}

bool sm_scene_set_light(struct sm_scene *scene, uint32_t light, const struct sm_light_desc *desc,
	struct sm_error *error)
{
	if (light >= scene->light_count)
		return error_set(error, SM_ERROR_INPUT, "no light %u", light);
	struct light *changed = &scene->lights[light];
	char *name = changed->name;
	if (!light_check(desc, error))
		return false;
	/* A light that moves keeps its name: nothing is allocated each frame. */
	if (!is_same_name(name, desc->name)) {
		if (!copy_name(desc->name, &name, error))
			return false;
		free(changed->name);
	}
	bool same = changed->version > 0 && is_same_light(&changed->desc, desc);
	uint64_t version = same ? changed->version : scene_next_version(scene);
	*changed = (struct light){.name = name, .desc = *desc, .version = version};
	changed->desc.name = name;
	return true;
}

bool sm_scene_add_light(struct sm_scene *scene, const struct sm_light_desc *desc, uint32_t *light,
	struct sm_error *error)
{
	if (!reserve_one(&scene->lights, &scene->light_capacity, scene->light_count,
		    sizeof(*scene->lights), error))
		return false;
	uint32_t added = (uint32_t)scene->light_count;
	scene->lights[scene->light_count++] = (struct light){0};
	if (!sm_scene_set_light(scene, added, desc, error)) {
		scene->light_count--;
		return false;
	}
	*light = added;
	return true;
}

void sm_scene_set_environment(struct sm_scene *scene, const struct sm_environment *environment)
{
	if (memcmp(&scene->environment, environment, sizeof(*environment)) == 0)
		return;
	scene->environment = *environment;
	scene_next_version(scene);
}

/* Whether the whole box is in front of the near plane, z >= -w; false for NaN. */
static bool box_beyond_near(const float min[3], const float max[3], mat4 to_clip)
{
	for (int corner = 0; corner < 8; corner++) {
		vec4 p = {1.0f, 1.0f, 1.0f, 1.0f};
		for (int axis = 0; axis < 3; axis++)
			p[axis] = corner >> axis & 1 ? max[axis] : min[axis];
		glm_mat4_mulv(to_clip, p, p);
		if (!(p[2] >= -p[3]))
			return false;
	}
	return true;
}

bool mesh_beyond_near(const struct mesh *mesh, mat4 to_clip)
{
	return box_beyond_near(mesh->min, mesh->max, to_clip);
}

bool mesh_hides_back(const struct mesh *mesh, mat4 to_clip)
{
	return mesh->solid && mesh_beyond_near(mesh, to_clip);
}

struct sheet_rule mesh_sheet_rule(const struct mesh *mesh, mat4 transform, mat4 to_clip)
{
	return (struct sheet_rule){
		.one_sided = mesh_beyond_near(mesh, to_clip) ? mesh->caster.found.closed_count : 0,
		.mirrored = glm_mat4_det(transform) < 0.0f,
	};
}

uint32_t sm_scene_mesh_count(const struct sm_scene *scene)
{
	return (uint32_t)scene->mesh_count;
}

uint32_t sm_scene_object_count(const struct sm_scene *scene)
{
	return (uint32_t)scene->object_count;
}

uint32_t sm_scene_light_count(const struct sm_scene *scene)
{
	return (uint32_t)scene->light_count;
}

bool sm_scene_get_bounds(
	const struct sm_scene *scene, bool casters_only, float min[3], float max[3])
{
	vec3 box[2];
	glm_aabb_invalidate(box);
	bool found = false;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (casters_only && !object->casts)
			continue;
		glm_vec3_minv(box[0], (float *)object->min, box[0]);
		glm_vec3_maxv(box[1], (float *)object->max, box[1]);
		found = true;
	}
	memcpy(min, box[0], sizeof(box[0]));
	memcpy(max, box[1], sizeof(box[1]));
	return found;
}
