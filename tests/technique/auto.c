/* SPDX-License-Identifier: MIT */
/* "auto" draws what one of its two techniques draws, and which one does not waver. */
#include "canvas.h"
#include "parts.h"
#include "visibility.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 48
#define MAP 128
/* As many frames as nothing is given back in, and more. */
#define LONG 700

static const struct sm_camera camera = {
	.eye = {3, 5, 4}, .target = {0, 0.3f, 0}, .up = {0, 1, 0}, .fov = 40};

static struct sm_light_desc light_of(float radius)
{
	return (struct sm_light_desc){.type = SM_LIGHT_SPOT,
		.position = {1, 6, 2},
		.radius = radius,
		.angle = 50,
		.color = {1, 1, 1},
		.intensity = 1};
}

static void fill_scene(struct sm_scene *scene)
{
	const struct pose ground = {.scale = {3, 1, 3}},
			  cube = {.scale = {0.4f, 0.4f, 0.4f}, .turn = 20, .position = {0, 1, 0}};
	const struct sm_light_desc light = light_of(0);
	parts_add_object(scene, parts_add_square(scene), PART_RECEIVES, &ground);
	parts_add_object(scene, parts_add_cube(scene), PART_BOTH, &cube);
	parts_add_light(scene, &light);
}

static void set_radius(struct rig *rig, uint32_t index, float radius)
{
	const struct sm_light_desc light = light_of(radius);
	assert_true(sm_scene_set_light(rig->scene, index, &light, NULL));
}

static void use(struct rig *rig, const char *technique)
{
	rig_set_shadows(rig, &(struct sm_shadow_options){.technique = technique, .map_size = MAP});
}

/* Draws it with that radius, and tells whether "auto" took "hard". */
static bool draw(struct rig *rig, struct visibility *seen, float radius)
{
	struct sm_frame_stats stats;
	set_radius(rig, 0, radius);
	visibility_draw(seen, rig, rig->scene, &camera, SIZE, SIZE);
	sm_renderer_get_stats(rig->renderer, &stats);
	return stats.hard_lights == 1;
}

static bool is_hard(struct rig *rig, float radius)
{
	struct visibility seen;
	bool hard = draw(rig, &seen, radius);
	visibility_finish(&seen);
	return hard;
}

static void test_it_is_one_of_the_two_to_the_bit(void **state)
{
	struct rig *rig = *state;
	static const struct {
		float radius;
		const char *technique;
		double off; /* share of pixels: of a spot with a radius the map is fitted closer */
	} cases[] = {{0, "hard", 0}, {1e-3f, "hard", 0.02}, {0.3f, "gather", 0}, {1, "gather", 0},
		{0, "hard", 0}};
	fill_scene(rig->scene);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct visibility seen, wanted;
		use(rig, cases[i].technique);
		assert_false(draw(rig, &wanted, cases[i].radius));
		use(rig, "auto");
		assert_int_equal(
			draw(rig, &seen, cases[i].radius), strcmp(cases[i].technique, "hard") == 0);
		struct visibility_change change = visibility_compare(&seen, &wanted);
		assert_true(cases[i].off > 0 ? change.off < cases[i].off : change.differing == 0);
		visibility_finish(&seen);
		visibility_finish(&wanted);
	}
}

/* The least radius, to a thousandth, that a new renderer shows. */
static float find_threshold(struct rig *rig)
{
	float hidden = 0, shown = 1;
	while (shown - hidden > 1e-3f * shown) {
		float middle = (hidden + shown) / 2;
		use(rig, "auto");
		if (is_hard(rig, middle))
			hidden = middle;
		else
			shown = middle;
	}
	return shown;
}

static void test_a_radius_that_wavers_does_not_flicker(void **state)
{
	struct rig *rig = *state;
	fill_scene(rig->scene);
	float threshold = find_threshold(rig);
	use(rig, "auto");
	for (int i = 0; i < 20; i++)
		assert_true(is_hard(rig, threshold * (i % 2 == 0 ? 0.8f : 0.98f)));
	for (int i = 0; i < 20; i++)
		assert_false(is_hard(rig, threshold * (i % 2 == 0 ? 1.02f : 0.8f)));
	assert_true(is_hard(rig, threshold * 0.7f));
	assert_true(is_hard(rig, threshold * 0.8f));
}

static void draw_picture(struct rig *rig, uint32_t size)
{
	struct canvas canvas;
	canvas_init(&canvas, GL_RGBA8, size, size);
	const struct sm_view view = {.camera = camera,
		.framebuffer = canvas.framebuffer,
		.width = size,
		.height = size,
		.visibility_of = SM_NONE};
	rig_draw(rig, rig->scene, &view);
	canvas_finish(&canvas);
}

static uint64_t target_bytes(struct rig *rig)
{
	struct sm_memory memory;
	sm_renderer_get_memory(rig->renderer, rig->scene, &memory);
	return memory.targets;
}

static void test_what_is_not_drawn_takes_no_memory_for_long(void **state)
{
	struct rig *rig = *state;
	fill_scene(rig->scene);
	use(rig, "auto");
	assert_true(is_hard(rig, 0));
	uint64_t hard = target_bytes(rig);
	assert_false(is_hard(rig, 1));
	uint64_t both = target_bytes(rig);
	assert_true(both > hard);
	assert_true(is_hard(rig, 0));
	assert_int_equal(target_bytes(rig), both);
	for (int i = 0; i < LONG; i++)
		draw_picture(rig, 1);
	assert_int_equal(target_bytes(rig), hard);
	assert_false(is_hard(rig, 1));
	assert_int_equal(target_bytes(rig), both);
}

static void test_each_light_has_its_own(void **state)
{
	struct rig *rig = *state;
	const struct sm_light_desc wide = light_of(1);
	struct sm_frame_stats stats;
	fill_scene(rig->scene);
	parts_add_light(rig->scene, &wide);
	use(rig, "auto");
	draw_picture(rig, SIZE);
	sm_renderer_get_stats(rig->renderer, &stats);
	assert_int_equal(stats.lights, 2);
	assert_int_equal(stats.hard_lights, 1);
}

/* Those that it does not have stand for the technique that does. */
static void test_it_is_the_default_without_options_of_others(void **state)
{
	struct rig *rig = *state;
	static const struct {
		struct sm_shadow_options left_open, named;
	} cases[] = {
		{{0}, {.technique = "auto"}},
		{{.width = 0.1f}, {.technique = "smoothie", .width = 0.1f}},
		{{.passes = 2}, {.technique = "smoothie", .passes = 2}},
		{{.falloff = SM_FALLOFF_SINUSOID},
			{.technique = "smoothie", .falloff = SM_FALLOFF_SINUSOID}},
		{{.precision = SM_PRECISION_FIXED12},
			{.technique = "smoothie", .precision = SM_PRECISION_FIXED12}},
		{{.precision = SM_PRECISION_FLOAT}, {.technique = "auto"}},
	};
	fill_scene(rig->scene);
	set_radius(rig, 0, 0.3f);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct visibility seen, wanted;
		rig_set_shadows(rig, &cases[i].left_open);
		visibility_draw(&seen, rig, rig->scene, &camera, SIZE, SIZE);
		rig_set_shadows(rig, &cases[i].named);
		visibility_draw(&wanted, rig, rig->scene, &camera, SIZE, SIZE);
		assert_int_equal(visibility_compare(&seen, &wanted).differing, 0);
		visibility_finish(&seen);
		visibility_finish(&wanted);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(test_it_is_one_of_the_two_to_the_bit),
		rig_test(test_a_radius_that_wavers_does_not_flicker),
		rig_test(test_what_is_not_drawn_takes_no_memory_for_long),
		rig_test(test_it_is_the_default_without_options_of_others),
		rig_test(test_each_light_has_its_own),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
