/* SPDX-License-Identifier: MIT */
#include "bench/stress_shrink.h"
#include "bench/stress_file.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define TRIES_MAX 4000

struct shrinker {
	struct stress_scene *scene; /* the simplest so far */
	struct stress_probe *probe;
	stress_rule rule;
	struct stress_fault *fault; /* of that one */
	unsigned int tries;
};

/* Puts the candidate, which is taken, in the place of the scene if it fails alike. */
static bool offer(struct shrinker *shrinker, struct stress_scene *candidate)
{
	struct stress_fault fault;
	bool fails = shrinker->tries++ < TRIES_MAX && stress_file_can_say(candidate) &&
		     !stress_random_check(shrinker->probe, candidate, shrinker->rule, &fault) &&
		     fault.kind == shrinker->fault->kind;
	if (!fails) {
		stress_scene_finish(candidate);
		return false;
	}
	stress_scene_finish(shrinker->scene);
	*shrinker->scene = *candidate;
	*shrinker->fault = fault;
	return true;
}

static bool drop_object(struct shrinker *shrinker, size_t index)
{
	struct stress_scene candidate;
	if (!stress_scene_copy(&candidate, shrinker->scene, NULL))
		return false;
	stress_mesh_finish(&candidate.objects[index].mesh);
	candidate.object_count--;
	memmove(&candidate.objects[index], &candidate.objects[index + 1],
		(candidate.object_count - index) * sizeof(candidate.objects[0]));
	return offer(shrinker, &candidate);
}

static bool drop_light(struct shrinker *shrinker, size_t index)
{
	struct stress_scene candidate;
	if (!stress_scene_copy(&candidate, shrinker->scene, NULL))
		return false;
	candidate.light_count--;
	memmove(&candidate.lights[index], &candidate.lights[index + 1],
		(candidate.light_count - index) * sizeof(candidate.lights[0]));
	return offer(shrinker, &candidate);
}

static void drop_unused_vertices(struct stress_mesh *mesh)
{
	size_t kept = 0;
	for (size_t i = 0; i < mesh->vertex_count; i++) {
		bool used = false;
		for (size_t j = 0; j < mesh->index_count; j++)
			used = used || mesh->indices[j] == i;
		if (!used)
			continue;
		memcpy(mesh->positions[kept], mesh->positions[i], sizeof(*mesh->positions));
		for (size_t j = 0; j < mesh->index_count; j++)
			if (mesh->indices[j] == i)
				mesh->indices[j] = (uint32_t)kept;
		kept++;
	}
	mesh->vertex_count = kept;
}

static bool drop_triangles(struct shrinker *shrinker, size_t object, size_t first, size_t count)
{
	struct stress_scene candidate;
	if (!stress_scene_copy(&candidate, shrinker->scene, NULL))
		return false;
	struct stress_mesh *mesh = &candidate.objects[object].mesh;
	size_t end = 3 * (first + count);
	end = end < mesh->index_count ? end : mesh->index_count;
	memmove(mesh->indices + 3 * first, mesh->indices + end,
		(mesh->index_count - end) * sizeof(*mesh->indices));
	mesh->index_count -= end - 3 * first;
	drop_unused_vertices(mesh);
	return offer(shrinker, &candidate);
}

/* Half of them at a time, a quarter, ... (Zeller & Hildebrandt 2002). */
static bool thin_mesh(struct shrinker *shrinker, size_t object)
{
	bool changed = false;
	const struct stress_mesh *mesh = &shrinker->scene->objects[object].mesh;
	for (size_t count = mesh->index_count / 6; count > 0; count /= 2)
		for (size_t first = 0; first < mesh->index_count / 3;)
			if (drop_triangles(shrinker, object, first, count))
				changed = true;
			else
				first += count;
	return changed;
}

#define VERTICES_MAX 16

/* The scene's numbers in one order; NULL past the last one. */
static float *number_at(struct stress_scene *scene, size_t index)
{
	struct {
		float *first;
		size_t count;
	} runs[4 * STRESS_OBJECTS_MAX + 6 * STRESS_LIGHTS_MAX + 6];
	size_t count = 0;
	for (size_t i = 0; i < scene->object_count; i++) {
		struct stress_object *object = &scene->objects[i];
		size_t vertices = object->mesh.vertex_count;
		runs[count].first = object->position;
		runs[count++].count = 3;
		runs[count].first = object->rotation;
		runs[count++].count = 3;
		runs[count].first = object->scale;
		runs[count++].count = 3;
		runs[count].first = *object->mesh.positions;
		runs[count++].count = vertices <= VERTICES_MAX ? 3 * vertices : 0;
	}
	for (size_t i = 0; i < scene->light_count; i++) {
		struct sm_light_desc *light = &scene->lights[i];
		float *const numbers[] = {light->position, light->target, &light->radius,
			&light->angle, &light->softness, &light->intensity};
		for (size_t j = 0; j < sizeof(numbers) / sizeof(numbers[0]); j++) {
			runs[count].first = numbers[j];
			runs[count++].count = j < 2 ? 3 : 1;
		}
	}
	float *const numbers[] = {scene->camera.eye, scene->camera.target, &scene->camera.fov,
		&scene->camera.near, &scene->camera.far, &scene->shadow.width};
	for (size_t j = 0; j < sizeof(numbers) / sizeof(numbers[0]); j++) {
		runs[count].first = numbers[j];
		runs[count++].count = j < 2 ? 3 : 1;
	}
	for (size_t i = 0; i < count; i++) {
		if (index < runs[i].count)
			return runs[i].first + index;
		index -= runs[i].count;
	}
	return NULL;
}

static int digits_of(float number)
{
	return snprintf(NULL, 0, "%.9g", (double)number);
}

static bool simplify_number(struct shrinker *shrinker, size_t index)
{
	float number = *number_at(shrinker->scene, index);
	float tenth = powf(10, floorf(log10f(fmaxf(fabsf(number), 1e-30f))));
	const float simpler[] = {0, 1, roundf(number), roundf(number / tenth) * tenth,
		roundf(number * 10) / 10, roundf(number / tenth * 10) / 10 * tenth};
	for (size_t i = 0; i < sizeof(simpler) / sizeof(simpler[0]); i++) {
		struct stress_scene candidate;
		if (digits_of(simpler[i]) >= digits_of(number) && !(simpler[i] == 0 && number != 0))
			continue;
		if (!stress_scene_copy(&candidate, shrinker->scene, NULL))
			return false;
		*number_at(&candidate, index) = simpler[i];
		if (offer(shrinker, &candidate))
			return true;
	}
	return false;
}

/* One change of what is not a number with a fraction; false past the last one. */
static bool change_option(struct stress_scene *scene, size_t index)
{
	switch (index) {
	case 0:
		scene->shadow.falloff = SM_FALLOFF_DEFAULT;
		return true;
	case 1:
		scene->shadow.passes = 0;
		return true;
	case 2:
		scene->shadow.samples = 0;
		return true;
	case 3:
		scene->shadow.map_size = 16;
		return true;
	case 4:
		scene->width = scene->width > 1 ? scene->width / 2 : 1;
		return true;
	case 5:
		scene->height = scene->height > 1 ? scene->height / 2 : 1;
		return true;
	case 6:
		scene->camera.near = scene->camera.far = 0;
		return true;
	default:
		return false;
	}
}

static bool is_same(const struct stress_scene *a, const struct stress_scene *b)
{
	return a->shadow.falloff == b->shadow.falloff && a->shadow.passes == b->shadow.passes &&
	       a->shadow.samples == b->shadow.samples && a->shadow.map_size == b->shadow.map_size &&
	       a->width == b->width && a->height == b->height && a->camera.near == b->camera.near;
}

static bool simplify_options(struct shrinker *shrinker)
{
	bool changed = false, known = true;
	for (size_t i = 0; known; i++) {
		struct stress_scene candidate;
		if (!stress_scene_copy(&candidate, shrinker->scene, NULL))
			return false;
		known = change_option(&candidate, i);
		if (!known || is_same(&candidate, shrinker->scene))
			stress_scene_finish(&candidate);
		else
			changed = offer(shrinker, &candidate) || changed;
	}
	return changed;
}

static bool drop_parts(struct shrinker *shrinker)
{
	bool changed = false;
	for (size_t i = shrinker->scene->object_count; i > 0; i--)
		changed = drop_object(shrinker, i - 1) || changed;
	for (size_t i = shrinker->scene->light_count; i > 0; i--)
		changed = drop_light(shrinker, i - 1) || changed;
	for (size_t i = 0; i < shrinker->scene->object_count; i++)
		changed = thin_mesh(shrinker, i) || changed;
	return changed;
}

static bool simplify_numbers(struct shrinker *shrinker)
{
	bool changed = false;
	for (size_t i = 0; number_at(shrinker->scene, i) != NULL; i++)
		changed = simplify_number(shrinker, i) || changed;
	return changed;
}

void stress_shrink(struct stress_scene *scene, struct stress_probe *probe, stress_rule rule,
	struct stress_fault *fault)
{
	struct shrinker shrinker = {scene, probe, rule, fault, 0};
	bool changed = true;
	while (changed && shrinker.tries < TRIES_MAX) {
		changed = drop_parts(&shrinker);
		changed = simplify_options(&shrinker) || changed;
		changed = simplify_numbers(&shrinker) || changed;
	}
}
