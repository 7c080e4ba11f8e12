/* SPDX-License-Identifier: MIT */
#include "bench/stress_file.h"
#include "base/error.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Digits that give a float back exactly. */
#define NUMBER "%.9g"

static void print_vector(FILE *file, const char *key, const float vector[3])
{
	fprintf(file, "%s = " NUMBER " " NUMBER " " NUMBER "\n", key, (double)vector[0],
		(double)vector[1], (double)vector[2]);
}

static void print_number(FILE *file, const char *key, float number)
{
	fprintf(file, "%s = " NUMBER "\n", key, (double)number);
}

static void print_object(FILE *file, const struct stress_object *object, const char *model)
{
	fprintf(file, "model = %s\n", model);
	print_vector(file, "position", object->position);
	print_vector(file, "rotation", object->rotation);
	print_vector(file, "scale", object->scale);
	fprintf(file, "casts = %s\nreceives = %s\n", object->casts ? "yes" : "no",
		object->receives ? "yes" : "no");
}

static void print_light(FILE *file, const struct sm_light_desc *light)
{
	fprintf(file, "type = %s\n", light->type == SM_LIGHT_SPOT ? "spot" : "directional");
	print_vector(file, "position", light->position);
	print_vector(file, "target", light->target);
	print_number(file, "radius", light->radius);
	print_number(file, "angle", light->angle);
	print_number(file, "softness", light->softness);
	print_vector(file, "color", light->color);
	print_number(file, "intensity", light->intensity);
}

static void print_camera(FILE *file, const struct sm_camera *camera)
{
	fputs("\n[camera]\n", file);
	print_vector(file, "eye", camera->eye);
	print_vector(file, "target", camera->target);
	print_vector(file, "up", camera->up);
	print_number(file, "fov", camera->fov);
	if (camera->near > 0) {
		print_number(file, "near", camera->near);
		print_number(file, "far", camera->far);
	}
}

/* What is zero is the default. */
static void print_shadow(FILE *file, const struct sm_shadow_options *shadow)
{
	static const char *const falloffs[] = {"default", "linear", "sinusoid"};
	fputs("\n[shadow]\n", file);
	if (shadow->technique != NULL)
		fprintf(file, "technique = %s\n", shadow->technique);
	if (shadow->map_size > 0)
		fprintf(file, "map = %u\n", shadow->map_size);
	if (shadow->width > 0)
		print_number(file, "width", shadow->width);
	if (shadow->samples > 0)
		fprintf(file, "samples = %u\n", shadow->samples);
	if (shadow->passes > 0)
		fprintf(file, "passes = %u\n", shadow->passes);
	fprintf(file, "falloff = %s\n", falloffs[shadow->falloff]);
}

static void print_mesh(FILE *file, const struct stress_mesh *mesh)
{
	for (size_t i = 0; i < mesh->vertex_count; i++)
		fprintf(file, "v " NUMBER " " NUMBER " " NUMBER "\n",
			(double)mesh->positions[i][0], (double)mesh->positions[i][1],
			(double)mesh->positions[i][2]);
	for (size_t i = 0; i < mesh->index_count; i += 3)
		fprintf(file, "f %u %u %u\n", mesh->indices[i] + 1, mesh->indices[i + 1] + 1,
			mesh->indices[i + 2] + 1);
}

/* Closes the file and tells whether all of it was written. */
static bool close_file(FILE *file, const char *path, struct sm_error *error)
{
	bool written = ferror(file) == 0;
	return (fclose(file) == 0 && written) ||
	       error_set(error, SM_ERROR_MACHINE, "%s: %s", path, strerror(errno));
}

static FILE *open_file(const char *path, struct sm_error *error)
{
	FILE *file = fopen(path, "w");
	if (file == NULL)
		error_set(error, SM_ERROR_MACHINE, "%s: %s", path, strerror(errno));
	return file;
}

static bool write_mesh(const struct stress_mesh *mesh, const char *path, struct sm_error *error)
{
	FILE *file = open_file(path, error);
	if (file == NULL)
		return false;
	print_mesh(file, mesh);
	return close_file(file, path, error);
}

static bool write_meshes(const struct stress_scene *scene, const char *folder, const char *name,
	struct sm_error *error)
{
	bool ok = true;
	for (size_t i = 0; i < scene->object_count && ok; i++) {
		char path[1024];
		snprintf(path, sizeof(path), "%s/%s-%zu.obj", folder, name, i + 1);
		ok = write_mesh(&scene->objects[i].mesh, path, error);
	}
	return ok;
}

bool stress_file_write(const struct stress_scene *scene, const char *folder, const char *name,
	char *path, size_t path_size, struct sm_error *error)
{
	snprintf(path, path_size, "%s/%s.ini", folder, name);
	FILE *file = open_file(path, error);
	if (file == NULL)
		return false;
	for (size_t i = 0; i < scene->object_count; i++) {
		char model[256];
		snprintf(model, sizeof(model), "%s-%zu.obj", name, i + 1);
		fprintf(file, "[object %zu]\n", i + 1);
		print_object(file, &scene->objects[i], model);
		fputc('\n', file);
	}
	for (size_t i = 0; i < scene->light_count; i++) {
		fprintf(file, "[light %zu]\n", i + 1);
		print_light(file, &scene->lights[i]);
		fputc('\n', file);
	}
	fputs("[ground]\nshow = no\n", file);
	print_camera(file, &scene->camera);
	print_shadow(file, &scene->shadow);
	fprintf(file, "\n[output]\nsize = %ux%u\nsamples = 1\n", scene->width, scene->height);
	return close_file(file, path, error) && write_meshes(scene, folder, name, error);
}
