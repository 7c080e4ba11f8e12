/* SPDX-License-Identifier: MIT */
#include "load/builtin_scene.h"
#include <string.h>

struct still {
	const char *name;
	struct sm_object_desc *(*solid)(struct model *);
	float color[3], position[3], rotation[3], scale[3];
};

static const struct still stills[] = {
	{"sphere", builtin_sphere, {.62f, .10f, .06f}, {.95f, 0, .75f}, {0, 0, 0},
		{1.1f, 1.1f, 1.1f}},
	{"torus", builtin_torus, {.75f, .45f, .06f}, {-.62f, 0, 1.25f}, {0, 0, 0},
		{1.3f, 1.3f, 1.3f}},
	{"small cone", builtin_cone, {.08f, .22f, .42f}, {-.62f, 0, 1.25f}, {0, 0, 0},
		{.45f, .95f, .45f}},
	{"vase", builtin_vase, {.10f, .30f, .32f}, {-1.55f, 0, -.15f}, {0, 0, 0},
		{1.5f, 2.1f, 1.5f}},
	{"tall pillar", builtin_pillar, {.70f, .66f, .58f}, {.25f, 0, -1.05f}, {0, 0, 0},
		{.8f, 2.2f, .8f}},
	{"gem", builtin_icosahedron, {.12f, .38f, .20f}, {.25f, 2.2f, -1.05f}, {0, 25, 21},
		{.85f, .85f, .85f}},
	{"low pillar", builtin_pillar, {.70f, .66f, .58f}, {1.75f, 0, -.55f}, {0, 0, 0},
		{1, .9f, 1}},
	{"cone", builtin_cone, {.36f, .14f, .32f}, {1.75f, .9f, -.55f}, {0, 0, 0},
		{.85f, 1.3f, .85f}},
	{"plank", builtin_cube, {.50f, .28f, .13f}, {.55f, 0, 2.05f}, {0, 18, 0},
		{1.5f, .16f, .5f}},
	{"cube", builtin_cube, {.08f, .22f, .42f}, {.35f, .16f, 2.08f}, {0, 50, 0},
		{.36f, .36f, .36f}},
	{"pebble", builtin_icosahedron, {.75f, .45f, .06f}, {.9f, .13f, 1.98f}, {0, 10, 0},
		{.3f, .3f, .3f}},
	{"short pillar", builtin_pillar, {.36f, .14f, .32f}, {1.75f, 0, 1.65f}, {0, 0, 0},
		{.4f, .62f, .4f}},
	{"lintel", builtin_cube, {.50f, .28f, .13f}, {-.66f, 2.1f, -.6f}, {0, 24, 0},
		{2.5f, .14f, .34f}},
};

bool builtin_primitives(struct model *model)
{
	const size_t count = sizeof(stills) / sizeof(*stills);
	if (!model_reserve(model, count, count))
		return false;
	for (size_t i = 0; i < count; i++) {
		const struct still *still = &stills[i];
		struct sm_object_desc *object = still->solid(model);
		if (object == NULL)
			return false;
		object->name = still->name;
		memcpy(object->base_color, still->color, sizeof(still->color));
		model_transform(still->position, still->rotation, still->scale, object->transform);
	}
	model->has_camera = true;
	model->camera = (struct sm_camera){
		.eye = {-3.2f, 4.1f, 7.4f}, .target = {.1f, .9f, .1f}, .up = {0, 1, 0}, .fov = 36};
	model->width = 1280;
	model->height = 960;
	model->ground_size = 200;
	return builtin_add_light(model, &(struct sm_light_desc){
						.name = "key",
						.position = {-5.2f, 8.2f, 4.2f},
						.target = {.2f, .4f, .1f},
						.radius = .45f,
						.angle = 48,
						.softness = .5f,
						.color = {1, .95f, .87f},
						.intensity = 1,
					});
}
