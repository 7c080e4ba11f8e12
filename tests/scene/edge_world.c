/* SPDX-License-Identifier: MIT */
#include "edge_world.h"
#include "base/array.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

void world_find(struct world *world, const struct edge_grid_options *options)
{
	assert_true(edge_grid_find(&world->grid, world->stage.scene, &world->frame, options));
	/* Nothing but tests and the model follows chains of whole lists. */
	assert_int_equal(world->grid.runs == NULL, world->grid.whole);
	assert_true(edge_grid_find_stretches(&world->grid));
}

void world_finish(struct world *world)
{
	edge_grid_finish(&world->grid);
	stage_finish(&world->stage);
}

void world_load(struct world *world, const char *source, const char *const *settings, size_t count)
{
	struct sm_error error = {0};
	*world = (struct world){0};
	if (!stage_load(&world->stage, source, settings, count, &error))
		fail_msg("%s", error.text);
	light_frame_init(&world->frame, &world->stage.scene->lights[0].desc, world->stage.scene);
}

const struct sm_light_desc world_lamp = {
	.type = SM_LIGHT_SPOT,
	.position = {0.4f, 3.0f, 0.7f},
	.target = {0.1f, 0.0f, 0.0f},
	.radius = 0.2f,
	.angle = 50,
	.color = {1, 1, 1},
	.intensity = 1,
};

void world_init(struct world *world)
{
	*world = (struct world){.stage.scene = sm_scene_create()};
	assert_non_null(world->stage.scene);
}

void world_add_object(
	struct world *world, const struct model *model, const float transform[16], bool casts)
{
	struct sm_mesh_desc mesh = model_desc(model, "part");
	struct sm_object_desc object = {
		.image = SM_NONE, .base_color = {1, 1, 1, 1}, .casts = casts, .receives = true};
	uint32_t handle;
	memcpy(object.transform, transform, sizeof(object.transform));
	assert_true(sm_scene_add_mesh(world->stage.scene, &mesh, &object.mesh, NULL));
	assert_true(sm_scene_add_object(world->stage.scene, &object, &handle, NULL));
}

void world_aim(struct world *world, const struct sm_light_desc *light)
{
	light_frame_init(&world->frame, light, world->stage.scene);
}

/* A corner of a polygon on the raster grid. */
struct step_point {
	int64_t x, y;
};

void world_to_clip_of(const struct world *world, const struct object *object, mat4 to_clip)
{
	glm_mat4_mul((vec4 *)world->frame.world_to_clip, (vec4 *)object->transform, to_clip);
}

void world_project(const mat4 to_clip, const float p[3], double clip[4])
{
	for (int row = 0; row < 4; row++)
		clip[row] = (double)to_clip[0][row] * p[0] + (double)to_clip[1][row] * p[1] +
			    (double)to_clip[2][row] * p[2] + (double)to_clip[3][row];
}

static struct step_point step_point_of(const double clip[4])
{
	return (struct step_point){
		lrint((0.5 + clip[0] * (0.5 / clip[3])) * SCREEN),
		lrint((0.5 + clip[1] * (0.5 / clip[3])) * SCREEN),
	};
}

/* What is beyond the near plane of a triangle; returns how many corners that has. */
static int clip_triangle(double corners[3][4], struct step_point clipped[4])
{
	int count = 0;
	for (int k = 0; k < 3; k++) {
		const double *p = corners[k], *q = corners[(k + 1) % 3];
		double at_p = p[2] + p[3], at_q = q[2] + q[3], cut[4];
		if (at_p >= 0.0)
			clipped[count++] = step_point_of(p);
		if ((at_p >= 0.0) == (at_q >= 0.0))
			continue;
		for (int i = 0; i < 4; i++)
			cut[i] = p[i] + at_p / (at_p - at_q) * (q[i] - p[i]);
		clipped[count++] = step_point_of(cut);
	}
	return count;
}

/* How often a polygon winds around a point whose coordinates are x / denominator: sides that pass
 * it to the right, going up; a side has its lower end and lacks its upper. */
static int winds(
	const struct step_point *corners, int count, int64_t x, int64_t y, int64_t denominator)
{
	int sum = 0;
	for (int k = 0; k < count; k++) {
		struct step_point a = corners[k], b = corners[(k + 1) % count];
		bool a_above = a.y * denominator >= y, b_above = b.y * denominator >= y;
		if (a_above == b_above)
			continue;
		int64_t side = (b.x - a.x) * (y - a.y * denominator) -
			       (b.y - a.y) * (x - a.x * denominator);
		if (b_above && side > 0)
			sum++;
		if (a_above && side < 0)
			sum--;
	}
	return sum;
}

/* Adds the sheet that a triangle is to the counts of the tiles whose centres it covers. */
static void count_triangle(double corners[3][4], bool turned, uint32_t tiles, int *counts)
{
	struct step_point polygon[4];
	int corner_count = clip_triangle(corners, polygon);
	for (uint32_t t = 0; t < tiles * tiles; t++) {
		int64_t x = (2 * (int64_t)(t % tiles) + 1) * SCREEN;
		int64_t y = (2 * (int64_t)(t / tiles) + 1) * SCREEN;
		int winding = winds(polygon, corner_count, x, y, 2 * (int64_t)tiles);
		counts[t] += turned ? -winding : winding;
	}
}

/* Counts the sheets over the centre of each tile: triangles that face the light, those of parts
 * that are not closed also when they do not. */
static void count_sheets(const struct world *world, uint32_t tiles, int *counts)
{
	const struct sm_scene *scene = world->stage.scene;
	memset(counts, 0, tiles * tiles * sizeof(*counts));
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		const struct caster *caster = &scene->meshes[object->mesh].caster;
		if (!object->casts)
			continue;
		uint64_t *facing = array_zalloc(facing_words(caster), sizeof(*facing));
		assert_non_null(facing);
		mat4 to_clip, to_object;
		vec4 light;
		world_to_clip_of(world, object, to_clip);
		glm_mat4_inv((vec4 *)object->transform, to_object);
		glm_mat4_mulv(to_object, (float *)world->frame.origin, light);
		facing_find(caster, light, facing);
		struct sheet_rule rule = mesh_sheet_rule(
			&scene->meshes[object->mesh], (vec4 *)object->transform, to_clip);
		for (size_t t = 0; t < caster->triangle_count; t++) {
			bool faces = facing[t / 64] >> t % 64 & 1;
			if (!faces && t < rule.one_sided)
				continue;
			double corners[3][4];
			for (int k = 0; k < 3; k++)
				world_project(to_clip,
					caster->positions[caster->indices[3 * t + (size_t)k]],
					corners[k]);
			count_triangle(corners, faces == rule.mirrored, tiles, counts);
		}
		free(facing);
	}
}

void assert_winding_counts_sheets(const struct world *world, const char *what)
{
	const struct edge_grid *grid = &world->grid;
	int *counts = array_alloc((size_t)grid->tiles * grid->tiles, sizeof(*counts));
	assert_non_null(counts);
	count_sheets(world, grid->tiles, counts);
	for (uint32_t t = 0; t < grid->tiles * grid->tiles; t++)
		if (edge_tile_winding(&grid->of[t]) != counts[t])
			fail_msg("%s: tile %u has %d sheets and a winding number of %d", what, t,
				counts[t], edge_tile_winding(&grid->of[t]));
	free(counts);
}
