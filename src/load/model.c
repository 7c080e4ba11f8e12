/* SPDX-License-Identifier: MIT */
#include "load/model.h"
#include "base/array.h"
#include "base/line.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* Address space, not memory: pages come as they are written. A sixteenth of a small machine's
 * addresses, so that the largest model still leaves room to copy it into a scene. */
static const size_t mapping_bytes = SIZE_MAX / 16 < (1u << 30) ? SIZE_MAX / 16 : 1u << 30;

static size_t aligned(size_t bytes)
{
	const size_t alignment = _Alignof(max_align_t);
	return (bytes + alignment - 1) / alignment * alignment;
}

struct model *model_create(struct sm_error *error)
{
	struct model *model = mmap(NULL, mapping_bytes, PROT_READ | PROT_WRITE,
		MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
	if (model == MAP_FAILED) {
		error_no_memory(error);
		return NULL;
	}
	model->used = aligned(sizeof(*model));
	return model;
}

void model_destroy(struct model *model)
{
	if (model != NULL)
		munmap(model, mapping_bytes);
}

void *model_alloc(struct model *model, size_t count, size_t size)
{
	size_t room = mapping_bytes - model->used;
	if (size != 0 && count > room / size)
		return NULL;
	size_t bytes = aligned(count * size);
	if (bytes > room)
		return NULL;
	void *memory = (uint8_t *)model + model->used;
	model->used += bytes;
	return memory;
}

char *model_string(struct model *model, const char *text)
{
	size_t size = strlen(text) + 1;
	char *copy = model_alloc(model, size, 1);
	return copy != NULL ? memcpy(copy, text, size) : NULL;
}

void model_note(struct model *model, const char *format, ...)
{
	char text[400];
	va_list args;
	va_start(args, format);
	line_format(text, sizeof(text), format, args);
	va_end(args);
	struct model_note *note = model_alloc(model, 1, sizeof(*note));
	if (note == NULL)
		return;
	*note = (struct model_note){.text = model_string(model, text), .next = model->notes};
	if (note->text != NULL)
		model->notes = note;
}

bool model_reserve(struct model *model, size_t meshes, size_t objects)
{
	model->meshes = model_alloc(model, meshes, sizeof(*model->meshes));
	model->objects = model_alloc(model, objects, sizeof(*model->objects));
	return model->meshes != NULL && model->objects != NULL;
}

void model_transform(
	const float position[3], const float rotation[3], const float scale[3], float transform[16])
{
	mat4 matrix = GLM_MAT4_IDENTITY_INIT;
	glm_translate(matrix, (float *)position);
	glm_rotate(matrix, glm_rad(rotation[2]), GLM_ZUP);
	glm_rotate(matrix, glm_rad(rotation[1]), GLM_YUP);
	glm_rotate(matrix, glm_rad(rotation[0]), GLM_XUP);
	glm_scale(matrix, (float *)scale);
	memcpy(transform, matrix, sizeof(matrix));
}

void model_object_transform(const struct model *model, const struct pose *pose,
	const struct model_placement *placement, size_t object, float transform[16])
{
	mat4 inner, outer;
	memcpy(inner, pose != NULL ? pose->transforms[object] : model->objects[object].transform,
		sizeof(inner));
	memcpy(outer, placement->transform, sizeof(outer));
	glm_mat4_mul(outer, inner, inner);
	memcpy(transform, inner, sizeof(inner));
}

static void part_name(const struct model *model, const struct model_placement *placement,
	const struct sm_object_desc *part, char name[200])
{
	if (model->object_count == 1 || part->name == NULL)
		snprintf(name, 200, "%s", placement->name);
	else
		snprintf(name, 200, "%s/%s", placement->name, part->name);
}

static void grow_box(const struct sm_mesh_desc *mesh, const float *positions,
	const float transform[16], float box[2][3])
{
	mat4 world;
	memcpy(world, transform, sizeof(world));
	for (size_t i = 0; i < mesh->index_count; i++) {
		vec3 point;
		glm_mat4_mulv3(world, (float *)positions + 3 * mesh->indices[i], 1, point);
		glm_vec3_minv(box[0], point, box[0]);
		glm_vec3_maxv(box[1], point, box[1]);
	}
}

static const float *positions_of(const struct model *model, const struct pose *pose, size_t object)
{
	const struct rig *rig = &model->rig;
	for (size_t i = 0; pose != NULL && i < rig->shape_count; i++)
		if (rig->shapes[i].object == object)
			return pose->shapes[i].positions;
	return model->meshes[model->objects[object].mesh].positions;
}

void model_grow_box(const struct model *model, const struct pose *pose,
	const struct model_placement *placement, bool casters_only, float box[2][3])
{
	for (size_t i = 0; i < model->object_count; i++) {
		const struct sm_object_desc *object = &model->objects[i];
		float transform[16];
		if (casters_only && !(object->casts && placement->casts))
			continue;
		model_object_transform(model, pose, placement, i, transform);
		grow_box(
			&model->meshes[object->mesh], positions_of(model, pose, i), transform, box);
	}
}

static bool place_object(const struct model *model, size_t index,
	const struct model_placement *placement, const uint32_t *handles, struct sm_scene *scene,
	struct sm_error *error)
{
	struct sm_object_desc desc = model->objects[index];
	char name[200];
	part_name(model, placement, &desc, name);
	desc.name = name;
	model_object_transform(model, NULL, placement, index, desc.transform);
	if (!isnan(placement->color[0]))
		memcpy(desc.base_color, placement->color, sizeof(placement->color));
	desc.casts = desc.casts && placement->casts;
	desc.receives = desc.receives && placement->receives;
	desc.mesh = handles[desc.mesh];
	if (desc.image != SM_NONE)
		desc.image = handles[model->mesh_count + desc.image];
	uint32_t object;
	return sm_scene_add_object(scene, &desc, &object, error);
}

bool model_place(const struct model *model, const struct model_placement *placement,
	struct sm_scene *scene, struct sm_error *error)
{
	uint32_t *handles = array_zalloc(model->mesh_count + model->image_count, sizeof(*handles));
	if (handles == NULL)
		return error_no_memory(error);
	bool ok = true;
	for (size_t i = 0; ok && i < model->mesh_count; i++)
		ok = sm_scene_add_mesh(scene, &model->meshes[i], &handles[i], error);
	for (size_t i = 0; ok && i < model->image_count; i++) {
		const struct model_image *image = &model->images[i];
		ok = sm_scene_add_image(scene, image->width, image->height, image->rgba,
			&handles[model->mesh_count + i], error);
	}
	for (size_t i = 0; ok && i < model->object_count; i++)
		ok = place_object(model, i, placement, handles, scene, error);
	free(handles);
	return ok;
}
