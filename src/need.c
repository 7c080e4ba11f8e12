/* SPDX-License-Identifier: MIT */
#include "need.h"

/* One of eight, in clip space; false if it is behind the eye. */
static bool find_corner(mat4 to_clip, const struct cluster *box, int corner, vec4 p)
{
	for (int axis = 0; axis < 3; axis++)
		p[axis] = corner >> axis & 1 ? box->max[axis] : box->min[axis];
	p[3] = 1.0f;
	glm_mat4_mulv(to_clip, p, p);
	/* The projection has no finite bounds at w = 0; false for NaN too. */
	return p[3] > 0.0f;
}

bool box_on_screen(mat4 to_clip, const struct cluster *box, float min[3], float max[3])
{
	min[0] = min[1] = min[2] = INFINITY;
	max[0] = max[1] = max[2] = -INFINITY;
	for (int corner = 0; corner < 8; corner++) {
		vec4 p;
		if (!find_corner(to_clip, box, corner, p))
			return false;
		for (int axis = 0; axis < 3; axis++) {
			min[axis] = fminf(min[axis], p[axis] / p[3]);
			max[axis] = fmaxf(max[axis], p[axis] / p[3]);
		}
	}
	return true;
}

/* Pairs of corners. */
static const uint8_t box_edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6},
	{5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

/* False: it may be anywhere. */
static bool find_outline(mat4 to_clip, const struct cluster *box, struct screen_point corners[8])
{
	vec4 p;
	for (int corner = 0; corner < 8; corner++) {
		if (!find_corner(to_clip, box, corner, p))
			return false;
		corners[corner] = (struct screen_point){p[0] / p[3], p[1] / p[3]};
		if (!isfinite(corners[corner].x) || !isfinite(corners[corner].y))
			return false;
	}
	return true;
}

void mark_box(struct screen_grid *cells, mat4 to_clip, const struct cluster *box, float slack)
{
	struct screen_point corners[8];
	if (find_outline(to_clip, box, corners))
		screen_grid_add(cells, corners, box_edges, 12, slack);
	else
		screen_grid_fill(cells);
}

static void find_bounds(const struct screen_point corners[8], float min[2], float max[2])
{
	min[0] = max[0] = corners[0].x;
	min[1] = max[1] = corners[0].y;
	for (int i = 1; i < 8; i++) {
		min[0] = fminf(min[0], corners[i].x);
		min[1] = fminf(min[1], corners[i].y);
		max[0] = fmaxf(max[0], corners[i].x);
		max[1] = fmaxf(max[1], corners[i].y);
	}
}

/* slack: NDC */
static void cover_box(
	struct screen_cover *cover, mat4 to_clip, const struct cluster *box, float slack)
{
	struct screen_point corners[8];
	float min[2], max[2];
	if (!find_outline(to_clip, box, corners)) {
		screen_cover_fill(cover);
		return;
	}
	find_bounds(corners, min, max);
	float width = max[0] - min[0], height = max[1] - min[1];
	/* An outline takes longer, and leaves little of a rectangle out that is slack for the most
	 * part. */
	if (2.0f * width * height < (width + 2.0f * slack) * (height + 2.0f * slack)) {
		for (int axis = 0; axis < 2; axis++) {
			min[axis] -= slack;
			max[axis] += slack;
		}
		screen_cover_add_rectangle(cover, min, max);
	} else {
		screen_cover_add(cover, corners, box_edges, 12, 0.5f * slack * SCREEN_COVER_SIZE);
	}
}

static void cover_casters(struct screen_cover *cover, const struct gpu_scene *gpu,
	const struct sm_scene *scene, const struct light_frame *frame, float reach,
	uint32_t map_size)
{
	/* A surface looks up texels whose centres lie up to one texel off, and the technique's
	 * reach; half a texel more for what the rasteriser snaps. NDC are 2 wide. */
	float slack = 3.0f / (float)map_size + reach;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		const struct gpu_mesh *mesh = &gpu->meshes[object->mesh];
		mat4 to_clip;
		if (!object->casts)
			continue;
		glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, to_clip);
		for (size_t j = 0; j < mesh->cluster_count; j++)
			cover_box(cover, to_clip, &mesh->clusters[j], slack);
	}
}

void need_map_find(struct need_map *map, const struct gpu_scene *gpu, const struct sm_scene *scene,
	const struct light_frame *frame, const struct screen_grid *soft, bool soft_is_all,
	float reach, uint32_t map_size)
{
	*map = (struct need_map){.by_cells = soft != NULL, .cone = INFINITY};
	if (soft == NULL || !soft_is_all)
		cover_casters(&map->casters, gpu, scene, frame, reach, map_size);
	if (soft != NULL)
		map->cells = *soft;
}

/* Whether surfaces need the technique, in the cells that tell. */
static bool is_soft(const struct need_map *map, const float min[3], const float max[3])
{
	return screen_grid_touches(&map->cells, min, max) &&
	       (map->soft == NULL ||
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
	enum need technique = is_behind(map, min, max) ? NEED_BEHIND : NEED_TECHNIQUE;
	if (map->by_cells && is_soft(map, min, max))
		return technique;
	if (!screen_cover_touches(&map->casters, min, max))
		return NEED_LIGHT;
	return map->by_cells ? NEED_MAP : technique;
}

enum need need_of_box(const struct need_map *map, mat4 to_light_clip, const struct cluster *box)
{
	float min[3], max[3];
	if (!box_on_screen(to_light_clip, box, min, max))
		return NEED_TECHNIQUE;
	return need_of_space(map, min, max);
}
