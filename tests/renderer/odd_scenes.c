/* SPDX-License-Identifier: MIT */
/* Scenes that no one means to make: they draw without a GL error, and show valid values. */
#include "canvas.h"
#include "parts.h"
#include "visibility.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define SIZE 48

static const struct sm_camera near_by = {
	.eye = {-3, 4, 5}, .target = {0, 0.5f, 0}, .up = {0, 1, 0}, .fov = 40};

static const struct sm_light_desc lamp = {
	.type = SM_LIGHT_SPOT,
	.position = {1, 4, 1},
	.radius = 0.3f,
	.angle = 70,
};

static const struct pose floor_pose = {.scale = {3, 1, 3}};
static const struct pose block_pose = {.scale = {0.5f, 0.5f, 0.5f}, .position = {0, 1, 0}};

static void draw_picture(struct rig *rig, const struct sm_camera *camera, GLenum format)
{
	struct canvas canvas;
	canvas_init(&canvas, format, SIZE, SIZE);
	struct sm_view view = {.camera = *camera,
		.framebuffer = canvas.framebuffer,
		.width = SIZE,
		.height = SIZE,
		.visibility_of = SM_NONE};
	rig_draw(rig, rig->scene, &view);
	canvas_finish(&canvas);
}

/* Each technique; visibility_draw() judges the values, the rig what the driver says. */
static void draw_all_ways(struct rig *rig, const struct sm_camera *camera)
{
	static const struct sm_shadow_options ways[] = {
		{.technique = "hard"},
		{.technique = "smoothie"},
		{.technique = "smoothie", .width = 0.1f, .falloff = SM_FALLOFF_SINUSOID},
		{.technique = "smoothie", .passes = 2},
		{.technique = "smoothie-two-sided"},
		{.technique = "penumbra-map"},
		{.technique = "gather", .sampling = SM_SAMPLING_DENSE},
		{.technique = "gather", .sampling = SM_SAMPLING_DEFERRED},
		{.technique = "gather", .sampling = SM_SAMPLING_DEFERRED_SPARSE},
		{.technique = "auto", .sampling = SM_SAMPLING_SPARSE},
		{.technique = "pcf", .samples = 16},
		{.technique = "pcss", .samples = 32},
		{.technique = "vsm"},
		{.technique = "maps", .samples = 4},
		{.precision = SM_PRECISION_HALF, .falloff = SM_FALLOFF_SINUSOID},
		{.precision = SM_PRECISION_FIXED12, .width = 0.1f},
	};
	for (size_t i = 0; i < sizeof(ways) / sizeof(ways[0]); i++) {
		struct visibility seen;
		struct sm_shadow_options options = ways[i];
		if (!rig_can_draw(options.technique))
			continue;
		options.map_size = 128;
		rig_set_shadows(rig, &options);
		visibility_draw(&seen, rig, rig->scene, camera, SIZE, SIZE);
		visibility_finish(&seen);
		draw_picture(rig, camera, GL_SRGB8_ALPHA8);
	}
}

static void add_block(struct rig *rig, const struct pose *pose)
{
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH, pose);
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_BOTH, &floor_pose);
}

static void flattened_objects(void **state)
{
	struct rig *rig = *state;
	static const struct pose flat[] = {
		{.scale = {1, 0, 1}, .position = {0, 1, 0}},
		{.scale = {0, 0, 1}, .position = {0, 1, 0}},
		{.scale = {0, 0, 0}, .position = {0, 1, 0}},
		{.scale = {1, 1e-30f, 1}, .position = {0, 1, 0}},
	};
	parts_add_light(rig->scene, &lamp);
	for (size_t i = 0; i < sizeof(flat) / sizeof(flat[0]); i++) {
		add_block(rig, &flat[i]);
		draw_all_ways(rig, &near_by);
	}
}

static void lights_in_odd_places(void **state)
{
	struct rig *rig = *state;
	static const struct sm_light_desc lights[] = {
		/* Inside the block; in its face; in a corner; in the floor's plane; under it. */
		{.position = {0, 1, 0}, .target = {0, 0, 0}, .radius = 0.2f, .angle = 90},
		{.position = {0, 1.5f, 0}, .target = {0, 0, 0}, .radius = 0.2f, .angle = 90},
		{.position = {0.5f, 1.5f, 0.5f}, .target = {0, 0, 0}, .radius = 1, .angle = 60},
		{.position = {6, 0, 0}, .target = {0, 0, 0}, .radius = 0.2f, .angle = 60},
		{.position = {0, -3, 0}, .target = {0, 0, 0}, .radius = 0.2f, .angle = 60},
		/* Away from all; so near to the block that it crosses the near plane; wide. */
		{.position = {0, 3, 0}, .target = {0, 9, 0}, .radius = 0.2f, .angle = 60},
		{.position = {0.5005f, 1, 0}, .target = {-3, 0, 0}, .radius = 0.2f, .angle = 120},
		{.position = {0.3f, 3, 0}, .target = {0, 0, 0}, .radius = 50, .angle = 170},
		{.position = {0.3f, 3, 0}, .target = {0, 0, 0}, .angle = 1e-3f},
		{.position = {0, 4, 0}, .target = {0, 3, 0}, .type = SM_LIGHT_DIRECTIONAL},
		{.position = {5, 0, 0},
			.target = {0, 0, 0},
			.radius = 2,
			.type = SM_LIGHT_DIRECTIONAL},
		{.position = {1e-6f, 1, 0},
			.target = {0, 1, 0},
			.radius = 1,
			.type = SM_LIGHT_DIRECTIONAL},
	};
	add_block(rig, &block_pose);
	parts_add_light(rig->scene, &lamp);
	for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++) {
		struct sm_light_desc odd = lights[i];
		odd.intensity = odd.color[0] = odd.color[1] = odd.color[2] = 1;
		assert_true(sm_scene_set_light(rig->scene, 0, &odd, NULL));
		draw_all_ways(rig, &near_by);
	}
}

static void a_blocker_on_either_side_of_the_light(void **state)
{
	struct rig *rig = *state;
	add_block(rig, &(struct pose){.scale = {0.2f, 6, 0.2f}, .position = {0.9f, 3, 0.9f}});
	parts_add_light(rig->scene, &lamp);
	draw_all_ways(rig, &near_by);
}

static void a_camera_inside_an_object(void **state)
{
	struct rig *rig = *state;
	struct sm_camera inside = near_by;
	inside.eye[0] = inside.eye[2] = 0.1f;
	inside.eye[1] = 1;
	add_block(rig, &block_pose);
	parts_add_light(rig->scene, &lamp);
	draw_all_ways(rig, &inside);
}

static void add_moved_scene(struct sm_scene *scene, const float offset[3], struct sm_camera *camera)
{
	struct pose block = block_pose, ground = floor_pose;
	struct sm_light_desc light = lamp;
	*camera = near_by;
	for (int i = 0; i < 3; i++) {
		block.position[i] += offset[i];
		ground.position[i] += offset[i];
		camera->eye[i] += offset[i];
		camera->target[i] += offset[i];
		light.position[i] += offset[i];
		light.target[i] += offset[i];
	}
	parts_add_object(scene, parts_add_cube(scene), PART_BOTH, &block);
	parts_add_object(scene, parts_add_square(scene), PART_RECEIVES, &ground);
	parts_add_light(scene, &light);
}

/* Floats still hold these places exactly: 10^6 has steps of 1/16. */
static void scenes_far_from_the_origin_look_as_they_do_there(void **state)
{
	struct rig *rig = *state;
	struct sm_scene *far_away = sm_scene_create();
	struct sm_camera camera, far_camera;
	struct visibility near_picture, far_picture;
	assert_non_null(far_away);
	add_moved_scene(rig->scene, (float[]){0, 0, 0}, &camera);
	add_moved_scene(far_away, (float[]){1e6f, -1e6f, 1e6f}, &far_camera);
	rig_set_shadows(rig, &(struct sm_shadow_options){.map_size = 128});
	visibility_draw(&near_picture, rig, rig->scene, &camera, SIZE, SIZE);
	visibility_draw(&far_picture, rig, far_away, &far_camera, SIZE, SIZE);
	assert_true(visibility_compare(&near_picture, &far_picture).mean < 1e-4);
	visibility_finish(&near_picture);
	visibility_finish(&far_picture);
	sm_scene_destroy(far_away);
}

/* The far plane, and so the depth range, is a billion times as far as the block. */
static void tiny_and_huge_objects_together(void **state)
{
	struct rig *rig = *state;
	uint32_t cube = parts_add_cube(rig->scene);
	add_block(rig, &block_pose);
	parts_add_object(rig->scene, cube, PART_BOTH,
		&(struct pose){.scale = {1e9f, 1, 1e9f}, .position = {0, -1e9f, 0}});
	parts_add_object(rig->scene, cube, PART_BOTH,
		&(struct pose){.scale = {1e-9f, 1e-9f, 1e-9f}, .position = {0, 2, 0}});
	parts_add_light(rig->scene, &lamp);
	draw_all_ways(rig, &near_by);
}

static void colors_and_intensities_without_bound(void **state)
{
	struct rig *rig = *state;
	struct sm_light_desc blinding = lamp;
	struct sm_environment environment = {.sky = {1e30f, -1, 0}, .background = {1e30f, -1, 2}};
	blinding.intensity = blinding.color[0] = 1e30f;
	sm_scene_set_environment(rig->scene, &environment);
	add_block(rig, &block_pose);
	for (int i = 0; i < 2; i++) {
		parts_add_light(rig->scene, &blinding);
		draw_all_ways(rig, &near_by);
		draw_picture(rig, &near_by, GL_RGBA8);
	}
}

static void triangles_without_area(void **state)
{
	struct rig *rig = *state;
	static const float positions[][3] = {{0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 1, 0}};
	static const uint32_t indices[] = {0, 1, 2, 0, 3, 0, 2, 1, 0};
	parts_add_object(rig->scene, parts_add_mesh(rig->scene, positions, 4, indices, 9),
		PART_BOTH, &(struct pose){.scale = {1, 1, 1}});
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_RECEIVES, &floor_pose);
	parts_add_light(rig->scene, &lamp);
	draw_all_ways(rig, &near_by);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(flattened_objects),
		rig_test(lights_in_odd_places),
		rig_test(a_blocker_on_either_side_of_the_light),
		rig_test(a_camera_inside_an_object),
		rig_test(scenes_far_from_the_origin_look_as_they_do_there),
		rig_test(tiny_and_huge_objects_together),
		rig_test(colors_and_intensities_without_bound),
		rig_test(triangles_without_area),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
