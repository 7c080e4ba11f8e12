/* SPDX-License-Identifier: MIT */
/* Silhouettes listed by the tiles of a light's screen: against every sheet, every edge and a host
 * of receivers tried one by one, in doubles. */
#include "edge_world.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct edge_grid_options usual = {64, MAP_SIZE, SUBPIXEL_BITS, ROOM};

/* Column-major. */
static const float unmoved[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
static const float mirrored[16] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, .2f, 0, 0, 1};
static const float sheared[16] = {.8f, .1f, 0, 0, .3f, -1.2f, .2f, 0, .1f, 0, 1, 0, 0, .2f, 0, 1};
/* A wide floor below. */
static const float below[16] = {6, 0, 0, 0, 0, 0, -6, 0, 0, 6, 0, 0, -3, -1.5f, 3, 1};

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
		world_load(&world, rows[i].source, rows[i].settings, rows[i].setting_count);
		world_find(&world, &options);
		assert_int_equal(world.grid.tiles, rows[i].tiles);
		assert_true(world.grid.edge_count > 0);
		assert_grid(&world, rows[i].source);
		world_finish(&world);
	}
}

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
		struct sm_light_desc light = world_lamp;
		light.type = i % 2 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT;
		world_init(&world);
		world_add_object(&world, &rows[i / 6].model, transforms[i / 2 % 3], true);
		world_add_object(&world, &floor, below, false);
		world_aim(&world, &light);
		world_find(&world, &usual);
		assert_grid(&world, rows[i / 6].name);
		world_finish(&world);
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
		struct sm_light_desc light = world_lamp;
		light.position[0] = light.position[2] = 0.03f;
		light.position[1] = 0.02f;
		light.angle = 90;
		world_init(&world);
		world_add_object(&world, &rows[i / 3].model, transforms[i % 3], true);
		world_add_object(&world, &floor, below, false);
		world_aim(&world, &light);
		world_find(&world, &usual);
		assert_grid(&world, rows[i / 3].name);
		world_finish(&world);
	}
	model_finish(&floor);
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		model_finish((struct model *)&rows[i].model);
}

/* Of the edges in all lists: how many are not behind a depth, and how deep the nearest ends are. */
static size_t count_entries(const struct edge_grid *grid, float depth, float *deepest)
{
	size_t before = 0;
	*deepest = 0.0f;
	for (uint32_t t = 0; t < grid->tiles * grid->tiles; t++)
		for (uint32_t i = 0; i < edge_tile_stretches(grid, &grid->of[t]); i++) {
			struct edge_stretch stretch = edge_tile_stretch(grid, &grid->of[t], i);
			for (uint32_t k = 0; k < stretch.edges; k++) {
				const struct edge_vertex *edge = &stretch.vertices[k];
				float nearest = fminf(edge[0].depth, edge[1].depth);
				before += nearest <= depth;
				*deepest = fmaxf(*deepest, nearest);
			}
		}
	return before;
}

/* With too little room, the nearest edges are listed, and the others counted. */
static void assert_nearest_win(struct world *world, const struct edge_grid *all,
	const struct edge_grid_options *options, bool some)
{
	world_find(world, options);
	assert_int_equal(world->grid.tiles, 32);
	assert_true(world->grid.run_count <= options->room.runs);
	assert_true(world->grid.vertex_count <= options->room.vertices);
	assert_lists_are_in_order(world, "debris without room");
	assert_winding_counts_sheets(world, "debris without room");
	assert_true(world->grid.dropped > 0);
	float deepest, all_deepest;
	assert_int_equal(count_entries(&world->grid, 2.0f, &deepest) + world->grid.dropped,
		count_entries(all, 2.0f, &all_deepest));
	if (!some)
		return;
	/* No edge is missing that is nearer, by a thousandth of all depths. */
	assert_true(world->grid.run_count > options->room.runs / 2 ||
		    world->grid.vertex_count > options->room.vertices / 2);
	float kept = deepest - 1e-3f;
	assert_int_equal(count_entries(&world->grid, kept, &deepest),
		count_entries(all, kept, &all_deepest));
}

static void fewer_tiles_and_then_fewer_edges_where_lists_grow_too_long(void **state)
{
	(void)state;
	struct world world, all;
	struct edge_grid_options options = {128, MAP_SIZE, SUBPIXEL_BITS, ROOM};
	static const char *const wide[] = {"light.radius=0.6"};
	world_load(&world, "builtin:debris:600", wide, 1);
	world_load(&all, "builtin:debris:600", wide, 1);
	options.tiles = 32;
	options.room.copies = 0;
	world_find(&all, &options);
	assert_false(all.grid.whole);
	const struct edge_room enough = {all.grid.run_count, all.grid.vertex_count, 0};

	options.tiles = 128;
	options.room = enough;
	world_find(&world, &options);
	assert_int_equal(world.grid.tiles, 32);
	assert_grid(&world, "debris on 32 tiles");

	size_t parts[] = {2, 10, 100, 1000};
	for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); i++) {
		options.tiles = 32;
		options.room = (struct edge_room){enough.runs / parts[i], enough.vertices, 0};
		assert_nearest_win(&world, &all.grid, &options, parts[i] <= 10);
		options.room = (struct edge_room){enough.runs, enough.vertices / parts[i], 0};
		assert_nearest_win(&world, &all.grid, &options, parts[i] <= 10);
	}
	for (size_t few = 0; few < 4; few++) {
		options.room = (struct edge_room){few, enough.vertices, 0};
		assert_nearest_win(&world, &all.grid, &options, false);
		options.room = (struct edge_room){enough.runs, few, 0};
		assert_nearest_win(&world, &all.grid, &options, false);
	}
	world_finish(&world);
	world_finish(&all);
}

/* Short lists are whole if they fit, on fewer tiles if need be. */
static void short_lists_have_their_own_edges(void **state)
{
	(void)state;
	struct world world;
	struct edge_grid_options options = {128, MAP_SIZE, SUBPIXEL_BITS, ROOM};
	world_load(&world, "builtin:fence", NULL, 0);
	world_find(&world, &options);
	assert_true(world.grid.whole && world.grid.tiles == 128);
	assert_grid(&world, "fence, whole lists");
	options.room.copies = world.grid.texel_count;
	world_find(&world, &options);
	assert_true(world.grid.whole && world.grid.tiles == 128);
	options.room.copies--;
	world_find(&world, &options);
	assert_true(world.grid.whole && world.grid.tiles == 64);
	options.room.copies = 1;
	world_find(&world, &options);
	assert_true(!world.grid.whole && world.grid.tiles == 32);
	assert_grid(&world, "fence, runs");
	world_finish(&world);
}

/* Of the nearest step of the coarse grid. */
static int32_t coarse_step(int32_t at, uint32_t finer_bits)
{
	return (int32_t)floor(ldexp(at, -(int)finer_bits) + 0.5);
}

static void finer_edges_round_to_the_raster_grid(void **state)
{
	(void)state;
	struct world coarse, fine;
	struct edge_grid_options options = {128, MAP_SIZE, 4, ROOM, 0};
	world_load(&coarse, "builtin:urchin", NULL, 0);
	world_load(&fine, "builtin:urchin", NULL, 0);
	world_find(&coarse, &options);
	options.finer_bits = edge_finer_bits(4);
	world_find(&fine, &options);
	const struct edge_chains *a = &coarse.grid.chains, *b = &fine.grid.chains;
	size_t between = 0;
	assert_int_equal(a->count, b->count);
	for (size_t i = 0; i < a->count; i++) {
		assert_int_equal(a->points[i].x, coarse_step(b->points[i].x, options.finer_bits));
		assert_int_equal(a->points[i].y, coarse_step(b->points[i].y, options.finer_bits));
		between += b->points[i].x % 16 != 0;
	}
	assert_true(between > a->count / 2);
	assert_int_equal(edge_finer_bits(8), 0);
	world_finish(&coarse);
	world_finish(&fine);
}

static void assert_nothing_listed(const struct world *world)
{
	assert_int_equal(world->grid.vertex_count, 0);
	assert_int_equal(world->grid.run_count, 0);
	assert_true(world->grid.mean_list == 0.0f);
	for (uint32_t t = 0; t < world->grid.tiles * world->grid.tiles; t++)
		assert_true(edge_tile_count(&world->grid.of[t]) == 0 &&
			    world->grid.of[t].nearest == 2.0f);
}

/* The sides of a cylinder on a floor, some of which show the light's centre one side and a part of
 * its disc the other; those of a mesh of many triangles are left out. */
static void triangles_that_the_light_grazes_are_listed_beside_them(void **state)
{
	(void)state;
	static const struct {
		const char *source;
		bool any;
	} rows[] = {{"builtin:cylinder", true}, {"builtin:urchin:2000", false}};
	static const char *const wide[] = {"light.radius=0.5"};
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct world world;
		size_t grazing = 0, listed = 0;
		world_load(&world, rows[i].source, wide, 1);
		world_find(&world, &(struct edge_grid_options){.tiles = 64,
					   .map_size = MAP_SIZE,
					   .subpixel_bits = SUBPIXEL_BITS,
					   .room = ROOM});
		for (size_t k = 0; k < world.grid.chains.count; k++)
			grazing += chain_is_grazing(&world.grid.chains.points[k]);
		for (size_t k = 1; k < world.grid.vertex_count; k++)
			listed += world.grid.vertices[k].sheets == 0.0f;
		assert_int_equal(grazing % 3, 0);
		assert_int_equal(grazing > 0, rows[i].any);
		assert_int_equal(listed > 0, rows[i].any);
		world_finish(&world);
	}
}

/* Edges of a triangle lead from corner to corner. */
static void assert_triangle(const struct edge_texel edges[3])
{
	for (int k = 0; k < 3; k++)
		for (int axis = 0; axis < 2; axis++)
			assert_int_equal(edges[k].words[2 + axis] >> EDGE_DEPTH_BITS,
				edges[(k + 1) % 3].words[axis] >> EDGE_DEPTH_BITS);
}

/* Those between the spikes of an urchin, in whole lists and in runs; as many as there is room for,
 * and whole ones. */
static void triangles_over_hollows_are_listed_as_far_as_there_is_room(void **state)
{
	(void)state;
	static const char *const wide[] = {"light.radius=0.573"};
	struct edge_grid_options options = {64, MAP_SIZE, SUBPIXEL_BITS, ROOM};
	struct world world;
	world_load(&world, "builtin:urchin:20000", wide, 1);
	world_find(&world, &options);
	const struct edge_grid *grid = &world.grid;
	size_t all = grid->hollows.count, listed = 0;
	assert_in_range(all, 100, 1000);
	for (size_t t = 0; t < 64 * 64; t++) {
		const struct edge_tile *tile = &grid->of[t];
		const struct edge_texel *texels =
			&grid->texels[grid->hollow_base +
				      HOLLOW_TEXELS * (size_t)edge_tile_first_hollow(tile)];
		for (uint32_t i = 0; i < edge_tile_hollows(tile); i++)
			assert_triangle(&texels[3 * i]);
		listed += edge_tile_hollows(tile);
	}
	assert_int_equal(listed, all);
	assert_false(grid->whole);
	options.room.vertices = grid->vertex_count + HOLLOW_TEXELS * 10 + 3;
	world_find(&world, &options);
	assert_int_equal(grid->hollows.count, 10);
	assert_int_equal(grid->dropped, all - 10);
	assert_int_equal(grid->texel_count, grid->vertex_count + HOLLOW_TEXELS * 10);
	world_finish(&world);
	world_load(&world, "builtin:cylinder", wide, 1);
	world_find(&world, &options);
	assert_int_equal(world.grid.hollows.count, 0);
	world_finish(&world);
}

/* The spike is on top, and curves into the sphere: not all edges there are hollow enough. */
static struct model sphere_with_spike(float height)
{
	struct model model = model_sphere(5);
	for (size_t v = 0; v < model.vertex_count; v++) {
		float *at = model.positions[v];
		if (at[1] > 0.0f)
			at[1] += height * expf(-16.0f * (at[0] * at[0] + at[2] * at[2]));
	}
	return model;
}

/* A spike that grows, or goes, under a wide light: what stands over hollows is that of a mesh made
 * so. */
static void triangles_stand_over_hollows_of_where_the_mesh_is(void **state)
{
	(void)state;
	static const struct {
		float at_first, then;
		bool any;
	} rows[] = {{0.0f, 1.0f, true}, {1.0f, 0.0f, false}, {1.0f, 1.0f, true}};
	struct sm_light_desc light = world_lamp;
	const float above[3] = {0.01f, 4.0f, 0.0f};
	memcpy(light.position, above, sizeof(above));
	light.target[0] = 0.0f;
	light.radius = 0.8f;
	struct model between = sphere_with_spike(0.5f);
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct model at_first = sphere_with_spike(rows[i].at_first);
		struct model then = sphere_with_spike(rows[i].then);
		struct world moved, made;
		world_init(&moved);
		world_init(&made);
		world_add_object(&moved, &at_first, unmoved, true);
		world_add_object(&made, &then, unmoved, true);
		for (int k = 0; k < 2; k++)
			assert_true(sm_scene_set_vertices(moved.stage.scene, 0,
				(k == 0 ? &between : &then)->positions[0], NULL, NULL));
		world_aim(&moved, &light);
		world_aim(&made, &light);
		world_find(&moved, &usual);
		world_find(&made, &usual);
		assert_int_equal(moved.grid.chains.hollow_count, made.grid.chains.hollow_count);
		assert_int_equal(moved.grid.hollows.count, made.grid.hollows.count);
		assert_int_equal(made.grid.hollows.count > 0, rows[i].any);
		world_finish(&moved);
		world_finish(&made);
		model_finish(&at_first);
		model_finish(&then);
	}
	model_finish(&between);
}

static void without_casters_or_receivers_nothing_is_listed(void **state)
{
	(void)state;
	struct world world;
	struct model floor = model_grid(2), cube = model_cube();
	world_init(&world);
	world_aim(&world, &world_lamp);
	world_find(&world, &usual);
	assert_nothing_listed(&world);
	world_add_object(&world, &floor, below, false);
	world_aim(&world, &world_lamp);
	world_find(&world, &usual);
	assert_nothing_listed(&world);
	assert_int_equal(edge_tile_winding(&world.grid.of[0]), 0);
	assert_true(world.grid.of[0].farthest == 0.0f);

	world_add_object(&world, &cube, unmoved, true);
	for (size_t i = 0; i < 2; i++)
		world.stage.scene->objects[i].receives = false;
	world_aim(&world, &world_lamp);
	world_find(&world, &usual);
	assert_nothing_listed(&world);
	assert_true(world.grid.edge_count > 0);
	assert_winding_counts_sheets(&world, "cube without receivers");
	world_finish(&world);
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
	float tiles = (float)grid->tiles, side = 1.0f + 2.0f * margin;
	float left = (float)(t % grid->tiles) - margin, bottom = (float)(t / grid->tiles) - margin;
	for (uint32_t i = 0; i < edge_tile_stretches(grid, &grid->of[t]); i++) {
		struct edge_stretch stretch = edge_tile_stretch(grid, &grid->of[t], i);
		for (uint32_t k = 0; k < stretch.edges; k++) {
			const struct edge_vertex *edge = &stretch.vertices[k];
			assert_true(
				overlap(edge[0].x * tiles, edge[1].x * tiles, left, left + side) &&
				overlap(edge[0].y * tiles, edge[1].y * tiles, bottom,
					bottom + side));
		}
	}
}

static void a_point_light_lists_edges_where_they_are(void **state)
{
	(void)state;
	struct world world;
	struct model floor = model_grid(2), sphere = model_sphere(3);
	struct sm_light_desc light = world_lamp;
	light.radius = 0.0f;
	world_init(&world);
	world_add_object(&world, &sphere, unmoved, true);
	world_add_object(&world, &floor, below, false);
	world_aim(&world, &light);
	world_find(&world, &usual);
	assert_grid(&world, "point light");
	/* A texel and a half around a tile is less than half a tile. */
	for (uint32_t t = 0; t < world.grid.tiles * world.grid.tiles; t++)
		assert_near_tile(&world.grid, t, 0.5f);
	world_finish(&world);
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
		struct sm_light_desc light = world_lamp;
		light.type = i % 2 ? SM_LIGHT_DIRECTIONAL : SM_LIGHT_SPOT;
		light.radius = radii[i / 10];
		float size = sizes[i / 2 % 5];
		const float transform[16] = {
			size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, 0, 0, 0, 1};
		world_init(&world);
		world_add_object(&world, &cube, transform, true);
		world_add_object(&world, &cube, below, true);
		world_aim(&world, &light);
		world_find(&world, &usual);
		assert_lists_are_in_order(&world, "large and small");
		for (uint32_t t = 0; t < world.grid.tiles * world.grid.tiles; t++)
			assert_true(world.grid.of[t].farthest >= 0.0f &&
				    world.grid.of[t].farthest <= 1.0f);
		assert_true(isfinite(world.grid.mean_list));
		world_finish(&world);
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
		world_load(&world, sources[i], NULL, 0);
		world_load(&fresh, sources[i], NULL, 0);
		world.grid = grid;
		world_find(&world, &usual);
		world_find(&fresh, &usual);
		assert_int_equal(world.grid.texel_count, fresh.grid.texel_count);
		assert_memory_equal(world.grid.texels, fresh.grid.texels,
			fresh.grid.texel_count * sizeof(*fresh.grid.texels));
		assert_int_equal(world.grid.vertex_count, fresh.grid.vertex_count);
		assert_memory_equal(world.grid.vertices, fresh.grid.vertices,
			fresh.grid.vertex_count * sizeof(*fresh.grid.vertices));
		assert_int_equal(world.grid.run_count, fresh.grid.run_count);
		assert_memory_equal(world.grid.runs, fresh.grid.runs,
			fresh.grid.run_count * sizeof(*fresh.grid.runs));
		assert_memory_equal(world.grid.of, fresh.grid.of,
			sizeof(*fresh.grid.of) * fresh.grid.tiles * fresh.grid.tiles);
		assert_true(edge_grid_bytes(&world.grid) >= edge_grid_bytes(&fresh.grid));
		grid = world.grid;
		stage_finish(&world.stage);
		world_finish(&fresh);
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
		cmocka_unit_test(short_lists_have_their_own_edges),
		cmocka_unit_test(finer_edges_round_to_the_raster_grid),
		cmocka_unit_test(triangles_that_the_light_grazes_are_listed_beside_them),
		cmocka_unit_test(triangles_over_hollows_are_listed_as_far_as_there_is_room),
		cmocka_unit_test(triangles_stand_over_hollows_of_where_the_mesh_is),
		cmocka_unit_test(without_casters_or_receivers_nothing_is_listed),
		cmocka_unit_test(a_point_light_lists_edges_where_they_are),
		cmocka_unit_test(everything_is_finite),
		cmocka_unit_test(a_grid_serves_one_scene_after_the_other),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
