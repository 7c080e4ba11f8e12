/* SPDX-License-Identifier: MIT */
#include "bench/stress_file.h"
#include "base/error.h"
#include "load/stage.h"
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
		fprintf(file, "v " NUMBER " " NUMBER " " NUMBER "\n", (double)mesh->positions[i][0],
			(double)mesh->positions[i][1], (double)mesh->positions[i][2]);
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

static bool in_range(const float *numbers, size_t count, float least, float most)
{
	for (size_t i = 0; i < count; i++)
		if (!(numbers[i] >= least && numbers[i] <= most))
			return false;
	return true;
}

static bool can_say_object(const struct stress_object *object)
{
	return object->mesh.index_count > 0 && in_range(object->position, 3, -1e6f, 1e6f) &&
	       in_range(object->rotation, 3, -3600, 3600) &&
	       in_range(object->scale, 3, 1e-6f, 1e6f);
}

static bool can_say_light(const struct sm_light_desc *light)
{
	return in_range(light->position, 3, -1e6f, 1e6f) &&
	       in_range(light->target, 3, -1e6f, 1e6f) && in_range(&light->radius, 1, 0, 1e6f) &&
	       in_range(&light->angle, 1, 1, 170) && in_range(&light->softness, 1, 0, 1) &&
	       in_range(&light->intensity, 1, 0, 1000);
}

static bool can_say_camera(const struct sm_camera *camera)
{
	bool automatic = camera->near == 0 && camera->far == 0;
	return in_range(camera->eye, 3, -1e6f, 1e6f) && in_range(camera->target, 3, -1e6f, 1e6f) &&
	       in_range(&camera->fov, 1, 1, 170) &&
	       (automatic || (in_range(&camera->near, 1, 1e-6f, 1e6f) &&
				     in_range(&camera->far, 1, camera->near, 1e6f)));
}

bool stress_file_can_say(const struct stress_scene *scene)
{
	bool can = scene->object_count > 0 && scene->light_count > 0 &&
		   can_say_camera(&scene->camera) &&
		   (scene->shadow.width == 0 || in_range(&scene->shadow.width, 1, 1e-4f, 1));
	for (size_t i = 0; i < scene->object_count; i++)
		can = can && can_say_object(&scene->objects[i]);
	for (size_t i = 0; i < scene->light_count; i++)
		can = can && can_say_light(&scene->lights[i]);
	return can;
}

bool stress_file_check(const char *path, struct stress_probe *probe, struct stress_picture *seen,
	struct stress_fault *fault, struct sm_error *error)
{
	struct stage stage;
	fault->text[0] = '\0';
	if (seen != NULL)
		*seen = (struct stress_picture){0};
	bool loaded = stage_load(&stage, path, NULL, 0, error);
	if (loaded) {
		const struct stress_subject subject = {
			.scene = stage.scene,
			.camera = stage.camera,
			.shadow = stage.shadow,
			.width = stage.output.width,
			.height = stage.output.height,
		};
		stress_check(probe, &subject, seen, fault);
	}
	stage_finish(&stage);
	return loaded;
}
