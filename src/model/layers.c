/* SPDX-License-Identifier: MIT */
#include "model/layers.h"
#include "base/array.h"
#include "model/depth_map.h"
#include "model/receiver.h"
#include "scene/edge_grid.h"
#include <stdlib.h>

#define NOWHERE 2.0f

/* What draws a layer. */
struct layering {
	struct sheet *layer;
	const struct sheet *front; /* the layer before; NULL: none */
	int size;
};

static void keep_sheet(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth)
{
	const struct layering *layering = data;
	size_t texel = (size_t)y * (size_t)layering->size + (size_t)x;
	float rounded = model_round_depth(depth);
	if (layering->front != NULL && rounded <= layering->front[texel].depth + (float)DEPTH_STEP)
		return;
	if (rounded < layering->layer[texel].depth)
		layering->layer[texel] = (struct sheet){rounded,
			{triangle->depth.dx * layering->size, triangle->depth.dy * layering->size}};
}

static bool draw_sheets(
	struct layering *layering, const struct model_light *light, const struct object *object)
{
	const struct mesh *mesh = &light->scene->meshes[object->mesh];
	const struct caster *caster = &mesh->caster;
	struct raster_area one_sided = model_map_area(light), both;
	mat4 to_clip;
	glm_mat4_mul((vec4 *)light->frame.world_to_clip, (vec4 *)object->transform, to_clip);
	struct sheet_rule rule = mesh_sheet_rule(mesh, (vec4 *)object->transform, to_clip);
	one_sided.depth_stays = raster_is_coarse((uint32_t)light->snap_bits);
	both = one_sided;
	one_sided.kept = rule.mirrored ? RASTER_BACK : RASTER_FRONT;
	both.kept = RASTER_ALL;
	return model_draw_caster(
		       caster, 0, rule.one_sided, to_clip, &one_sided, keep_sheet, layering) &&
	       model_draw_caster(caster, rule.one_sided, caster->triangle_count, to_clip, &both,
		       keep_sheet, layering);
}

static bool draw_layer(struct layers *layers, const struct model_light *light, int layer)
{
	const struct sm_scene *scene = light->scene;
	int size = light->size;
	size_t count = (size_t)size * (size_t)size;
	layers->of[layer] = array_alloc(count, sizeof(struct sheet));
	if (layers->of[layer] == NULL)
		return false;
	for (size_t i = 0; i < count; i++)
		layers->of[layer][i] = (struct sheet){.depth = NOWHERE};
	struct layering layering = {
		.layer = layers->of[layer],
		.front = layer > 0 ? layers->of[layer - 1] : NULL,
		.size = size,
	};
	for (size_t i = 0; i < scene->object_count; i++)
		if (scene->objects[i].casts && !draw_sheets(&layering, light, &scene->objects[i]))
			return false;
	return true;
}

bool layers_init(struct layers *layers, const struct model_light *light)
{
	for (int i = 0; i < GATHER_LAYERS; i++)
		if (!draw_layer(layers, light, i))
			return false;
	return true;
}

void layers_finish(struct layers *layers)
{
	for (int i = 0; i < GATHER_LAYERS; i++)
		free(layers->of[i]);
	*layers = (struct layers){0};
}
