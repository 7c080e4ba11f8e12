/* SPDX-License-Identifier: MIT */
/* What a renderer drew before makes no difference: not options, sizes, lights, places or shapes. */
#include "canvas.h"
#include "parts.h"
#include "platform.h"
#include "rig.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct sm_shadow_options options[] = {
	{.precision = SM_PRECISION_HALF, .map_size = 100},
	{.technique = "smoothie", .map_size = 64},
	{.precision = SM_PRECISION_FIXED12, .map_size = 33, .falloff = SM_FALLOFF_SINUSOID},
	{.technique = "vsm", .map_size = 128},
	{.precision = SM_PRECISION_HALF, .map_size = 128, .width = 0.1f},
	{.technique = "smoothie", .map_size = 200, .passes = 2, .falloff = SM_FALLOFF_SINUSOID},
	{.technique = "pcf", .map_size = 64, .samples = 16},
};

#define OPTIONS (sizeof(options) / sizeof(options[0]))

/* Width, height, light to show. */
static const uint32_t views[][3] = {
	{64, 48, SM_NONE},
	{33, 80, 1},
	{64, 48, 0},
	{90, 21, SM_NONE},
	{1, 1, SM_NONE},
};

#define VIEWS (sizeof(views) / sizeof(views[0]))

static uint8_t *draw(struct rig *rig, size_t step)
{
	const uint32_t *size = views[step % VIEWS];
	struct canvas canvas;
	canvas_init(&canvas, step % 2 ? GL_RGBA8 : GL_SRGB8_ALPHA8, size[0], size[1]);
	const struct sm_view view = {
		.camera = {.eye = {2 - (float)(step % 4), 3, 5}, .up = {0, 1, 0}, .fov = 45},
		.framebuffer = canvas.framebuffer,
		.width = size[0],
		.height = size[1],
		.visibility_of = size[2],
	};
	rig_draw(rig, rig->scene, &view);
	uint8_t *rgba = canvas_read(&canvas);
	canvas_finish(&canvas);
	return rgba;
}

/* The block, which is the first object, as it is in a step. */
static void move_block(struct sm_scene *scene, size_t step)
{
	float transform[16];
	pose_matrix(&(struct pose){.scale = {0.6f, 0.2f, 0.4f},
			    .turn = 40.0f * (float)step,
			    .position = {0.2f * (float)(step % 5), 1, 0}},
		transform);
	assert_true(sm_scene_set_transform(scene, 0, transform, NULL));
}

/* A wall, the third mesh, bent a bit more in each step. */
static const float wall[6][3] = {
	{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1.5f, 0}, {0, 1.5f, 0}, {1, 1.5f, 0}};

static void add_wall(struct sm_scene *scene)
{
	static const uint32_t indices[] = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
	uint32_t mesh = parts_add_mesh(scene, wall, 6, indices, 12);
	parts_add_object(
		scene, mesh, PART_BOTH, &(struct pose){.scale = {1, 1, 1}, .position = {0, 0, -1}});
}

static void bend_wall(struct sm_scene *scene, size_t step)
{
	float bent[6][3];
	memcpy(bent, wall, sizeof(bent));
	for (int i = 0; i < 6; i += 3) {
		bent[i][2] += .1f * (float)(step % 6);
		bent[i + 1][2] -= .15f * (float)(step % 4);
	}
	assert_true(sm_scene_set_vertices(scene, 2, bent[0], NULL, NULL));
}

static void set_up(struct sm_scene *scene)
{
	uint32_t cube = parts_add_cube(scene);
	parts_add_object(scene, cube, PART_BOTH, &(struct pose){.scale = {1, 1, 1}});
	parts_add_object(
		scene, parts_add_square(scene), PART_RECEIVES, &(struct pose){.scale = {3, 1, 3}});
	add_wall(scene);
	parts_add_light(
		scene, &(struct sm_light_desc){.position = {1, 5, 1}, .radius = 0.4f, .angle = 60});
	parts_add_light(scene,
		&(struct sm_light_desc){
			.type = SM_LIGHT_DIRECTIONAL, .position = {-2, 5, 2}, .radius = 0.3f});
}

static void what_was_before_makes_no_difference(void **state)
{
	struct rig *rig = *state;
	struct sm_renderer *kept = rig->renderer;
	set_up(rig->scene);
	for (size_t step = 0; step < 3 * OPTIONS * VIEWS; step++) {
		const struct sm_shadow_options *now = &options[step / 3 % OPTIONS];
		move_block(rig->scene, step);
		bend_wall(rig->scene, step);
		rig->renderer = kept;
		if (step % 3 == 0)
			rig_set_shadows(rig, now);
		uint8_t *drawn = draw(rig, step);
		rig->renderer = NULL;
		rig_use_driver(rig, &(struct sm_driver_options){0});
		rig_set_shadows(rig, now);
		uint8_t *alone = draw(rig, step);
		const uint32_t *size = views[step % VIEWS];
		if (memcmp(drawn, alone, (size_t)size[0] * size[1] * 4) != 0)
			fail_msg("step %zu differs", step);
		sm_renderer_destroy(rig->renderer);
		free(drawn);
		free(alone);
	}
	rig->renderer = kept;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(what_was_before_makes_no_difference),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
