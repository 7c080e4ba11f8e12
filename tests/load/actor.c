/* SPDX-License-Identifier: MIT */
/* Animations of models in a scene: of rig.gltf, which import_rig.c describes. */
#include "load/stage.h"
#include "scene/scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void load(struct stage *stage, const char *source, const char *setting)
{
	struct sm_error error;
	if (!stage_load(stage, source, &setting, setting != NULL, &error))
		fail_msg("%s", error.text);
}

/* Where the flat triangle of rig.gltf is, and how far the arm's corner at x has come up. */
static void check_animation(const char *setting, double seconds, float walked, double degrees)
{
	struct stage stage;
	load(&stage, SMOOTHIE_RIG, setting);
	assert_true(stage_set_time(&stage, seconds, NULL));
	assert_float_equal(stage.scene->objects[1].transform[3][0], walked, 1e-5);
	const struct mesh *arm = &stage.scene->meshes[stage.scene->objects[3].mesh];
	float highest = 0, s = (float)sin(degrees * M_PI / 180);
	for (size_t v = 0; v < arm->vertex_count; v++)
		highest = fmaxf(highest, arm->positions[v][1]);
	float corner = 1 - (float)cos(degrees * M_PI / 180) + s;
	assert_float_equal(highest, fmaxf(corner, 1), 1e-5);
	stage_finish(&stage);
}

static void models_play_their_animations(void **state)
{
	(void)state;
	check_animation(NULL, .75, 1.5f, 67.5);
	check_animation("object.animation=Go", 1.75, 1.5f, 67.5);
	check_animation("object.animation=0", 0, 0, 0);
	check_animation("object.animation=Wave", .75, 0, 67.5);
	check_animation("object.animation=1", .75, 0, 67.5);
	check_animation("object.animation=none", .75, 0, 0);
	check_animation("object.speed=.5", 1.5, 1.5f, 67.5);
	check_animation("object.speed=-1", .25, 1.5f, 67.5);
	check_animation("object.speed=0", .75, 0, 0);
}

static void a_scene_moves_while_its_models_do(void **state)
{
	static const struct {
		const char *setting;
		bool moves;
	} cases[] = {{NULL, true}, {"object.animation=none", false}, {"object.speed=0", false},
		{"object.animation=Broken", false}};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		struct stage stage;
		load(&stage, SMOOTHIE_RIG, cases[i].setting);
		assert_true(stage_moves(&stage) == cases[i].moves);
		stage_finish(&stage);
	}
}

/* The triangle walks from 0 to 2, and is 1 wide. */
static void the_view_is_of_all_that_an_animation_does(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage, SMOOTHIE_RIG, NULL);
	assert_float_equal(stage.framing.frame.max[0], 3, 1e-5);
	stage_finish(&stage);
	load(&stage, SMOOTHIE_RIG, "object.animation=none");
	assert_float_equal(stage.framing.frame.max[0], 1, 1e-5);
	stage_finish(&stage);
}

static void check_vector(const float got[3], float x, float y, float z)
{
	assert_float_equal(got[0], x, 1e-5);
	assert_float_equal(got[1], y, 1e-5);
	assert_float_equal(got[2], z, 1e-5);
}

/* In lift.gltf a node takes a spot, a lamp that shines all around and a camera 2 units along x, in
 * a second. Nothing else moves. */
static void lights_and_cameras_go_with_their_nodes(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage, SMOOTHIE_LIFT, NULL);
	const struct light *lights = stage.scene->lights;
	struct sm_light_desc spot = lights[0].desc, lamp = lights[1].desc;
	struct sm_camera camera = stage.camera;
	assert_true(stage_set_time(&stage, .5, NULL));
	check_vector(lights[0].desc.position, 1, 0, 4);
	check_vector(lights[0].desc.target, spot.target[0] + 1, spot.target[1], spot.target[2]);
	check_vector(lights[1].desc.position, 1, 3, 0);
	check_vector(lights[1].desc.target, lamp.target[0], lamp.target[1], lamp.target[2]);
	check_vector(stage.camera.eye, 1, 1, 6);
	check_vector(stage.camera.target, 1, 1, 5);
	assert_true(stage_set_time(&stage, 0, NULL));
	assert_memory_equal(lights[0].desc.position, spot.position, sizeof(spot.position));
	assert_memory_equal(lights[0].desc.target, spot.target, sizeof(spot.target));
	assert_memory_equal(&stage.camera, &camera, sizeof(camera));
	stage_finish(&stage);
}

static void what_the_scene_places_stays(void **state)
{
	static const char *const settings[] = {
		"light.position=5 5 5", "camera.eye=0 2 9", "camera.target=0 0 1"};
	struct stage stage;
	struct sm_error error;
	(void)state;
	assert_true(stage_load(&stage, SMOOTHIE_LIFT, settings, 3, &error));
	struct sm_camera camera = stage.camera;
	assert_true(stage_set_time(&stage, .5, NULL));
	check_vector(stage.scene->lights[0].desc.position, 5, 5, 5);
	assert_memory_equal(&stage.camera, &camera, sizeof(camera));
	stage_finish(&stage);
}

/* A quarter of a turn of the whole model about the axis through (0, 0, 4). */
static void lights_go_with_the_whole_model(void **state)
{
	static const char *const settings[] = {
		"object.animation=none", "object.orbit=4", "object.center=0 0 4"};
	struct stage stage;
	struct sm_error error;
	(void)state;
	assert_true(stage_load(&stage, SMOOTHIE_LIFT, settings, 3, &error));
	assert_true(stage_set_time(&stage, 1, NULL));
	check_vector(stage.scene->lights[0].desc.position, 0, 0, 4);
	check_vector(stage.scene->lights[1].desc.position, -4, 3, 4);
	check_vector(stage.camera.eye, 2, 1, 4);
	stage_finish(&stage);
}

static void unknown_animations_are_refused(void **state)
{
	static const struct {
		const char *source, *setting, *error;
	} cases[] = {
		{SMOOTHIE_RIG, "object.animation=Jump",
			SMOOTHIE_RIG ": [object rig] no animation is called \"Jump\"; known: Go, "
				     "Wave, Broken"},
		{SMOOTHIE_RIG, "object.animation=3",
			SMOOTHIE_RIG
			": [object rig] no animation is called \"3\"; known: Go, Wave, "
			"Broken"},
		{"builtin:cube", "object.animation=Go",
			"builtin:cube: [object cube] no animation is called \"Go\"; known: none"},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		struct stage stage;
		struct sm_error error;
		assert_false(stage_load(&stage, cases[i].source, &cases[i].setting, 1, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		assert_string_equal(error.text, cases[i].error);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(models_play_their_animations),
		cmocka_unit_test(a_scene_moves_while_its_models_do),
		cmocka_unit_test(the_view_is_of_all_that_an_animation_does),
		cmocka_unit_test(lights_and_cameras_go_with_their_nodes),
		cmocka_unit_test(what_the_scene_places_stays),
		cmocka_unit_test(lights_go_with_the_whole_model),
		cmocka_unit_test(unknown_animations_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
