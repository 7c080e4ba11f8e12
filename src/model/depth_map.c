/* SPDX-License-Identifier: MIT */
#include "model/depth_map.h"
#include "base/array.h"
#include "base/error.h"
#include "model/transform.h"
#include <stdlib.h>

#define DEPTH_MOST 16777215.0 /* 2^24 - 1 */

float model_round_depth(double depth)
{
	return (float)(rint(depth * DEPTH_MOST) / DEPTH_MOST);
}

static void keep_nearest(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth)
{
	struct model_map *map = data;
	float *kept = &map->depths[(size_t)y * (size_t)map->size + (size_t)x];
	float rounded = model_round_depth(depth);
	(void)triangle;
	if (rounded < *kept)
		*kept = rounded;
}

static void keep_farthest(
	void *data, const struct raster_triangle *triangle, int x, int y, double depth)
{
	struct model_map *map = data;
	float *kept = &map->depths[(size_t)y * (size_t)map->size + (size_t)x];
	float rounded = model_round_depth(depth);
	(void)triangle;
	if (rounded > *kept)
		*kept = rounded;
}

static bool is_drawn(const struct object *object, enum model_content content)
{
	return content == MODEL_CASTERS ? object->casts : object->receives && !object->casts;
}

bool model_draw_caster(const struct caster *caster, size_t first, size_t end, mat4 to_clip,
	const struct raster_area *area, raster_fragment keep, void *data)
{
	if (first == end)
		return true;
	double(*corners)[4] =
		transform_all(to_clip, (const float(*)[3])caster->positions, caster->vertex_count);
	if (corners == NULL)
		return false;
	for (size_t i = first; i < end; i++) {
		double triangle[3][4];
		pick_corners((const double(*)[4])corners, &caster->indices[3 * i], triangle);
		raster_draw(area, (const double(*)[4])triangle, keep, data);
	}
	free(corners);
	return true;
}

static bool draw_object(struct model_map *map, const struct mesh *mesh, const struct object *object,
	const struct light_frame *frame, struct raster_area area, raster_fragment keep)
{
	mat4 to_clip;
	glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
	area.kept = kept_faces(mesh, object, to_clip, false);
	return model_draw_caster(
		&mesh->caster, 0, mesh->caster.triangle_count, to_clip, &area, keep, map);
}

bool model_map_init_from(struct model_map *map, const struct model_light *light,
	const struct light_frame *frame, enum model_content content, struct sm_error *error)
{
	bool farthest = content == MODEL_FARTHEST_RECEIVERS;
	size_t size = (size_t)light->size;
	*map = (struct model_map){.size = light->size};
	map->depths = array_alloc(size * size, sizeof(*map->depths));
	if (map->depths == NULL)
		return error_no_memory(error);
	for (size_t i = 0; i < size * size; i++)
		map->depths[i] = farthest ? 0.0f : 1.0f;
	for (size_t i = 0; i < light->scene->object_count; i++) {
		const struct object *object = &light->scene->objects[i];
		const struct mesh *mesh = &light->scene->meshes[object->mesh];
		if (is_drawn(object, content) &&
			!draw_object(map, mesh, object, frame, model_map_area(light),
				farthest ? keep_farthest : keep_nearest))
			return error_no_memory(error);
	}
	return true;
}

bool model_map_init(struct model_map *map, const struct model_light *light,
	enum model_content content, struct sm_error *error)
{
	return model_map_init_from(map, light, &light->frame, content, error);
}

void model_map_finish(struct model_map *map)
{
	free(map->depths);
	*map = (struct model_map){0};
}

static int clamp_index(int i, int size)
{
	return i < 0 ? 0 : i < size ? i : size - 1;
}

double model_map_at(const struct model_map *map, int x, int y)
{
	x = clamp_index(x, map->size);
	y = clamp_index(y, map->size);
	return map->depths[(size_t)y * (size_t)map->size + (size_t)x];
}
