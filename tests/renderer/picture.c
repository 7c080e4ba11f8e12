/* SPDX-License-Identifier: MIT */
/* What colour surfaces, lights, images and the background have in the picture. */
#include "canvas.h"
#include "parts.h"
#include "rig.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 64

static const GLenum formats[] = {GL_SRGB8_ALPHA8, GL_RGBA8};
static const struct pose floor_pose = {.scale = {3, 3, 3}};
static const struct pose block_pose = {.scale = {0.4f, 0.4f, 0.4f}, .position = {0.3f, 1, 0}};

/* Straight down: right is +x, down is +z. */
static const struct sm_camera overhead = {
	.eye = {0, 5, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .fov = 40};

static const struct sm_light_desc lamp = {
	.type = SM_LIGHT_SPOT,
	.position = {0, 4, 0},
	.radius = 0.1f,
	.angle = 60,
	.color = {1, 1, 1},
	.intensity = 1,
};

/* IEC 61966-2-1 */
static double decode(int byte)
{
	double e = byte / 255.0;
	return e <= 0.04045 ? e / 12.92 : pow((e + 0.055) / 1.055, 2.4);
}

static int encode(double c)
{
	double e = c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
	return (int)lround(255 * fmin(e, 1));
}

/* [SIZE][SIZE][4], rows from the top; the caller's to free() */
static uint8_t *draw(struct rig *rig, const struct sm_camera *camera, GLenum format)
{
	struct canvas canvas;
	canvas_init(&canvas, format, SIZE, SIZE);
	struct sm_view view = {.camera = *camera,
		.framebuffer = canvas.framebuffer,
		.width = SIZE,
		.height = SIZE,
		.visibility_of = SM_NONE};
	rig_draw(rig, rig->scene, &view);
	uint8_t *rgba = canvas_read(&canvas);
	canvas_finish(&canvas);
	return rgba;
}

/* Linear colour, to a step of the 8 bits. */
static void assert_color(const uint8_t *rgba, int x, int y, const double linear[3])
{
	const uint8_t *pixel = rgba + 4 * (y * SIZE + x);
	for (int i = 0; i < 3; i++)
		assert_in_range(pixel[i] + 1, encode(linear[i]), encode(linear[i]) + 2);
	assert_int_equal(pixel[3], 255);
}

static void assert_center(struct rig *rig, const struct sm_camera *camera, const double linear[3])
{
	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
		uint8_t *rgba = draw(rig, camera, formats[i]);
		assert_color(rgba, SIZE / 2, SIZE / 2, linear);
		free(rgba);
	}
}

static void add_floor(struct rig *rig)
{
	parts_add_object(rig->scene, parts_add_square(rig->scene), PART_BOTH, &floor_pose);
}

static void an_empty_scene_is_its_background(void **state)
{
	struct rig *rig = *state;
	struct sm_environment environment = {.background = {0.5f, 0.2f, 0.001f}};
	sm_scene_set_environment(rig->scene, &environment);
	assert_center(rig, &overhead, (const double[]){0.5, 0.2, 0.001});
}

static void intensity_one_shows_a_facing_white_surface_as_white(void **state)
{
	struct rig *rig = *state;
	add_floor(rig);
	uint32_t light = parts_add_light(rig->scene, &lamp);
	assert_center(rig, &overhead, (const double[]){1, 1, 1});
	static const struct {
		float intensity, color[3], height;
		double seen[3];
	} cases[] = {
		{0.5f, {1, 1, 1}, 4, {0.5, 0.5, 0.5}}, {0.5f, {0.8f, 0.4f, 0}, 4, {0.4, 0.2, 0}},
		{0.25f, {1, 1, 1}, 2,
			{0.25, 0.25, 0.25}}, /* at its target, whatever the distance */
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_light_desc changed = lamp;
		changed.intensity = cases[i].intensity;
		changed.position[1] = cases[i].height;
		memcpy(changed.color, cases[i].color, sizeof(changed.color));
		assert_true(sm_scene_set_light(rig->scene, light, &changed, NULL));
		assert_center(rig, &overhead, cases[i].seen);
	}
}

static void spots_fall_off_with_the_distance_squared_and_directional_lights_do_not(void **state)
{
	struct rig *rig = *state;
	add_floor(rig);
	struct sm_light_desc far_lamp = lamp;
	far_lamp.target[1] = 2; /* two units from the light, four from the floor */
	uint32_t light = parts_add_light(rig->scene, &far_lamp);
	assert_center(rig, &overhead, (const double[]){0.25, 0.25, 0.25});
	far_lamp.type = SM_LIGHT_DIRECTIONAL;
	far_lamp.intensity = 0.5f;
	assert_true(sm_scene_set_light(rig->scene, light, &far_lamp, NULL));
	assert_center(rig, &overhead, (const double[]){0.5, 0.5, 0.5});
}

static void a_slanted_light_gives_the_cosine(void **state)
{
	struct rig *rig = *state;
	add_floor(rig);
	struct sm_light_desc slanted = lamp;
	slanted.position[0] = 4 * sqrtf(3); /* 60 degrees from the normal */
	parts_add_light(rig->scene, &slanted);
	assert_center(rig, &overhead, (const double[]){0.5, 0.5, 0.5});
}

static void light_from_behind_the_seen_side_is_none(void **state)
{
	struct rig *rig = *state;
	parts_add_object(rig->scene, parts_add_square(rig->scene), 0, &floor_pose);
	struct sm_light_desc below = lamp;
	below.position[1] = -4;
	parts_add_light(rig->scene, &below);
	struct sm_camera beneath = overhead;
	beneath.eye[1] = -5;
	assert_center(rig, &overhead, (const double[]){0, 0, 0});
	assert_center(rig, &beneath, (const double[]){1, 1, 1});
}

static void the_back_of_what_is_single_sided_is_not_seen(void **state)
{
	struct rig *rig = *state;
	struct sm_environment environment = {
		.sky = {0.5f, 0.5f, 0.5f}, .background = {0.2f, 0.1f, 0.05f}};
	sm_scene_set_environment(rig->scene, &environment);
	struct sm_object_desc floor = {
		.mesh = parts_add_square(rig->scene),
		.transform = {9, 0, 0, 0, 0, 1, 0, 0, 0, 0, 9, 0, 0, 0, 0, 1},
		.base_color = {1, 1, 1, 1},
		.image = SM_NONE,
		.single_sided = true,
	};
	uint32_t object;
	assert_true(sm_scene_add_object(rig->scene, &floor, &object, NULL));
	struct sm_camera below = overhead;
	below.eye[1] = -5;
	assert_center(rig, &overhead, (const double[]){0.5, 0.5, 0.5});
	assert_center(rig, &below, (const double[]){0.2, 0.1, 0.05});
	/* Turned over by a mirroring transform, it is still its own front. */
	static const float mirrored[16] = {-9, 0, 0, 0, 0, 1, 0, 0, 0, 0, 9, 0, 0, 0, 0, 1};
	assert_true(sm_scene_set_transform(rig->scene, object, mirrored, NULL));
	assert_center(rig, &overhead, (const double[]){0.5, 0.5, 0.5});
	assert_center(rig, &below, (const double[]){0.2, 0.1, 0.05});
}

/* Along a line from the axis of a spot to its cone, 0.705 units on the floor; the picture shows
 * 1.82 to either side. */
static void a_spot_fades_towards_its_cone_and_ends_there(void **state)
{
	struct rig *rig = *state;
	static const int cone = (int)(SIZE / 2 * 0.705 / 1.82);
	static const struct {
		float softness;
		double middle; /* share of the light halfway to the cone */
	} cases[] = {{0, 1}, {0.5f, 1}, {1, 0.84}};
	add_floor(rig);
	struct sm_light_desc narrow = lamp;
	narrow.angle = 20;
	uint32_t light = parts_add_light(rig->scene, &narrow);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		narrow.softness = cases[i].softness;
		assert_true(sm_scene_set_light(rig->scene, light, &narrow, NULL));
		uint8_t *rgba = draw(rig, &overhead, GL_RGBA8);
		const uint8_t *row = rgba + 4 * (SIZE / 2 * SIZE + SIZE / 2);
		assert_int_equal(row[4 * (cone + 2)], 0);
		assert_true(fabs(decode(row[4 * (cone / 2)]) - cases[i].middle) < 0.05);
		assert_int_equal(decode(row[4 * (cone - 2)]) > 0.9, cases[i].softness == 0);
		free(rgba);
	}
}

static void ambient_light_comes_from_above_and_below(void **state)
{
	struct rig *rig = *state;
	struct sm_environment environment = {
		.sky = {0.5f, 0.3f, 0.1f},
		.ground = {0.1f, 0.2f, 0.4f},
	};
	sm_scene_set_environment(rig->scene, &environment);
	add_floor(rig);
	struct sm_camera below = overhead;
	below.eye[1] = -5;
	assert_center(rig, &overhead, (const double[]){0.5, 0.3, 0.1});
	assert_center(rig, &below, (const double[]){0.1, 0.2, 0.4});
}

static void an_image_multiplies_the_base_color_with_its_first_row_at_v_zero(void **state)
{
	struct rig *rig = *state;
	static const uint8_t quarters[2][2][4] = {
		{{255, 0, 0, 255}, {0, 255, 0, 255}},
		{{0, 0, 255, 255}, {255, 255, 255, 0}},
	};
	/* Two texels a side for each quarter, so that its middle is not blended. */
	uint8_t texels[4][4][4];
	for (int y = 0; y < 4; y++)
		for (int x = 0; x < 4; x++)
			memcpy(texels[y][x], quarters[y / 2][x / 2], 4);
	struct sm_environment environment = {.sky = {1, 1, 1}};
	sm_scene_set_environment(rig->scene, &environment);
	struct sm_object_desc desc = {
		.mesh = parts_add_square(rig->scene), .base_color = {0.5f, 0.5f, 0.5f, 1}};
	pose_matrix(&(struct pose){.scale = {1.82f, 1, 1.82f}}, desc.transform);
	uint32_t object;
	assert_true(sm_scene_add_image(rig->scene, 4, 4, texels[0][0], &desc.image, NULL));
	assert_true(sm_scene_add_object(rig->scene, &desc, &object, NULL));
	uint8_t *rgba = draw(rig, &overhead, GL_RGBA8);
	/* The square fills the picture; u runs right, v down. */
	int first = SIZE / 4, second = 3 * SIZE / 4;
	assert_color(rgba, first, first, (const double[]){0.5, 0, 0});
	assert_color(rgba, second, first, (const double[]){0, 0.5, 0});
	assert_color(rgba, first, second, (const double[]){0, 0, 0.5});
	assert_color(rgba, second, second, (const double[]){0.5, 0.5, 0.5});
	free(rgba);
}

static struct sm_light_desc side_lamp(uint32_t index, float intensity)
{
	struct sm_light_desc side = lamp;
	side.position[0] = index == 0 ? -2 : 3;
	side.color[index] = 0.2f;
	side.intensity = intensity;
	return side;
}

/* Two lights from two sides over floor and block, with ambient light. */
static void set_up_two_lights(struct rig *rig, const float intensities[2])
{
	struct sm_environment environment = {
		.sky = {0.005f, 0.005f, 0.01f},
		.ground = {0.002f, 0.002f, 0.002f},
		.background = {0.1f, 0.2f, 0.3f},
	};
	sm_scene_set_environment(rig->scene, &environment);
	add_floor(rig);
	parts_add_object(rig->scene, parts_add_cube(rig->scene), PART_BOTH, &block_pose);
	for (uint32_t i = 0; i < 2; i++) {
		struct sm_light_desc side = side_lamp(i, intensities[i]);
		parts_add_light(rig->scene, &side);
	}
}

static void set_intensities(struct rig *rig, const float intensities[2])
{
	for (uint32_t i = 0; i < 2; i++) {
		struct sm_light_desc side = side_lamp(i, intensities[i]);
		assert_true(sm_scene_set_light(rig->scene, i, &side, NULL));
	}
}

static void lights_look_the_same_whether_or_not_the_framebuffer_is_srgb(void **state)
{
	struct rig *rig = *state;
	/* Dark, where steps of linear light would be coarse. */
	set_up_two_lights(rig, (const float[]){0.01f, 0.02f});
	uint8_t *srgb = draw(rig, &overhead, GL_SRGB8_ALPHA8);
	uint8_t *plain = draw(rig, &overhead, GL_RGBA8);
	for (size_t i = 0; i < SIZE * SIZE * 4; i++)
		assert_in_range(plain[i] + 2, srgb[i], srgb[i] + 4);
	free(srgb);
	free(plain);
}

static void nothing_is_left_of_the_frame_before(void **state)
{
	struct rig *rig = *state;
	set_up_two_lights(rig, (const float[]){0.3f, 0.4f});
	for (size_t f = 0; f < sizeof(formats) / sizeof(formats[0]); f++) {
		struct canvas canvas;
		canvas_init(&canvas, formats[f], SIZE, SIZE);
		struct sm_view view = {.camera = overhead,
			.framebuffer = canvas.framebuffer,
			.width = SIZE,
			.height = SIZE,
			.visibility_of = SM_NONE};
		rig_draw(rig, rig->scene, &view);
		uint8_t *first = canvas_read(&canvas);
		rig_draw(rig, rig->scene, &view);
		uint8_t *second = canvas_read(&canvas);
		assert_memory_equal(first, second, SIZE * SIZE * 4);
		free(first);
		free(second);
		canvas_finish(&canvas);
	}
}

static void lights_add_up_in_linear_light(void **state)
{
	struct rig *rig = *state;
	static const float intensities[4][2] = {{0.3f, 0.4f}, {0.3f, 0}, {0, 0.4f}, {0, 0}};
	set_up_two_lights(rig, intensities[0]);
	for (size_t f = 0; f < sizeof(formats) / sizeof(formats[0]); f++) {
		uint8_t *seen[4];
		for (int i = 0; i < 4; i++) {
			set_intensities(rig, intensities[i]);
			seen[i] = draw(rig, &overhead, formats[f]);
		}
		/* However many lights there are, ambient light is there once. */
		assert_color(seen[3], SIZE / 2, SIZE / 2, (const double[]){0.005, 0.005, 0.01});
		for (size_t i = 0; i < SIZE * SIZE * 4; i++) {
			double sum = decode(seen[1][i]) + decode(seen[2][i]) - decode(seen[3][i]);
			/* Four roundings of half a step, and those of adding up. */
			assert_in_range(encode(sum) + 3, seen[0][i], seen[0][i] + 6);
		}
		for (int i = 0; i < 4; i++)
			free(seen[i]);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(an_empty_scene_is_its_background),
		rig_test(intensity_one_shows_a_facing_white_surface_as_white),
		rig_test(spots_fall_off_with_the_distance_squared_and_directional_lights_do_not),
		rig_test(a_slanted_light_gives_the_cosine),
		rig_test(light_from_behind_the_seen_side_is_none),
		rig_test(the_back_of_what_is_single_sided_is_not_seen),
		rig_test(a_spot_fades_towards_its_cone_and_ends_there),
		rig_test(ambient_light_comes_from_above_and_below),
		rig_test(an_image_multiplies_the_base_color_with_its_first_row_at_v_zero),
		rig_test(lights_look_the_same_whether_or_not_the_framebuffer_is_srgb),
		rig_test(nothing_is_left_of_the_frame_before),
		rig_test(lights_add_up_in_linear_light),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
