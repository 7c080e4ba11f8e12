/* SPDX-License-Identifier: MIT */
/* What a grid keeps of objects that have not changed is what it would find. */
#include "edge_world.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIDE 5 /* objects along a side of the floor */
#define OBJECTS (SIDE * SIDE)
#define FRAMES 300
#define COARSE_BITS 4 /* of the raster grid, where edges are finer */
#define VERTICES_MAX 4000

static uint32_t state = 0x1234567;

/* xorshift (Marsaglia 2003). */
static uint32_t below(uint32_t end)
{
	state ^= state << 13;
	state ^= state >> 17;
	state ^= state << 5;
	return state % end;
}

static float between(float low, float high)
{
	return low + (high - low) * (float)below(1 << 20) / (float)(1 << 20);
}

/* At times as high as the light. */
static void random_transform(uint32_t index, float transform[16])
{
	float size = between(0.05f, 0.2f), turn = between(0, 6);
	const float placed[16] = {size * cosf(turn), 0, -size * sinf(turn), 0, 0, size, 0, 0,
		size * sinf(turn), 0, size * cosf(turn), 0,
		0.5f * (float)(index % SIDE) - 1 + between(-0.3f, 0.3f),
		between(-0.9f, below(8) == 0 ? 3.2f : 0.5f),
		0.5f * (float)(index / SIDE) - 1 + between(-0.3f, 0.3f), 1};
	memcpy(transform, placed, sizeof(placed));
}

/* Cubes and spheres that cast, or receive, or do both, above a floor that is not below all of
 * them. */
static void make_world(struct world *world, struct model models[2])
{
	static const float floor_at[16] = {
		.7f, 0, 0, 0, 0, .1f, 0, 0, 0, 0, .7f, 0, 0, -1.5f, 0, 1};
	uint32_t meshes[2], handle;
	world_init(world);
	for (int i = 0; i < 2; i++) {
		struct sm_mesh_desc desc = model_desc(&models[i], "part");
		assert_true(sm_scene_add_mesh(world->stage.scene, &desc, &meshes[i], NULL));
	}
	struct sm_object_desc object = {.image = SM_NONE, .mesh = meshes[0], .receives = true};
	memcpy(object.transform, floor_at, sizeof(floor_at));
	assert_true(sm_scene_add_object(world->stage.scene, &object, &handle, NULL));
	for (uint32_t i = 0; i < OBJECTS; i++) {
		object.mesh = meshes[i % 2];
		object.casts = i % 7 != 0;
		object.receives = i % 5 != 0;
		random_transform(i, object.transform);
		assert_true(sm_scene_add_object(world->stage.scene, &object, &handle, NULL));
	}
	world_aim(world, &world_lamp);
}

static void assert_same_grid(const struct edge_grid *kept, const struct edge_grid *fresh)
{
	size_t tiles = (size_t)fresh->tiles * fresh->tiles;
	assert_int_equal(kept->tiles, fresh->tiles);
	assert_memory_equal(kept->of, fresh->of, tiles * sizeof(*fresh->of));
	assert_int_equal(kept->whole, fresh->whole);
	assert_int_equal(kept->edge_count, fresh->edge_count);
	assert_int_equal(kept->texel_count, fresh->texel_count);
	assert_memory_equal(
		kept->texels, fresh->texels, fresh->texel_count * sizeof(*fresh->texels));
	assert_int_equal(kept->vertex_count, fresh->vertex_count);
	assert_memory_equal(
		kept->vertices, fresh->vertices, fresh->vertex_count * sizeof(*fresh->vertices));
	assert_int_equal(kept->run_count, fresh->run_count);
	assert_memory_equal(kept->runs, fresh->runs, fresh->run_count * sizeof(*fresh->runs));
	assert_int_equal(kept->chains.count, fresh->chains.count);
	assert_memory_equal(kept->chains.points, fresh->chains.points,
		fresh->chains.count * sizeof(*fresh->chains.points));
	assert_memory_equal(kept->depths.deepest, fresh->depths.deepest, tiles * sizeof(float));
	assert_memory_equal(kept->depths.farthest, fresh->depths.farthest, tiles * sizeof(float));
}

static void bend(struct world *world, const struct model *model)
{
	float positions[3 * VERTICES_MAX];
	struct sm_mesh_desc desc = model_desc(model, "part");
	assert_true(desc.vertex_count <= VERTICES_MAX);
	for (size_t i = 0; i < 3 * desc.vertex_count; i++)
		positions[i] = desc.positions[i] * between(0.7f, 1.2f);
	assert_true(sm_scene_set_vertices(world->stage.scene, 1, positions, NULL, NULL));
}

/* One of what happens between two frames. Object 0 is the floor. */
static void change(struct world *world, const struct model *bent, struct edge_grid_options *options)
{
	uint32_t what = below(20);
	float transform[16];
	for (uint32_t moved = what == 0 ? 3 : 1; moved-- > 0;) {
		uint32_t index = below(OBJECTS);
		random_transform(index, transform);
		assert_true(sm_scene_set_transform(world->stage.scene, 1 + index, transform, NULL));
	}
	if (what == 1)
		bend(world, bent);
	if (what == 2) {
		struct sm_light_desc light = world_lamp;
		light.position[0] += between(-0.1f, 0.1f);
		world_aim(world, &light);
	}
	if (what == 3)
		options->tiles = 32u << below(3);
	if (what == 4)
		edge_grid_forget(&world->grid);
	if (what == 5) {
		options->subpixel_bits =
			options->subpixel_bits == SUBPIXEL_BITS ? COARSE_BITS : SUBPIXEL_BITS;
		options->finer_bits = edge_finer_bits(options->subpixel_bits);
	}
}

/* tiles: for so many runs. */
static void check_moves(struct edge_grid_options options, size_t *kept)
{
	struct world world;
	struct model models[2] = {model_cube(), model_sphere(3)};
	make_world(&world, models);
	*kept = 0;
	for (uint32_t frame = 0; frame < FRAMES; frame++) {
		struct edge_grid fresh = {0};
		assert_true(edge_grid_find(&fresh, world.stage.scene, &world.frame, &options));
		assert_true(edge_grid_find_stretches(&fresh));
		world_find(&world, &options);
		assert_same_grid(&world.grid, &fresh);
		*kept += world.grid.keep.kept_count;
		assert_int_equal(fresh.keep.kept_count, 0);
		assert_true(screen_box_is_all(&fresh.keep.changed));
		edge_grid_finish(&fresh);
		change(&world, &models[1], &options);
	}
	model_finish(&models[0]);
	model_finish(&models[1]);
	world_finish(&world);
}

static void what_is_kept_is_what_would_be_found(void **unused)
{
	(void)unused;
	size_t kept;
	check_moves((struct edge_grid_options){128, MAP_SIZE, SUBPIXEL_BITS, ROOM}, &kept);
	assert_true(kept > FRAMES * OBJECTS / 2 && kept < FRAMES * OBJECTS);
}

/* Whose depths are those of fewer tiles at times. */
static void lists_that_do_not_fit_are_kept_too(void **unused)
{
	(void)unused;
	size_t kept;
	check_moves((struct edge_grid_options){128, MAP_SIZE, SUBPIXEL_BITS, {3000, 3000, 3000}},
		&kept);
	assert_true(kept > FRAMES * OBJECTS / 2);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_is_kept_is_what_would_be_found),
		cmocka_unit_test(lists_that_do_not_fit_are_kept_too),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
