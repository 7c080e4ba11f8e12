/* SPDX-License-Identifier: MIT */
#include "bench/stress_random.h"
#include "bench/stress_shape.h"
#include <math.h>
#include <string.h>

/* splitmix64 (Steele, Lea & Flood 2014). */
static uint64_t next(uint64_t *state)
{
	uint64_t z = (*state += 0x9e3779b97f4a7c15);
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
	z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
	return z ^ (z >> 31);
}

static double between(uint64_t *state, double least, double most)
{
	return least + (most - least) * (double)(next(state) >> 11) * 0x1p-53;
}

/* With even logarithms. */
static double scale_between(uint64_t *state, double least, double most)
{
	return least * pow(most / least, between(state, 0, 1));
}

static uint32_t below(uint64_t *state, uint32_t count)
{
	return (uint32_t)(next(state) % count);
}

static bool one_in(uint64_t *state, uint32_t count)
{
	return below(state, count) == 0;
}

static void random_vector(uint64_t *state, double least, double most, float vector[3])
{
	for (int axis = 0; axis < 3; axis++)
		vector[axis] = (float)between(state, least, most);
}

/* Triangles between vertices of [-1, 1]^3, some of them without area. */
static bool make_soup(uint64_t *state, struct stress_mesh *mesh, struct sm_error *error)
{
	uint32_t vertices = 3 + below(state, 8), triangles = 1 + below(state, 20);
	if (!stress_mesh_init(mesh, vertices, 3 * (size_t)triangles, error))
		return false;
	for (uint32_t i = 0; i < vertices; i++)
		random_vector(state, -1, 1, mesh->positions[i]);
	for (uint32_t i = 0; i < 3 * triangles; i++)
		mesh->indices[i] = below(state, vertices);
	return true;
}

static bool make_shape(uint64_t *state, struct stress_mesh *mesh, struct sm_error *error)
{
	switch (below(state, 6)) {
	case 0:
		return stress_shape_triangle(mesh, error);
	case 1:
		return stress_shape_square(mesh, error);
	case 2:
		return stress_shape_slivers(mesh, scale_between(state, 2, 1e6), error);
	case 3:
		return stress_shape_sphere(mesh, 3 + below(state, 5), error);
	case 4:
		return make_soup(state, mesh, error);
	default:
		return stress_shape_cube(mesh, error);
	}
}

static void place_object(uint64_t *state, struct stress_object *object)
{
	double scale = scale_between(state, .05, 2);
	bool even = !one_in(state, 3), extreme = one_in(state, 10);
	random_vector(state, -2, 2, object->position);
	object->position[1] = one_in(state, 4) ? 0 : fabsf(object->position[1]);
	random_vector(state, -180, 180, object->rotation);
	for (int axis = 0; axis < 3; axis++) {
		double share =
			extreme ? scale_between(state, 1e-5, 50) : scale_between(state, .3, 2);
		object->scale[axis] = (float)(even ? scale : scale * share);
		if (one_in(state, 2))
			object->rotation[axis] = 90 * roundf(object->rotation[axis] / 90);
	}
	object->casts = !one_in(state, 8);
	object->receives = !one_in(state, 8);
}

static bool add_objects(uint64_t *state, struct stress_scene *scene, struct sm_error *error)
{
	uint32_t count = 1 + below(state, 5);
	struct stress_mesh mesh;
	if (!one_in(state, 4)) {
		if (!stress_shape_square(&mesh, error))
			return false;
		struct stress_object *floor = stress_scene_add(scene, mesh);
		floor->scale[0] = floor->scale[2] = (float)scale_between(state, 2, 100);
		floor->casts = one_in(state, 2);
	}
	for (uint32_t i = 0; i < count; i++) {
		if (!make_shape(state, &mesh, error))
			return false;
		place_object(state, stress_scene_add(scene, mesh));
	}
	return true;
}

static void random_light(
	uint64_t *state, const struct stress_scene *scene, struct sm_light_desc *light)
{
	double distance = scale_between(state, 1, 20);
	float towards[3];
	*light = (struct sm_light_desc){
		.type = one_in(state, 3) ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT,
		.radius = one_in(state, 4) ? 0 : (float)scale_between(state, 1e-6, 100),
		.angle = (float)between(state, 1, 170),
		.softness = (float)between(state, 0, 1),
		.color = {1, 1, 1},
		.intensity = (float)between(state, 0, 2),
	};
	random_vector(state, -1, 1, towards);
	random_vector(state, -1, 1, light->target);
	for (int axis = 0; axis < 3; axis++)
		light->position[axis] = (float)(distance * towards[axis]);
	if (!one_in(state, 4))
		light->position[1] = fabsf(light->position[1]) + 1;
	/* In the middle of an object, or at its height. */
	const struct stress_object *object =
		&scene->objects[below(state, (uint32_t)scene->object_count)];
	if (one_in(state, 16))
		memcpy(light->position, object->position, sizeof(light->position));
	else if (one_in(state, 16))
		light->position[1] = light->target[1] = object->position[1];
}

static void random_camera(uint64_t *state, struct sm_camera *camera)
{
	*camera = (struct sm_camera){.up = {0, 1, 0}, .fov = (float)between(state, 20, 90)};
	double around = between(state, 0, 2 * M_PI), distance = scale_between(state, 3, 15);
	random_vector(state, -.5, .5, camera->target);
	camera->eye[0] = camera->target[0] + (float)(distance * sin(around));
	camera->eye[1] = camera->target[1] + (float)(distance * between(state, -.1, 1));
	camera->eye[2] = camera->target[2] + (float)(distance * cos(around));
	if (one_in(state, 10)) {
		camera->far = (float)(2 * distance);
		camera->near = (float)(camera->far / scale_between(state, 10, 1e5));
	}
}

/* Options that the technique does not take are left out. */
static void random_shadow(uint64_t *state, const char *technique, struct stress_probe *probe,
	struct sm_shadow_options *shadow)
{
	static const uint32_t maps[] = {16, 17, 32, 64, 100, 128};
	struct stress_way way;
	uint32_t ways = 0;
	while (stress_way_at(ways, technique, &way))
		ways++;
	stress_way_at(below(state, ways), technique, &way);
	*shadow = (struct sm_shadow_options){
		.technique = way.technique,
		.samples = way.samples,
		.map_size = maps[below(state, sizeof(maps) / sizeof(maps[0]))],
	};
	struct sm_shadow_options more = *shadow;
	more.width = one_in(state, 3) ? (float)scale_between(state, 1e-4, 1) : 0;
	more.falloff = one_in(state, 3) ? SM_FALLOFF_SINUSOID : SM_FALLOFF_DEFAULT;
	more.passes = below(state, 3);
	if (sm_renderer_set_shadows(probe->renderer, &more, NULL))
		*shadow = more;
}

/* Some scenes are as a whole small, large, or far away; within the ranges of a scene file. */
static void transform_all(uint64_t *state, struct stress_scene *scene)
{
	double offset[3];
	if (one_in(state, 4))
		stress_scene_scale(scene, scale_between(state, 1e-3, 1e3));
	if (one_in(state, 8)) {
		for (int axis = 0; axis < 3; axis++)
			offset[axis] = between(state, -1e5, 1e5);
		stress_scene_move(scene, offset);
	}
	for (size_t i = 0; i < scene->object_count; i++)
		for (int axis = 0; axis < 3; axis++)
			scene->objects[i].scale[axis] = fmaxf(scene->objects[i].scale[axis], 1e-6f);
	/* Moving may have rounded what is small. */
	for (size_t i = 0; i < scene->light_count; i++)
		if (memcmp(scene->lights[i].position, scene->lights[i].target,
			    sizeof(scene->lights[i].target)) == 0)
			scene->lights[i].position[1]++;
}

bool stress_random_scene(struct stress_scene *scene, uint64_t seed, uint32_t number,
	const char *technique, struct stress_probe *probe, struct sm_error *error)
{
	static const uint32_t sizes[] = {32, 48, 64};
	uint64_t state = seed ^ (uint64_t)number << 32;
	*scene = (struct stress_scene){.light_count = 1 + below(&state, 3)};
	scene->width = sizes[below(&state, 3)];
	scene->height = sizes[below(&state, 3)];
	random_shadow(&state, technique, probe, &scene->shadow);
	if (!add_objects(&state, scene, error)) {
		stress_scene_finish(scene);
		return false;
	}
	for (size_t i = 0; i < scene->light_count; i++)
		random_light(&state, scene, &scene->lights[i]);
	random_camera(&state, &scene->camera);
	transform_all(&state, scene);
	return true;
}

/* Four times as large is exact in floats: what is not the same depends on the unit of length. */
static bool check_larger(struct stress_probe *probe, const struct stress_scene *scene,
	const struct stress_picture *seen, struct stress_fault *fault)
{
	struct stress_scene larger;
	struct stress_picture picture;
	struct sm_error error;
	size_t count = (size_t)seen->width * seen->height;
	double change = 0;
	if (!stress_scene_copy(&larger, scene, &error))
		return stress_fault_set(fault, STRESS_FAULT_OTHER, "%s", error.text);
	stress_scene_scale(&larger, 4);
	bool ok = stress_check_scene(probe, &larger, &picture, fault);
	for (size_t i = 0; i < count && ok; i++)
		change += fabs((double)picture.values[i] - (double)seen->values[i]);
	stress_picture_finish(&picture);
	stress_scene_finish(&larger);
	return ok && (change == 0 || stress_fault_set(fault, STRESS_FAULT_BOUND,
					     "four times as large it is off by %g",
					     change / (double)count));
}

bool stress_random_check(struct stress_probe *probe, const struct stress_scene *scene,
	stress_rule rule, struct stress_fault *fault)
{
	struct stress_picture seen;
	bool ok = stress_check_scene(probe, scene, &seen, fault) &&
		  check_larger(probe, scene, &seen, fault);
	stress_picture_finish(&seen);
	return ok && (rule == NULL || rule(scene) ||
			     stress_fault_set(fault, STRESS_FAULT_OTHER, "a rule is broken"));
}
