/* SPDX-License-Identifier: MIT */
/* The exact pictures next to those that the driver draws in floats, and what the model refuses. */
#include "load/builtin.h"
#include "load/stage.h"
#include "visibility.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 256
#define MAP_SIZE 512
#define SMOOTHIE .technique = "smoothie" /* the only one that has both kinds */

static struct stage stage_of(const char *source, const char *const *settings, size_t count)
{
	struct stage stage;
	struct sm_error error;
	if (!stage_load(&stage, source, settings, count, &error))
		fail_msg("%s", error.text);
	return stage;
}

static struct visibility model_of(
	const struct stage *stage, const struct sm_shadow_options *options)
{
	struct visibility visibility = {.width = SIZE, .height = SIZE};
	struct sm_error error;
	const struct sm_view view = {.camera = stage->camera, .width = SIZE, .height = SIZE};
	visibility.values = calloc((size_t)SIZE * SIZE, sizeof(*visibility.values));
	assert_non_null(visibility.values);
	if (!sm_model_visibility(stage->scene, &view, options, visibility.values, &error))
		fail_msg("%s", error.text);
	return visibility;
}

/* mean, off: the most that is allowed of visibility_change */
static void compare(struct rig *rig, const char *source, const struct stage *stage,
	const struct sm_shadow_options *options, double mean, double off)
{
	struct visibility drawn;
	struct sm_shadow_options in_floats = *options;
	in_floats.precision = SM_PRECISION_FLOAT;
	rig_set_shadows(rig, &in_floats);
	visibility_draw(&drawn, rig, stage->scene, &stage->camera, SIZE, SIZE);
	for (int p = SM_PRECISION_HALF; p <= SM_PRECISION_FIXED12; p++) {
		struct sm_shadow_options exact = *options;
		exact.precision = (enum sm_precision)p;
		struct visibility model = model_of(stage, &exact);
		struct visibility_change change = visibility_compare(&drawn, &model);
		visibility_finish(&model);
		print_message("%-12s %-7s mean %.5f, off %.5f\n", source,
			sm_precision_name((size_t)p - 1), change.mean, change.off);
		assert_true(change.mean <= mean && change.off <= off);
	}
	visibility_finish(&drawn);
}

/* What differs are pixels of edges, which are snapped to another grid: most on the fence, .0005. */
static void built_in_scenes_are_close_to_floats(void **state)
{
	struct rig *rig = *state;
	const struct sm_shadow_options options = {SMOOTHIE, .map_size = MAP_SIZE};
	for (size_t i = 0; builtin_name(i) != NULL; i++) {
		char source[64];
		snprintf(source, sizeof(source), "builtin:%s", builtin_name(i));
		struct stage stage = stage_of(source, NULL, 0);
		compare(rig, builtin_name(i), &stage, &options, 0.001, 0.0015);
		stage_finish(&stage);
	}
}

static void every_kind_of_penumbra_is_close_to_floats(void **state)
{
	struct rig *rig = *state;
	static const struct {
		const char *name, *settings[2];
		struct sm_shadow_options options;
	} kinds[] = {
		{"wide light", {"light.radius=1"}, {SMOOTHIE, .map_size = MAP_SIZE}},
		{"sinusoid", {"light.radius=1"},
			{SMOOTHIE, .map_size = MAP_SIZE, .falloff = SM_FALLOFF_SINUSOID}},
		{"wide fins", {"light.radius=1"}, {SMOOTHIE, .map_size = MAP_SIZE, .width = 0.04f}},
		{"parallel", {"light.radius=1", "light.type=directional"},
			{SMOOTHIE, .map_size = MAP_SIZE}},
		{"point", {"light.radius=0"}, {SMOOTHIE, .map_size = MAP_SIZE}},
		{"tiny map", {"light.radius=1"}, {SMOOTHIE, .map_size = 7}},
	};
	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++) {
		size_t count = kinds[i].settings[1] != NULL ? 2 : 1;
		struct stage stage = stage_of("builtin:boxes", kinds[i].settings, count);
		compare(rig, kinds[i].name, &stage, &kinds[i].options, 0.001, 0.0015);
		stage_finish(&stage);
	}
}

static void refuse(const struct sm_scene *scene, const struct sm_view *view,
	const struct sm_shadow_options *options, const char *text)
{
	uint16_t value = 7;
	struct sm_error error = {0};
	assert_false(sm_model_visibility(scene, view, options, &value, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_non_null(strstr(error.text, text));
	assert_int_equal(value, 7);
}

static void what_cannot_be_drawn_is_refused(void **state)
{
	(void)state;
	struct stage stage = stage_of("builtin:cube", NULL, 0);
	struct sm_view view = {.camera = stage.camera, .width = 1, .height = 1};
	struct sm_shadow_options options = {.precision = SM_PRECISION_HALF};
	view.width = 2048;
	refuse(stage.scene, &view, &options, "2048x1");
	view.width = 0;
	refuse(stage.scene, &view, &options, "0x1");
	view.width = 1;
	view.visibility_of = 1;
	refuse(stage.scene, &view, &options, "light 1");
	view.visibility_of = SM_NONE;
	refuse(stage.scene, &view, &options, "no light");
	view.visibility_of = 0;
	options.map_size = 2048;
	refuse(stage.scene, &view, &options, "2047");
	options.map_size = 0;
	options.technique = "hard";
	refuse(stage.scene, &view, &options, "precision");
	options.technique = NULL;
	view.camera.target[0] = view.camera.eye[0];
	view.camera.target[1] = view.camera.eye[1];
	view.camera.target[2] = view.camera.eye[2];
	refuse(stage.scene, &view, &options, "camera");
	stage_finish(&stage);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(built_in_scenes_are_close_to_floats),
		rig_test(every_kind_of_penumbra_is_close_to_floats),
		cmocka_unit_test(what_cannot_be_drawn_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
