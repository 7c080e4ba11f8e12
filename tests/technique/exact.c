/* SPDX-License-Identifier: MIT */
/* The precisions half and fixed12: a driver draws the very bits that the processor does. */
#include "canvas.h"
#include "load/builtin.h"
#include "load/stage.h"
#include "visibility.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

struct exact_case {
	struct sm_shadow_options options;
	const char *setting; /* of the scene */
	uint32_t width, height;
};

static void check(struct rig *rig, const char *name, const struct exact_case *wanted)
{
	char source[64];
	struct stage stage;
	struct sm_error error = {0};
	struct visibility drawn;
	snprintf(source, sizeof(source), "builtin:%s", name);
	if (!stage_load(&stage, source, &wanted->setting, 1, &error))
		fail_msg("%s: %s", source, error.text);
	rig_set_shadows(rig, &wanted->options);
	visibility_draw(&drawn, rig, stage.scene, &stage.camera, wanted->width, wanted->height);
	size_t count = (size_t)wanted->width * wanted->height;
	uint16_t *model = calloc(count, sizeof(*model));
	assert_non_null(model);
	const struct sm_view view = {
		.camera = stage.camera, .width = wanted->width, .height = wanted->height};
	if (!sm_model_visibility(stage.scene, &view, &wanted->options, model, &error))
		fail_msg("%s: %s", source, error.text);
	size_t differing = 0, first = 0;
	for (size_t i = count; i-- > 0;) {
		differing += drawn.values[i] != model[i];
		first = drawn.values[i] != model[i] ? i : first;
	}
	if (differing > 0)
		fail_msg("%s, %s, %ux%u, map %u: %zu pixels differ; %zu, %zu is %u and not %u",
			source, wanted->setting, wanted->width, wanted->height,
			wanted->options.map_size, differing, first % wanted->width,
			first / wanted->width, drawn.values[first], model[first]);
	free(model);
	visibility_finish(&drawn);
	stage_finish(&stage);
}

static void every_built_in_scene_is_drawn_to_the_bit(struct rig *rig, enum sm_precision precision)
{
	const struct exact_case cases[] = {
		{{.precision = precision, .map_size = 256}, "light.type=spot", 128, 128},
		{{.precision = precision, .map_size = 201, .falloff = SM_FALLOFF_SINUSOID},
			"light.type=directional", 97, 61},
		{{.precision = precision, .map_size = 128, .width = 0.05f}, "light.radius=.5", 61,
			128},
	};
	const char *name;
	for (size_t i = 0; (name = builtin_name(i)) != NULL; i++)
		for (size_t j = 0; j < sizeof(cases) / sizeof(cases[0]); j++)
			check(rig, name, &cases[j]);
}

static void half_is_drawn_to_the_bit(void **state)
{
	every_built_in_scene_is_drawn_to_the_bit(*state, SM_PRECISION_HALF);
}

static void fixed12_is_drawn_to_the_bit(void **state)
{
	every_built_in_scene_is_drawn_to_the_bit(*state, SM_PRECISION_FIXED12);
}

static void any_size_is_drawn_to_the_bit(void **state)
{
	const enum sm_precision fixed12 = SM_PRECISION_FIXED12, half = SM_PRECISION_HALF;
	const struct exact_case cases[] = {
		{{.precision = fixed12, .map_size = 1}, "camera.fov=30", 33, 17},
		{{.precision = half, .map_size = 2}, "camera.fov=30", 1, 1},
		{{.precision = half, .map_size = 3}, "camera.fov=30", 2, 301},
		{{.precision = fixed12, .map_size = 2047}, "camera.fov=30", 131, 97},
		{{.precision = half, .map_size = 1000}, "camera.fov=3", 127, 129},
		{{.precision = fixed12, .map_size = 77}, "camera.fov=120", 300, 40},
		{{.precision = fixed12}, "object.receives=no", 65, 64},
		{{.precision = half, .map_size = 300}, "object.casts=no", 65, 64},
		{{.precision = half, .map_size = 300}, "light.radius=0", 65, 64},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check(*state, "torus", &cases[i]);
}

enum { WIDTH = 160, HEIGHT = 120 };

static uint8_t *draw_picture(
	struct rig *rig, const struct stage *stage, enum sm_precision precision)
{
	struct canvas canvas;
	canvas_init(&canvas, GL_RGBA8, WIDTH, HEIGHT);
	const struct sm_view view = {.camera = stage->camera,
		.framebuffer = canvas.framebuffer,
		.width = WIDTH,
		.height = HEIGHT,
		.visibility_of = SM_NONE};
	rig_set_shadows(rig, &(struct sm_shadow_options){.precision = precision});
	rig_draw(rig, stage->scene, &view);
	uint8_t *rgba = canvas_read(&canvas);
	canvas_finish(&canvas);
	return rgba;
}

/* Whether a pixel's red is beyond all of the 3x3 around it in another picture, by more than 16. */
static bool stands_out(const uint8_t *rgba, const uint8_t *other, int x, int y)
{
	int value = rgba[4 * (y * WIDTH + x)], least = 255, most = 0;
	for (int i = 0; i < 9; i++) {
		int there = other[4 * ((y + i / 3 - 1) * WIDTH + x + i % 3 - 1)];
		least = there < least ? there : least;
		most = there > most ? there : most;
	}
	return value < least - 16 || value > most + 16;
}

/* But for edges, where drivers have coverages of their own, and precisions another one. */
static void assert_alike(const uint8_t *rgba, const uint8_t *other)
{
	uint32_t off = 0;
	for (int y = 1; y < HEIGHT - 1; y++)
		for (int x = 1; x < WIDTH - 1; x++)
			off += stands_out(rgba, other, x, y);
	assert_in_range(off, 0, WIDTH * HEIGHT / 2000);
}

static void coloured_pictures_are_like_those_of_floats(void **state)
{
	static const char *const scenes[] = {
		"builtin:knot", "builtin:boxes", "builtin:fence", "builtin:primitives"};
	for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++) {
		struct stage stage;
		struct sm_error error = {0};
		if (!stage_load(&stage, scenes[i], NULL, 0, &error))
			fail_msg("%s: %s", scenes[i], error.text);
		uint8_t *floats = draw_picture(*state, &stage, SM_PRECISION_FLOAT);
		uint8_t *half = draw_picture(*state, &stage, SM_PRECISION_HALF);
		uint8_t *fixed12 = draw_picture(*state, &stage, SM_PRECISION_FIXED12);
		assert_alike(half, floats);
		assert_alike(fixed12, floats);
		free(floats);
		free(half);
		free(fixed12);
		stage_finish(&stage);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(half_is_drawn_to_the_bit),
		rig_test(fixed12_is_drawn_to_the_bit),
		rig_test(any_size_is_drawn_to_the_bit),
		rig_test(coloured_pictures_are_like_those_of_floats),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
