/* SPDX-License-Identifier: MIT */
#include "need.h"

bool box_on_screen(mat4 to_clip, const struct cluster *box, float min[3], float max[3])
{
	min[0] = min[1] = min[2] = INFINITY;
	max[0] = max[1] = max[2] = -INFINITY;
	for (int corner = 0; corner < 8; corner++) {
		vec4 p = {1.0f, 1.0f, 1.0f, 1.0f};
		for (int axis = 0; axis < 3; axis++)
			p[axis] = corner >> axis & 1 ? box->max[axis] : box->min[axis];
		glm_mat4_mulv(to_clip, p, p);
		/* The projection has no finite bounds at w = 0; false for NaN too. */
		if (!(p[3] > 0.0f))
			return false;
		for (int axis = 0; axis < 3; axis++) {
			min[axis] = fminf(min[axis], p[axis] / p[3]);
			max[axis] = fmaxf(max[axis], p[axis] / p[3]);
		}
	}
	return true;
}

void mark_box(struct screen_grid *cells, mat4 to_clip, const struct cluster *box, float slack)
{
	static const uint8_t sides[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
	float min[3], max[3];
	if (!box_on_screen(to_clip, box, min, max)) {
		screen_grid_fill(cells);
		return;
	}
	const struct screen_point corners[4] = {
		{min[0], min[1]}, {max[0], min[1]}, {max[0], max[1]}, {min[0], max[1]}};
	screen_grid_add(cells, corners, sides, 4, slack);
}

static void mark_casters(struct screen_grid *cells, const struct gpu_scene *gpu,
	const struct sm_scene *scene, const struct light_frame *frame, float reach,
	uint32_t map_size)
{
	/* A surface looks up texels whose centres lie up to one texel off, and the technique's
	 * reach; half a texel more for what the rasteriser snaps. NDC are 2 wide. */
	float slack = (1.5f / (float)map_size + reach / 2.0f) * SCREEN_GRID_SIZE;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		const struct gpu_mesh *mesh = &gpu->meshes[object->mesh];
		mat4 to_clip;
		if (!object->casts)
			continue;
		glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
		for (size_t j = 0; j < mesh->cluster_count; j++)
			mark_box(cells, to_clip, &mesh->clusters[j], slack);
	}
}

void need_map_find(struct need_map *map, const struct gpu_scene *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct screen_grid *soft, bool soft_is_all,
	float reach, uint32_t map_size)
{
	*map = (struct need_map){.cone = INFINITY};
	if (soft == NULL || !soft_is_all)
		mark_casters(&map->cells[NEED_MAP], gpu, scene, frame, reach, map_size);
	map->cells[NEED_TECHNIQUE] = soft != NULL ? *soft : map->cells[NEED_MAP];
	map->cells[NEED_BEHIND] = map->cells[NEED_TECHNIQUE];
}

static bool has_need(
	const struct need_map *map, enum need need, const float min[3], const float max[3])
{
	return screen_grid_touches(&map->cells[need], min, max) &&
	       (need < NEED_BEHIND || map->soft == NULL ||
		       screen_depths_before(map->soft, min, max, 0.5f * max[2] + 0.5f));
}

/* So far behind all casters, window depth, that shaders agree: far more than floats round. */
#define BEHIND_MARGIN 1e-4f

static bool is_behind(const struct need_map *map, const float min[3], const float max[3])
{
	return map->farthest != NULL &&
	       0.5f * min[2] + 0.5f > screen_grid_most(map->farthest, min, max) + BEHIND_MARGIN;
}

enum need need_of_space(const struct need_map *map, const float min[3], const float max[3])
{
	float cone = map->cone;
	if (max[0] < -cone || min[0] > cone || max[1] < -cone || min[1] > cone)
		return NEED_AMBIENT;
	enum need need = is_behind(map, min, max) ? NEED_BEHIND : NEED_TECHNIQUE;
	while (need > NEED_LIGHT && !has_need(map, need, min, max))
		need--;
	return need;
}

enum need need_of_box(const struct need_map *map, mat4 to_light_clip, const struct cluster *box)
{
	float min[3], max[3];
	if (!box_on_screen(to_light_clip, box, min, max))
		return NEED_TECHNIQUE;
	return need_of_space(map, min, max);
}
