/* SPDX-License-Identifier: MIT */
/* What a model refuses, and its smallest maps and pictures. */
#include "likeness.h"
#include "model/difference.h"
#include "parts.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct sm_camera overhead = {.eye = {0, 5, 0.1f}, .up = {0, 0, 1}, .fov = 40};

/* A square above another, lit from above. */
static struct sm_scene *make_scene(void)
{
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	uint32_t square = parts_add_square(scene);
	parts_add_object(scene, square, PART_RECEIVES, &(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
	parts_add_object(scene, square, PART_CASTS, &(struct pose){{0.4f, 1, 0.4f}, 20, {0, 1, 0}});
	parts_add_light(
		scene, &(struct sm_light_desc){.position = {2, 4, 0}, .radius = 0.2f, .angle = 60});
	return scene;
}

static void assert_refused(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, const char *part)
{
	uint16_t values[16];
	struct sm_error error = {0};
	assert_false(sm_model_visibility(scene, view, options, values, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	if (strstr(error.text, part) == NULL)
		fail_msg("\"%s\" does not say \"%s\"", error.text, part);
	assert_false(sm_model_visibility(scene, view, options, values, NULL));
}

static void test_what_cannot_be_drawn_is_refused(void **state)
{
	(void)state;
	static const struct {
		struct sm_view view;
		struct sm_shadow_options options;
		const char *part;
	} cases[] = {
		{{.width = 0, .height = 4}, {0}, "0x4 pixels"},
		{{.width = 4, .height = 16385}, {0}, "4x16385 pixels"},
		{{.width = 4, .height = 4, .visibility_of = 1}, {0}, "no light 1"},
		{{.width = 4, .height = 4, .visibility_of = SM_NONE}, {0}, "no light"},
		{{.width = 4, .height = 4}, {.technique = "none"}, "no technique \"none\""},
		{{.width = 4, .height = 4}, {.technique = "hard", .width = 0.1f}, "width"},
		{{.width = 4, .height = 4}, {.map_size = 16385}, "16385 texels"},
	};
	struct sm_scene *scene = make_scene();
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct sm_view view = cases[i].view;
		view.camera = overhead;
		assert_refused(scene, &view, &cases[i].options, cases[i].part);
	}
	struct sm_view blind = {.camera = overhead, .width = 4, .height = 4};
	memcpy(blind.camera.target, blind.camera.eye, sizeof(blind.camera.eye));
	assert_refused(scene, &blind, &cases[0].options, "camera");
	sm_scene_destroy(scene);
}

static void test_a_grid_has_1_to_8_bits(void **state)
{
	(void)state;
	struct sm_scene *scene = make_scene();
	struct sm_view view = {.camera = overhead, .width = 4, .height = 4};
	struct sm_shadow_options options = {0};
	uint16_t values[16];
	struct sm_error error;
	static const uint32_t refused[] = {0, 9};
	for (size_t i = 0; i < COUNT(refused); i++) {
		assert_false(sm_model_visibility_snapped(
			scene, &view, &options, refused[i], values, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		assert_non_null(strstr(error.text, "bits"));
	}
	for (uint32_t bits = 1; bits <= 8; bits++)
		assert_true(
			sm_model_visibility_snapped(scene, &view, &options, bits, values, &error));
	options.precision = SM_PRECISION_HALF;
	assert_false(sm_model_visibility_snapped(scene, &view, &options, 4, values, &error));
	assert_non_null(strstr(error.text, "half"));
	sm_scene_destroy(scene);
}

static uint32_t count_dark(const struct sm_scene *scene, const struct sm_shadow_options *options)
{
	uint16_t values[256];
	struct sm_view view = {.camera = overhead, .width = 16, .height = 16};
	struct sm_error error;
	uint32_t dark = 0;
	if (!sm_model_visibility(scene, &view, options, values, &error))
		fail_msg("%s", error.text);
	for (size_t i = 0; i < COUNT(values); i++)
		dark += values[i] < 32768;
	return dark;
}

/* Border texels stay clear; but gather asks no map what lies behind all casters. */
static void test_the_smallest_maps_show_no_shadow(void **state)
{
	(void)state;
	struct sm_scene *scene = make_scene();
	const char *name;
	for (size_t i = 0; (name = sm_technique_name(i)) != NULL; i++)
		for (uint32_t size = 1; size <= 2; size++) {
			struct sm_shadow_options options = {.technique = name, .map_size = size};
			bool needs_map = strcmp(name, "gather") != 0;
			assert_true((count_dark(scene, &options) == 0) == needs_map);
			options.map_size = 64;
			assert_true(count_dark(scene, &options) > 0);
		}
	sm_scene_destroy(scene);
}

static void test_an_empty_scene_is_lit(void **state)
{
	(void)state;
	struct sm_scene *scene = sm_scene_create();
	const char *name;
	parts_add_light(scene, &(struct sm_light_desc){.position = {0, 4, 0}, .angle = 60});
	for (size_t i = 0; (name = sm_technique_name(i)) != NULL; i++) {
		struct sm_shadow_options options = {.technique = name, .map_size = 16};
		assert_int_equal(count_dark(scene, &options), 0);
	}
	sm_scene_destroy(scene);
}

/* Sizes and lights at the ends of what a scene takes: there is a picture, whatever it shows. */
static void test_extremes_are_drawn(void **state)
{
	(void)state;
	static const struct {
		struct pose pose;
		float radius, angle, height;
	} extremes[] = {
		{{{0, 0, 0}, 0, {0, 1, 0}}, 0.2f, 60, 4},
		{{{1, 0, 1}, 0, {0, 0, 0}}, 0, 170, 4},
		{{{1e-20f, 1e-20f, 1e-20f}, 0, {0, 1, 0}}, 1e6f, 60, 4},
		{{{1e15f, 1e15f, 1e15f}, 30, {0, 1, 0}}, 1e-6f, 1, 4},
		{{{1e15f, 1, 1e-15f}, 30, {1e15f, 1, 0}}, 1e15f, 170, 1e15f},
		{{{-1, 1, 1}, 30, {0, 4, 0}}, 1, 120, 4},
	};
	static const enum sm_light_type types[] = {SM_LIGHT_SPOT, SM_LIGHT_DIRECTIONAL};
	const char *name;
	for (size_t i = 0; i < COUNT(extremes); i++)
		for (size_t type = 0; type < COUNT(types); type++) {
			struct sm_scene *scene = sm_scene_create();
			struct sm_light_desc light = {.type = types[type],
				.position = {0.5f, extremes[i].height, 0},
				.radius = extremes[i].radius,
				.angle = extremes[i].angle};
			parts_add_object(scene, parts_add_square(scene), PART_BOTH,
				&(struct pose){{4, 1, 4}, 0, {0, 0, 0}});
			parts_add_object(
				scene, parts_add_cube(scene), PART_BOTH, &extremes[i].pose);
			parts_add_light(scene, &light);
			for (size_t j = 0; (name = sm_technique_name(j)) != NULL; j++)
				count_dark(scene, &(struct sm_shadow_options){
							  .technique = name, .map_size = 32});
			sm_scene_destroy(scene);
		}
}

static void test_differences_are_summed_up(void **state)
{
	(void)state;
	static const uint16_t a[] = {0, 65535, 100, 200}, b[] = {65535, 65535, 0, 200};
	struct model_difference found = model_difference(a, b, 4, 0.01);
	assert_float_equal(found.mean, (1 + 100 / 65535.0) / 4, 1e-9);
	assert_float_equal(found.max, 1, 0);
	assert_int_equal(found.failing, 1);
	found = model_difference(a, b, 4, 0.001);
	assert_int_equal(found.failing, 2);
	found = model_difference(a, b, 0, 0);
	assert_true(found.mean == 0 && found.max == 0 && found.failing == 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_what_cannot_be_drawn_is_refused),
		cmocka_unit_test(test_a_grid_has_1_to_8_bits),
		cmocka_unit_test(test_the_smallest_maps_show_no_shadow),
		cmocka_unit_test(test_an_empty_scene_is_lit),
		cmocka_unit_test(test_extremes_are_drawn),
		cmocka_unit_test(test_differences_are_summed_up),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
