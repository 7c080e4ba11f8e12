/* SPDX-License-Identifier: MIT */
/* Silhouettes listed by the tiles of a light's screen: against every sheet, every edge and a host
 * of receivers tried one by one, in doubles. */
#include "scene/edge_grid.h"
#include "base/array.h"
#include "load/stage.h"
#include "models.h"
#include "scene/edge_winding.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define MAP_SIZE 512
#define SUBPIXEL_BITS 8
#define SCREEN (MAP_SIZE << SUBPIXEL_BITS)
#define VERTICES_MAX 1000000

/* A scene with a light, and its grid. */
struct world {
	struct stage stage; /* owns the scene */
	struct light_frame frame;
	struct edge_grid grid;
};

static const struct edge_grid_options usual = {64, MAP_SIZE, SUBPIXEL_BITS, VERTICES_MAX};

static void find(struct world *world, const struct edge_grid_options *options)
{
	assert_true(edge_grid_find(&world->grid, world->stage.scene, &world->frame, options));
}

static void finish(struct world *world)
{
	edge_grid_finish(&world->grid);
	stage_finish(&world->stage);
}

/* Points the scene's first light, changed by the settings, at the scene. */
static void load(struct world *world, const char *source, const char *const *settings, size_t count)
{
	struct sm_error error = {0};
	*world = (struct world){0};
	if (!stage_load(&world->stage, source, settings, count, &error))
		fail_msg("%s", error.text);
	light_frame_init(&world->frame, &world->stage.scene->lights[0].desc, world->stage.scene);
}

static const struct sm_light_desc lamp = {
	.type = SM_LIGHT_SPOT,
	.position = {0.4f, 3.0f, 0.7f},
	.target = {0.1f, 0.0f, 0.0f},
	.radius = 0.2f,
	.angle = 50,
	.color = {1, 1, 1},
	.intensity = 1,
};

static void init(struct world *world)
{
	*world = (struct world){.stage.scene = sm_scene_create()};
	assert_non_null(world->stage.scene);
}

static void add_object(
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

static void aim(struct world *world, const struct sm_light_desc *light)
{
	light_frame_init(&world->frame, light, world->stage.scene);
}

/* ---------------------------------------------------------------------------------------------
 * Winding numbers
 */

/* A corner of a polygon on the raster grid. */
struct step_point {
	int64_t x, y;
};

static void to_clip_of(const struct world *world, const struct object *object, mat4 to_clip)
{
	glm_mat4_mul((vec4 *)world->frame.world_to_clip, (vec4 *)object->transform, to_clip);
}

static void project(const mat4 to_clip, const float p[3], double clip[4])
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
		to_clip_of(world, object, to_clip);
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
				project(to_clip,
					caster->positions[caster->indices[3 * t + (size_t)k]],
					corners[k]);
			count_triangle(corners, faces == rule.mirrored, tiles, counts);
		}
		free(facing);
	}
}

static void assert_winding_counts_sheets(const struct world *world, const char *what)
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

/* ---------------------------------------------------------------------------------------------
 * Lists
 */

/* Each list: chains of an edge at least, the nearest first, said so by their starts. */
static void assert_lists_are_in_order(const struct world *world, const char *what)
{
	const struct edge_grid *grid = &world->grid;
	size_t sum = 0;
	for (uint32_t t = 0; t < grid->tiles * grid->tiles; t++) {
		const struct edge_tile *tile = &grid->of[t];
		uint32_t count = edge_tile_count(tile);
		const struct chain_vertex *list = &grid->vertices[tile->first];
		if (count == 0) {
			assert_true(tile->nearest == 2.0f);
			continue;
		}
		assert_int_equal(tile->first, sum);
		sum += count;
		assert_true(sum <= grid->vertex_count);
		assert_true(list[0].start >= 1.0f);
		float start = list[0].start;
		for (uint32_t i = 0; i < count; i++) {
			if (list[i].start != 0.0f) {
				if (list[i].start < start || i + 1 == count ||
					list[i + 1].start != 0.0f)
					fail_msg("%s: tile %u: chain at %u", what, t, i);
				start = list[i].start;
			}
			if (!(list[i].depth >= start - 1.0f) || !(list[i].depth >= tile->nearest))
				fail_msg("%s: tile %u: depth %g, start %g", what, t,
					(double)list[i].depth, (double)start);
			assert_true(isfinite(list[i].x) && isfinite(list[i].y) &&
				    isfinite(list[i].depth));
		}
	}
	assert_int_equal(sum, grid->vertex_count);
}

static struct chain_vertex vertex_of(const struct chain_point *point)
{
	return (struct chain_vertex){
		(float)point->x / SCREEN, (float)point->y / SCREEN, point->depth, 0.0f};
}

static bool same_place(const struct chain_vertex *a, const struct chain_vertex *b)
{
	return a->x == b->x && a->y == b->y && a->depth == b->depth;
}

/* How often a tile lists an edge. */
static int times_listed(const struct edge_grid *grid, uint32_t t, const struct chain_point *edge)
{
	const struct chain_vertex *list = &grid->vertices[grid->of[t].first];
	struct chain_vertex a = vertex_of(&edge[0]), b = vertex_of(&edge[1]);
	int times = 0;
	for (uint32_t i = 1; i < edge_tile_count(&grid->of[t]); i++)
		times += list[i].start == 0.0f && same_place(&list[i - 1], &a) &&
			 same_place(&list[i], &b);
	return times;
}

/* A point that is lit or not. */
struct receiver {
	double x, y, depth;
	uint32_t tile;
};

static double scale_of(const struct world *world)
{
	return (double)disc_scale(&world->frame);
}

/* Whether what is at x, y, depth stands before the light's disc, which faces the receiver. */
static bool is_before_disc(const struct world *world, const struct receiver *receiver, double x,
	double y, double depth)
{
	const struct light_frame *frame = &world->frame;
	double vx = x - receiver->x, vy = y - receiver->y, before = receiver->depth - depth;
	if (!frame->parallel) {
		double half = (double)frame->half_extent;
		double ex = (2.0 * receiver->x - 1.0) * half, ey = (2.0 * receiver->y - 1.0) * half;
		double e2 = ex * ex + ey * ey, along = ex * vx + ey * vy;
		double k = 1.0 / (1.0 + e2 + sqrt(1.0 + e2));
		before -= 2.0 * half * ((double)frame->pole - receiver->depth) / (1.0 + e2) * along;
		vx -= ex * along * k;
		vy -= ey * along * k;
	}
	return before > 0.0 && hypot(vx, vy) <= scale_of(world) * before;
}

/* Whether x, y is within 1.5 texels of the map from the tile. */
static bool touches_tile(const struct edge_grid *grid, uint32_t t, double x, double y)
{
	double left = t % grid->tiles, bottom = t / grid->tiles;
	double dx = fmax(fmax(left - x * grid->tiles, x * grid->tiles - left - 1.0), 0.0);
	double dy = fmax(fmax(bottom - y * grid->tiles, y * grid->tiles - bottom - 1.0), 0.0);
	return hypot(dx, dy) <= 1.5 / MAP_SIZE * grid->tiles;
}

/* Whether the edge is any of the receiver's concern, at one of many of its points. */
static bool concerns(
	const struct world *world, const struct receiver *receiver, const struct chain_point *edge)
{
	struct chain_vertex a = vertex_of(&edge[0]), b = vertex_of(&edge[1]);
	for (int i = 0; i <= 64; i++) {
		double share = i / 64.0;
		double x = a.x + share * ((double)b.x - a.x), y = a.y + share * ((double)b.y - a.y);
		double depth = a.depth + share * ((double)b.depth - a.depth);
		if (is_before_disc(world, receiver, x, y, depth) ||
			touches_tile(&world->grid, receiver->tile, x, y))
			return true;
	}
	return false;
}

/* Whether a receiver is farther from a spot, along its axis, than four thirds of its radius. */
static bool is_off_the_light(const struct world *world, double depth)
{
	const struct light_frame *frame = &world->frame;
	return frame->parallel ||
	       2.0 * (double)frame->half_extent * scale_of(world) * ((double)frame->pole - depth) <
		       0.75;
}

/* A random point of a triangle; false if it is not on the screen, or too near to a spot. */
static bool pick_receiver(const struct world *world, const struct object *object, size_t triangle,
	uint64_t *random, struct receiver *receiver)
{
	const struct mesh *mesh = &world->stage.scene->meshes[object->mesh];
	double u = 0.5 + 0.5 * (double)random_signed(random);
	double v = (1.0 - u) * (0.5 + 0.5 * (double)random_signed(random));
	float point[3];
	for (int axis = 0; axis < 3; axis++) {
		double p[3];
		for (size_t k = 0; k < 3; k++)
			p[k] = (double)mesh->positions[mesh->indices[3 * triangle + k]][axis];
		point[axis] = (float)(p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]));
	}
	mat4 to_clip;
	double clip[4];
	to_clip_of(world, object, to_clip);
	project(to_clip, point, clip);
	if (!(clip[2] > -clip[3]))
		return false;
	uint32_t tiles = world->grid.tiles;
	receiver->x = 0.5 + 0.5 * clip[0] / clip[3];
	receiver->y = 0.5 + 0.5 * clip[1] / clip[3];
	receiver->depth = 0.5 + 0.5 * clip[2] / clip[3];
	if (!(receiver->x > 0.0 && receiver->x < 1.0 && receiver->y > 0.0 && receiver->y < 1.0))
		return false;
	receiver->tile = (uint32_t)(receiver->y * tiles) * tiles + (uint32_t)(receiver->x * tiles);
	return is_off_the_light(world, receiver->depth);
}

static void assert_lists_all(
	const struct world *world, const struct receiver *receiver, const char *what)
{
	const struct edge_chains *chains = &world->grid.chains;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (edge->ends || !concerns(world, receiver, edge))
			continue;
		if (times_listed(&world->grid, receiver->tile, edge) == 0)
			fail_msg("%s: edge %zu concerns (%g, %g, %g) and is not listed in tile %u",
				what, i, receiver->x, receiver->y, receiver->depth, receiver->tile);
	}
}

/* Receivers that are asked. */
#define RECEIVERS 120

static void assert_receivers_find_their_edges(const struct world *world, const char *what)
{
	const struct sm_scene *scene = world->stage.scene;
	uint64_t random = 7;
	int asked = 0;
	for (int i = 0; i < 40 * RECEIVERS && asked < RECEIVERS; i++) {
		const struct object *object =
			&scene->objects[random_next(&random) % scene->object_count];
		size_t triangles = scene->meshes[object->mesh].index_count / 3;
		struct receiver receiver;
		if (!object->receives ||
			!pick_receiver(world, object, random_next(&random) % triangles, &random,
				&receiver))
			continue;
		asked++;
		assert_lists_all(world, &receiver, what);
		/* Nothing that casts is behind what is said to be the farthest. */
		if (object->casts && mesh_beyond_near(&scene->meshes[object->mesh],
					     (vec4 *)world->frame.world_to_clip))
			assert_true(world->grid.depths.deepest[receiver.tile] >=
				    (float)receiver.depth - 1e-5f);
	}
	assert_int_equal(asked, RECEIVERS);
}

/* A point of a sheet is not behind its tile's farthest caster. */
static void assert_sheets_are_not_behind_farthest(const struct world *world, const char *what)
{
	const struct edge_grid *grid = &world->grid;
	for (size_t i = 0; i < grid->chains.count; i++) {
		struct chain_vertex at = vertex_of(&grid->chains.points[i]);
		if (!(at.x >= 0.0f && at.x < 1.0f && at.y >= 0.0f && at.y < 1.0f))
			continue;
		uint32_t t = (uint32_t)(at.y * (float)grid->tiles) * grid->tiles +
			     (uint32_t)(at.x * (float)grid->tiles);
		if (at.depth > grid->of[t].farthest + 1e-5f)
			fail_msg("%s: tile %u: %g is behind %g", what, t, (double)at.depth,
				(double)grid->of[t].farthest);
	}
}

static void assert_grid(const struct world *world, const char *what)
{
	assert_int_equal(world->grid.dropped, 0);
	assert_winding_counts_sheets(world, what);
	assert_lists_are_in_order(world, what);
	assert_sheets_are_not_behind_farthest(world, what);
	assert_receivers_find_their_edges(world, what);
}

static void scenes_are_counted_and_listed(void **state)
{
	(void)state;
	static const struct {
		const char *source, *settings[3];
		size_t setting_count;
		uint32_t tiles;
	} rows[] = {
		{"builtin:cylinder", {0}, 0, 128},
		{"builtin:boxes", {0}, 0, 64},
		{"builtin:boxes", {"light.type=directional", "light.radius=0.6"}, 2, 32},
		{"builtin:fence", {"light.radius=0.6"}, 1, 64},
		{"builtin:knot", {0}, 0, 64},
		{"builtin:knot", {"light.type=directional"}, 1, 64},
		{"builtin:debris:600", {"light.radius=0.6"}, 1, 64},
		{"builtin:urchin:2000", {"light.angle=90", "light.position=0.5 1.6 0.2"}, 2, 32},
		{"builtin:primitives", {0}, 0, 64},
	};
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct world world;
		struct edge_grid_options options = usual;
		options.tiles = rows[i].tiles;
		load(&world, rows[i].source, rows[i].settings, rows[i].setting_count);
		find(&world, &options);
		assert_int_equal(world.grid.tiles, rows[i].tiles);
		assert_true(world.grid.edge_count > 0);
		assert_grid(&world, rows[i].source);
		finish(&world);
	}
}

/* Column-major. */
static const float unmoved[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
static const float mirrored[16] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, .2f, 0, 0, 1};
static const float sheared[16] = {.8f, .1f, 0, 0, .3f, -1.2f, .2f, 0, .1f, 0, 1, 0, 0, .2f, 0, 1};
/* A wide floor below. */
static const float below[16] = {6, 0, 0, 0, 0, 0, -6, 0, 0, 6, 0, 0, -3, -1.5f, 3, 1};

static void whatever_the_mesh_winding_numbers_count_its_sheets(void **state)
{
	(void)state;
	const struct {
		const char *name;
		struct model model;
	} rows[] = {
		{"tetrahedron", model_tetrahedron()},
		{"cube", model_cube()},
		{"sphere", model_sphere(3)},
		{"grid, open", model_grid(5)},
		{"strip, open", model_strip()},
		{"fan of five", model_fan()},
		{"moebius strip", model_moebius()},
		{"doubled", model_doubled(false)},
		{"doubled and turned", model_doubled(true)},
		{"soup", model_soup(40, 120)},
		{"larger soup", model_soup(200, 300)},
	};
	static const float *const transforms[] = {unmoved, mirrored, sheared};
	struct model floor = model_grid(2);
	for (size_t i = 0; i < 6 * sizeof(rows) / sizeof(rows[0]); i++) {
		struct world world;
		struct sm_light_desc light = lamp;
		light.type = i % 2 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT;
		init(&world);
		add_object(&world, &rows[i / 6].model, transforms[i / 2 % 3], true);
		add_object(&world, &floor, below, false);
		aim(&world, &light);
		find(&world, &usual);
		assert_grid(&world, rows[i / 6].name);
		finish(&world);
	}
	model_finish(&floor);
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		model_finish((struct model *)&rows[i].model);
}

/* A light in the middle of a mesh: what is around it and before the near plane is cut off. */
static void a_light_inside_a_caster_sees_what_is_beyond_the_near_plane(void **state)
{
	(void)state;
	const struct {
		const char *name;
		struct model model;
	} rows[] = {
		{"cube", model_cube()},
		{"sphere", model_sphere(3)},
		{"grid", model_grid(6)},
		{"moebius strip", model_moebius()},
		{"soup", model_soup(60, 100)},
	};
	static const float *const transforms[] = {unmoved, mirrored, sheared};
	struct model floor = model_grid(2);
	for (size_t i = 0; i < 3 * sizeof(rows) / sizeof(rows[0]); i++) {
		struct world world;
		struct sm_light_desc light = lamp;
		light.position[0] = light.position[2] = 0.03f;
		light.position[1] = 0.02f;
		light.angle = 90;
		init(&world);
		add_object(&world, &rows[i / 3].model, transforms[i % 3], true);
		add_object(&world, &floor, below, false);
		aim(&world, &light);
		find(&world, &usual);
		assert_grid(&world, rows[i / 3].name);
		finish(&world);
	}
	model_finish(&floor);
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		model_finish((struct model *)&rows[i].model);
}

/* Edges in all lists that are not behind a depth, and are. */
static void count_entries(const struct edge_grid *grid, float depth, size_t *before, size_t *behind)
{
	*before = *behind = 0;
	for (size_t i = 1; i < grid->vertex_count; i++) {
		if (grid->vertices[i].start != 0.0f)
			continue;
		float nearest = fminf(grid->vertices[i - 1].depth, grid->vertices[i].depth);
		*(nearest <= depth ? before : behind) += 1;
	}
}

static void fewer_tiles_and_then_fewer_edges_where_lists_grow_too_long(void **state)
{
	(void)state;
	struct world world, all;
	struct edge_grid_options options = {128, MAP_SIZE, SUBPIXEL_BITS, VERTICES_MAX};
	static const char *const wide[] = {"light.radius=0.6"};
	load(&world, "builtin:debris:600", wide, 1);
	load(&all, "builtin:debris:600", wide, 1);
	options.tiles = 32;
	find(&all, &options);
	size_t enough = all.grid.vertex_count, entries, none;
	count_entries(&all.grid, 1.0f, &entries, &none);
	assert_int_equal(none, 0);

	options.tiles = 128;
	options.vertices_max = enough;
	find(&world, &options);
	assert_int_equal(world.grid.tiles, 32);
	assert_grid(&world, "debris on 32 tiles");

	size_t rooms[] = {enough - 1, enough / 2, enough / 10, 100, 3, 2, 1, 0};
	for (size_t i = 0; i < sizeof(rooms) / sizeof(rooms[0]); i++) {
		options.vertices_max = rooms[i];
		find(&world, &options);
		assert_int_equal(world.grid.tiles, 32);
		assert_true(world.grid.vertex_count <= rooms[i]);
		assert_lists_are_in_order(&world, "debris without room");
		assert_winding_counts_sheets(&world, "debris without room");
		size_t kept, missing, beyond;
		count_entries(&world.grid, 2.0f, &kept, &none);
		assert_int_equal(kept + world.grid.dropped, entries);
		if (rooms[i] < enough / 10)
			continue;
		/* No edge is missing that is nearer, by a thousandth of all depths. */
		assert_true(world.grid.vertex_count > rooms[i] / 2);
		float deepest = 0.0f;
		for (size_t k = 1; k < world.grid.vertex_count; k++)
			if (world.grid.vertices[k].start == 0.0f)
				deepest = fmaxf(deepest, fminf(world.grid.vertices[k - 1].depth,
								 world.grid.vertices[k].depth));
		count_entries(&all.grid, deepest - 1e-3f, &missing, &beyond);
		count_entries(&world.grid, deepest - 1e-3f, &kept, &none);
		assert_int_equal(kept, missing);
	}
	finish(&world);
	finish(&all);
}

/* Winding numbers at the centres of a map's texels. */
static int32_t *texel_winding(const struct edge_chains *chains)
{
	int32_t *winding = array_alloc((size_t)MAP_SIZE * MAP_SIZE, sizeof(*winding));
	assert_non_null(winding);
	edge_winding_find(chains, SCREEN, MAP_SIZE, winding);
	return winding;
}

/* Distance of a point from an edge, steps. */
static double distance_from(const struct chain_point *point, const struct chain_point *edge)
{
	double run = (double)edge[1].x - edge[0].x, rise = (double)edge[1].y - edge[0].y;
	double x = (double)point->x - edge[0].x, y = (double)point->y - edge[0].y;
	double length2 = run * run + rise * rise;
	double share = length2 > 0.0 ? (x * run + y * rise) / length2 : 0.0;
	share = fmax(0.0, fmin(share, 1.0));
	return hypot(x - share * run, y - share * rise);
}

static void assert_is_near_an_edge(
	const struct chain_point *point, const struct edge_chains *chains, double most)
{
	double least = INFINITY;
	for (size_t i = 0; i + 1 < chains->count && least > most; i++)
		if (!chains->points[i].ends)
			least = fmin(least, distance_from(point, &chains->points[i]));
	assert_true(least <= most);
}

static void merged_edges_wind_around_each_texel_as_before(void **state)
{
	(void)state;
	static const struct {
		const char *source;
		float at_most; /* points left, of those there were */
	} rows[] = {{"builtin:knot:100000", 0.7f}, {"builtin:urchin:20000", 1.0f},
		{"builtin:debris:600", 1.0f}};
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct world world, merged;
		struct edge_grid_options options = usual;
		load(&world, rows[i].source, NULL, 0);
		load(&merged, rows[i].source, NULL, 0);
		find(&world, &options);
		options.merge = 0.125f;
		find(&merged, &options);
		const struct edge_chains *before = &world.grid.chains, *after = &merged.grid.chains;
		assert_true((float)after->count <= rows[i].at_most * (float)before->count);
		assert_int_equal(merged.grid.edge_count, world.grid.edge_count);
		assert_lists_are_in_order(&merged, rows[i].source);
		int32_t *is = texel_winding(after), *was = texel_winding(before);
		assert_memory_equal(is, was, sizeof(*is) * MAP_SIZE * MAP_SIZE);
		for (size_t k = 0; k < before->count; k += 7)
			assert_is_near_an_edge(&before->points[k], after, 0.125 * 256);
		free(is);
		free(was);
		finish(&world);
		finish(&merged);
	}
}

static void assert_nothing_listed(const struct world *world)
{
	assert_int_equal(world->grid.vertex_count, 0);
	assert_true(world->grid.mean_list == 0.0f);
	for (uint32_t t = 0; t < world->grid.tiles * world->grid.tiles; t++)
		assert_true(edge_tile_count(&world->grid.of[t]) == 0 &&
			    world->grid.of[t].nearest == 2.0f);
}

static void without_casters_or_receivers_nothing_is_listed(void **state)
{
	(void)state;
	struct world world;
	struct model floor = model_grid(2), cube = model_cube();
	init(&world);
	aim(&world, &lamp);
	find(&world, &usual);
	assert_nothing_listed(&world);
	add_object(&world, &floor, below, false);
	aim(&world, &lamp);
	find(&world, &usual);
	assert_nothing_listed(&world);
	assert_int_equal(edge_tile_winding(&world.grid.of[0]), 0);
	assert_true(world.grid.of[0].farthest == 0.0f);

	add_object(&world, &cube, unmoved, true);
	for (size_t i = 0; i < 2; i++)
		world.stage.scene->objects[i].receives = false;
	aim(&world, &lamp);
	find(&world, &usual);
	assert_nothing_listed(&world);
	assert_true(world.grid.edge_count > 0);
	assert_winding_counts_sheets(&world, "cube without receivers");
	finish(&world);
	model_finish(&floor);
	model_finish(&cube);
}

/* Whether one interval touches another. */
static bool overlap(float a, float b, float low, float high)
{
	return fmaxf(a, b) >= low && fminf(a, b) <= high;
}

/* The box around each edge of a tile's list touches the tile grown by a margin, tiles. */
static void assert_near_tile(const struct edge_grid *grid, uint32_t t, float margin)
{
	const struct chain_vertex *list = &grid->vertices[grid->of[t].first];
	float tiles = (float)grid->tiles;
	float left = (float)(t % grid->tiles) - margin, bottom = (float)(t / grid->tiles) - margin;
	for (uint32_t i = 1; i < edge_tile_count(&grid->of[t]); i++)
		assert_true(list[i].start != 0.0f ||
			    (overlap(list[i - 1].x * tiles, list[i].x * tiles, left,
				     left + 1.0f + 2.0f * margin) &&
				    overlap(list[i - 1].y * tiles, list[i].y * tiles, bottom,
					    bottom + 1.0f + 2.0f * margin)));
}

static void a_point_light_lists_edges_where_they_are(void **state)
{
	(void)state;
	struct world world;
	struct model floor = model_grid(2), sphere = model_sphere(3);
	struct sm_light_desc light = lamp;
	light.radius = 0.0f;
	init(&world);
	add_object(&world, &sphere, unmoved, true);
	add_object(&world, &floor, below, false);
	aim(&world, &light);
	find(&world, &usual);
	assert_grid(&world, "point light");
	/* A texel and a half around a tile is less than half a tile. */
	for (uint32_t t = 0; t < world.grid.tiles * world.grid.tiles; t++)
		assert_near_tile(&world.grid, t, 0.5f);
	finish(&world);
	model_finish(&floor);
	model_finish(&sphere);
}

/* What is too large, or too near, for float. */
static void everything_is_finite(void **state)
{
	(void)state;
	static const float sizes[] = {1e-30f, 1e-6f, 1e6f, 1e18f, 3e37f};
	static const float radii[] = {0.0f, 1e-20f, 1.0f, 1e9f, 1e30f};
	struct model cube = model_cube();
	for (size_t i = 0; i < 50; i++) {
		struct world world;
		struct sm_light_desc light = lamp;
		light.type = i % 2 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT;
		light.radius = radii[i / 10];
		float size = sizes[i / 2 % 5];
		const float transform[16] = {
			size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, 0, 0, 0, 1};
		init(&world);
		add_object(&world, &cube, transform, true);
		add_object(&world, &cube, below, true);
		aim(&world, &light);
		find(&world, &usual);
		assert_lists_are_in_order(&world, "large and small");
		for (uint32_t t = 0; t < world.grid.tiles * world.grid.tiles; t++)
			assert_true(world.grid.of[t].farthest >= 0.0f &&
				    world.grid.of[t].farthest <= 1.0f);
		assert_true(isfinite(world.grid.mean_list));
		finish(&world);
	}
	model_finish(&cube);
}

static void a_grid_serves_one_scene_after_the_other(void **state)
{
	(void)state;
	static const char *const sources[] = {
		"builtin:urchin:2000", "builtin:boxes", "builtin:debris:600", "builtin:knot"};
	struct edge_grid grid = {0};
	for (size_t i = 0; i < sizeof(sources) / sizeof(sources[0]); i++) {
		struct world world, fresh;
		load(&world, sources[i], NULL, 0);
		load(&fresh, sources[i], NULL, 0);
		world.grid = grid;
		find(&world, &usual);
		find(&fresh, &usual);
		assert_int_equal(world.grid.vertex_count, fresh.grid.vertex_count);
		assert_memory_equal(world.grid.vertices, fresh.grid.vertices,
			fresh.grid.vertex_count * sizeof(*fresh.grid.vertices));
		assert_memory_equal(world.grid.of, fresh.grid.of,
			sizeof(*fresh.grid.of) * fresh.grid.tiles * fresh.grid.tiles);
		assert_true(edge_grid_bytes(&world.grid) >= edge_grid_bytes(&fresh.grid));
		grid = world.grid;
		stage_finish(&world.stage);
		finish(&fresh);
	}
	edge_grid_finish(&grid);
	assert_int_equal(edge_grid_bytes(&grid), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(scenes_are_counted_and_listed),
		cmocka_unit_test(whatever_the_mesh_winding_numbers_count_its_sheets),
		cmocka_unit_test(a_light_inside_a_caster_sees_what_is_beyond_the_near_plane),
		cmocka_unit_test(fewer_tiles_and_then_fewer_edges_where_lists_grow_too_long),
		cmocka_unit_test(merged_edges_wind_around_each_texel_as_before),
		cmocka_unit_test(without_casters_or_receivers_nothing_is_listed),
		cmocka_unit_test(a_point_light_lists_edges_where_they_are),
		cmocka_unit_test(everything_is_finite),
		cmocka_unit_test(a_grid_serves_one_scene_after_the_other),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
