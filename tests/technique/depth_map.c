/* SPDX-License-Identifier: MIT */
/* A shadow map for each of many points of a light is kept where casters have not changed: what it
 * shows is what drawing all of them would. */
#include "technique/depth_map.h"
#include "parts.h"
#include "renderer.h"
#include "rig.h"
#include <GLES3/gl3.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define MAP 128
#define SIDE 4                /* casters along a side of the floor, a unit apart */
#define CASTERS (SIDE * SIDE) /* with a post instead of one of them */
#define LAYERS 16
#define STEPS 20
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Depths as colours beside the texture, which can be read back. */
static const char *const path = "depth=rgba8";

struct world {
	struct rig *rig;
	struct gpu *gpu;
	struct sm_light_desc light;
	struct disc disc;
	struct depth_map kept, anew;
};

static const struct sm_light_desc lamp = {
	.position = {1, 9, 2}, .radius = 1.5f, .angle = 40, .color = {1, 1, 1}, .intensity = 1};

static struct pose pose_of(uint32_t index, float x, float y)
{
	return (struct pose){.scale = {0.2f, 0.2f, 0.2f},
		.position = {(float)(index % SIDE) - 0.5f * (SIDE - 1) + x, y,
			(float)(index / SIDE) - 0.5f * (SIDE - 1)}};
}

static void add_floor(struct sm_scene *scene)
{
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {4, 1, 4}});
}

/* Casters at heights of 1 to 4, and a post at the near end of the light's depth range. */
static void add_crowd(struct sm_scene *scene)
{
	uint32_t cube = parts_add_cube(scene);
	for (uint32_t i = 0; i < CASTERS - 1; i++) {
		struct pose pose = pose_of(i, 0, 1 + (float)(i % 4));
		parts_add_object(scene, cube, PART_BOTH, &pose);
	}
	parts_add_object(scene, cube, PART_BOTH,
		&(struct pose){.scale = {0.05f, 3, 0.05f}, .position = {-3, 3, 0}});
	add_floor(scene);
}

/* One alone takes so little of the screen that the rest is known to be clear. */
static void add_lone(struct sm_scene *scene)
{
	struct pose pose = pose_of(5, 0, 4);
	parts_add_object(scene, parts_add_cube(scene), PART_BOTH, &pose);
	add_floor(scene);
}

/* What is in new storage may be anything. */
static void spoil(struct gl *gl, const struct depth_map *map, float value)
{
	const GLfloat color[4] = {value, value, value, value};
	glDisable(GL_SCISSOR_TEST);
	for (GLint i = 0; i < LAYERS; i++) {
		target_bind_layer(&map->plain, gl, i);
		glClearBufferfv(GL_COLOR, 0, color);
	}
}

static void world_init(struct world *world, struct rig *rig, void (*set_up)(struct sm_scene *scene))
{
	struct sm_error error;
	rig_use_path(rig, path);
	*world = (struct world){.rig = rig, .gpu = &rig->renderer->gpu, .light = lamp};
	set_up(rig->scene);
	disc_init(&world->disc, LAYERS);
	assert_true(gpu_scene_update(&world->gpu->scene, &world->gpu->gl, rig->scene,
		&world->gpu->stats.uploaded_bytes, &error));
	struct depth_map *maps[] = {&world->kept, &world->anew};
	for (size_t i = 0; i < COUNT(maps); i++) {
		if (!depth_map_init_layers(
			    maps[i], world->gpu, MAP, &world->disc, DEPTH_MAP_LINEAR, true, &error))
			fail_msg("%s", error.text);
		spoil(&world->gpu->gl, maps[i], 0.25f * (float)i);
	}
}

static void world_finish(struct world *world)
{
	depth_map_finish(&world->kept, world->gpu);
	depth_map_finish(&world->anew, world->gpu);
}

static void move(struct world *world, uint32_t caster, float x, float y)
{
	float transform[16];
	struct pose pose = pose_of(caster, x, y);
	pose_matrix(&pose, transform);
	assert_true(sm_scene_set_transform(world->rig->scene, caster, transform, NULL));
}

static void draw(struct world *world, struct depth_map *map)
{
	struct sm_error error;
	struct light_frame frame;
	light_frame_init(&frame, &world->light, world->rig->scene);
	if (!depth_map_draw(map, world->gpu, world->rig->scene, &frame, &error))
		fail_msg("%s", error.text);
}

static void read_layer(
	struct world *world, const struct depth_map *map, GLint layer, uint8_t texels[MAP][MAP][4])
{
	target_bind_layer(&map->plain, &world->gpu->gl, layer);
	glReadPixels(0, 0, MAP, MAP, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

static void check_layers(struct world *world, const char *name, int step)
{
	static uint8_t kept[MAP][MAP][4], anew[MAP][MAP][4];
	draw(world, &world->kept);
	depth_map_forget(&world->anew);
	draw(world, &world->anew);
	for (GLint i = 0; i < LAYERS; i++) {
		read_layer(world, &world->kept, i, kept);
		read_layer(world, &world->anew, i, anew);
		if (memcmp(kept, anew, sizeof(kept)) != 0)
			fail_msg("%s, step %d: layer %d is another", name, step, i);
	}
}

static void to_the_side(struct world *world, int step)
{
	move(world, (uint32_t)step % (CASTERS - 1), 0.03f * (float)(step % 7),
		1 + (float)(step % 4));
}

/* Seen from points of the rim, it goes much farther than from the middle. */
static void towards_the_light(struct world *world, int step)
{
	move(world, 5, 0, 0.2f * (float)(step % 20) + 0.5f);
}

static void away_from_the_floor(struct world *world, int step)
{
	move(world, 5, 0, step % 2 == 0 ? 1 : 90);
}

static void light_grows(struct world *world, int step)
{
	world->light.radius = step % 2 == 0 ? 0.2f : 1.8f;
}

static void light_moves(struct world *world, int step)
{
	world->light.position[0] = 0.3f * (float)step - 2;
}

static void nothing(struct world *world, int step)
{
	(void)world, (void)step;
}

static void layers_are_as_if_all_were_drawn(void **state)
{
	static const struct {
		const char *name;
		void (*change)(struct world *world, int step);
		void (*set_up)(struct sm_scene *scene);
		enum sm_light_type type;
	} cases[] = {
		{"casters move", to_the_side, add_crowd, SM_LIGHT_SPOT},
		{"casters move, sun", to_the_side, add_crowd, SM_LIGHT_DIRECTIONAL},
		{"one comes near", towards_the_light, add_crowd, SM_LIGHT_SPOT},
		{"one comes near, sun", towards_the_light, add_crowd, SM_LIGHT_DIRECTIONAL},
		{"one leaves the screen", away_from_the_floor, add_crowd, SM_LIGHT_SPOT},
		{"light grows", light_grows, add_lone, SM_LIGHT_SPOT},
		{"light grows, sun", light_grows, add_lone, SM_LIGHT_DIRECTIONAL},
		{"light moves", light_moves, add_lone, SM_LIGHT_SPOT},
		{"nothing", nothing, add_crowd, SM_LIGHT_SPOT},
	};
	struct rig *rig = *state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct world world;
		world_init(&world, rig, cases[i].set_up);
		world.light.type = cases[i].type;
		for (int step = 0; step < STEPS; step++) {
			cases[i].change(&world, step);
			check_layers(&world, cases[i].name, step);
		}
		world_finish(&world);
		sm_scene_destroy(rig->scene);
		rig->scene = sm_scene_create();
		assert_non_null(rig->scene);
	}
}

/* Casters that a draw draws, in all layers. */
static uint64_t count_drawn(struct world *world)
{
	const struct sm_skip_stats *stats = &world->gpu->skips.stats[SKIP_STATIC];
	uint64_t tested = stats->tested, skipped = stats->skipped;
	draw(world, &world->kept);
	tested = stats->tested - tested;
	skipped = stats->skipped - skipped;
	assert_true(tested == 0 || tested == (uint64_t)LAYERS * CASTERS);
	return tested - skipped;
}

static void casters_that_stay_are_not_drawn_again(void **state)
{
	struct rig *rig = *state;
	const uint64_t all = (uint64_t)LAYERS * CASTERS;
	struct world world;
	world_init(&world, rig, add_crowd);
	world.light.radius = 0.1f;
	assert_int_equal(count_drawn(&world), all);
	assert_int_equal(count_drawn(&world), 0);
	/* It, and what is right beside it on the screen. */
	move(&world, 0, -0.1f, 1);
	uint64_t some = count_drawn(&world);
	assert_true(some >= LAYERS && some < all / 4);
	/* What a frame that failed has left there is not known. */
	world.gpu->failures++;
	assert_int_equal(count_drawn(&world), all);
	depth_map_forget(&world.kept);
	assert_int_equal(count_drawn(&world), all);
	world_finish(&world);
}

static void without_the_skip_all_are_drawn(void **state)
{
	struct rig *rig = *state;
	struct world world;
	world_init(&world, rig, add_crowd);
	assert_true(sm_renderer_set_skips(rig->renderer, "-static,-caster", NULL));
	for (int i = 0; i < 2; i++) {
		uint64_t before = world.gpu->stats.draw_calls;
		draw(&world, &world.kept);
		assert_int_equal(world.gpu->stats.draw_calls - before, (uint64_t)LAYERS * CASTERS);
	}
	world_finish(&world);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(layers_are_as_if_all_were_drawn),
		rig_test(casters_that_stay_are_not_drawn_again),
		rig_test(without_the_skip_all_are_drawn),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
