/* SPDX-License-Identifier: MIT */
/* What may come out of a model file, through a fake importer: the stage it makes is sound.
 *	build-fuzz/tests/fuzz/fuzz-model FOUND tests/fuzz/corpus/model
 */
#include "expect.h"
#include "load/import.h"
#include "model_rig.h"
#include "number.h"
#include "stage_check.h"
#include <math.h>
#include <string.h>

static struct numbers numbers; /* of the input at hand */

static char *take_name(struct model *model)
{
	const char name[] = {(char)take_byte(&numbers), (char)take_byte(&numbers), '\0'};
	char *copy = model_string(model, name);
	expect(copy != NULL);
	return copy;
}

static float *take_array(struct model *model, size_t count)
{
	float *values = model_alloc(model, count, sizeof(*values));
	expect(values != NULL);
	take_floats(&numbers, values, count);
	return values;
}

static void take_mesh(struct model *model, struct sm_mesh_desc *desc)
{
	uint8_t flags = take_byte(&numbers);
	desc->name = take_name(model);
	desc->vertex_count = take_byte(&numbers) % 32;
	desc->index_count = 3 * (take_byte(&numbers) % (size_t)32);
	desc->positions = take_array(model, 3 * desc->vertex_count);
	desc->normals = flags & 1 ? take_array(model, 3 * desc->vertex_count) : NULL;
	desc->uvs = flags & 2 ? take_array(model, 2 * desc->vertex_count) : NULL;
	uint32_t *indices = model_alloc(model, desc->index_count, sizeof(*indices));
	expect(indices != NULL);
	for (size_t i = 0; i < desc->index_count; i++)
		indices[i] = take_byte(&numbers) - (flags & 4 ? 1u : 0u);
	desc->indices = indices;
}

static void take_object(struct model *model, struct sm_object_desc *object)
{
	uint8_t flags = take_byte(&numbers);
	*object = (struct sm_object_desc){
		.name = take_name(model),
		.mesh = take_byte(&numbers) % (uint32_t)model->mesh_count,
		.transform = {[15] = 1.0f},
		.image = SM_NONE,
		.casts = true,
		.receives = true,
	};
	take_floats(&numbers, object->base_color, 3);
	for (int column = 0; column < 4; column++)
		take_floats(&numbers, &object->transform[4 * column], flags & 1 ? 4 : 3);
}

static void take_light(struct model *model, struct model_light *light)
{
	uint8_t flags = take_byte(&numbers);
	*light = (struct model_light){
		.desc = {.type = flags & 1 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT,
			.name = take_name(model),
			.radius = NAN,
			.angle = flags & 2 ? 40.0f : NAN,
			.softness = 0.5f,
			.color = {1.0f, 1.0f, 1.0f},
			.intensity = fabsf(take_float(&numbers))},
		.aimed = flags & 4,
		.physical = true,
	};
	take_floats(&numbers, light->desc.position, 3);
	take_floats(&numbers, light->desc.target, 3);
	take_floats(&numbers, light->fade, 3);
}

/* The importer keeps only a camera of which this holds. */
static bool is_usable(const struct sm_camera *camera)
{
	for (int i = 0; i < 3; i++)
		if (!isfinite(camera->eye[i]) || !isfinite(camera->target[i]) ||
			!isfinite(camera->up[i]))
			return false;
	return camera->fov >= 1.0f && camera->fov <= 170.0f;
}

static void take_camera(struct model *model)
{
	struct sm_camera *camera = &model->camera;
	take_floats(&numbers, camera->eye, 3);
	for (int i = 0; i < 3; i++) /* a direction's length away */
		camera->target[i] =
			camera->eye[i] + fmaxf(-1.0f, fminf(1.0f, take_float(&numbers)));
	take_floats(&numbers, camera->up, 3);
	camera->fov = 40.0f + 8.0f * take_float(&numbers);
	model->has_camera = is_usable(camera);
	model->width = 96 + 36u * take_byte(&numbers); /* a tenth to ten times the height */
	model->height = 960;
}

/* In the place of the library's, which is one of assimp in a process of its own. */
bool import_model(const char *path, enum plan_up up, struct model *model, struct sm_error *error)
{
	(void)path;
	(void)up;
	(void)error;
	size_t meshes = 1 + take_byte(&numbers) % 2, objects = 1 + take_byte(&numbers) % 3;
	size_t lights = take_byte(&numbers) % 3;
	expect(model_reserve(model, meshes + objects, objects));
	while (model->mesh_count < meshes)
		take_mesh(model, &model->meshes[model->mesh_count++]);
	while (model->object_count < objects)
		take_object(model, &model->objects[model->object_count++]);
	model->lights = model_alloc(model, lights, sizeof(*model->lights));
	while (model->light_count < lights)
		take_light(model, &model->lights[model->light_count++]);
	if (take_byte(&numbers) % 2)
		take_camera(model);
	if (take_byte(&numbers) % 2)
		take_rig(&numbers, model);
	return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static const char path[] = "models/fuzz.obj";
	struct stage stage;
	struct sm_error error = {0};
	numbers = (struct numbers){data, size};
	if (stage_load(&stage, path, NULL, 0, &error)) {
		expect_sound_stage(&stage);
	} else {
		expect_clear_error(&error);
		expect(strncmp(error.text, path, strlen(path)) == 0);
	}
	stage_finish(&stage);
	return 0;
}
