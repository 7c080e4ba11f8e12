/* SPDX-License-Identifier: MIT */
/*
 * The model and a driver without faults draw the same pictures. What is left are pixels and texels
 * whose middle lies on an edge but for rounding, and rounding itself.
 */
#include "likeness.h"
#include "load/builtin.h"
#include "parts.h"
#include "renderer.h"
#include "strip.h"
#include "visibility.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Most that was found with llvmpipe, softpipe, zink on lavapipe and SwiftShader is a mean of 5e-5,
 * and of 65536 pixels 37 that differ by more than .02, 9 of them by more than .1. Other processors
 * and drivers round other pixels to the other side of an edge. */
#define MEAN_MOST 1.2e-4
#define BY_02_MOST (60 / 65536.0)
#define BY_1_MOST (20 / 65536.0)

/* Seconds; .25 and 1 are aimed at, on a processor that nothing else is run on. */
#define SECONDS_MOST 10

#define LINEAR true /* compared by a linear sampler, which not every driver has blend */

static const struct look {
	const char *name;
	struct sm_shadow_options options;
	bool linear;
} looks[] = {
	{"smoothie", {.technique = "smoothie"}},
	{"sinusoid", {.technique = "smoothie", .falloff = SM_FALLOFF_SINUSOID}},
	{"wide", {.technique = "smoothie", .width = 0.02f}},
	{"two passes", {.technique = "smoothie", .passes = 2}},
	{"two-sided", {.technique = "smoothie-two-sided"}},
	{"penumbra-map", {.technique = "penumbra-map"}},
	{"smooth cones", {.technique = "penumbra-map", .falloff = SM_FALLOFF_SINUSOID}},
	{"gather", {.technique = "gather", .sampling = SM_SAMPLING_DENSE}},
	{"hard", {.technique = "hard"}},
	{"pcf 4", {.technique = "pcf", .samples = 4}},
	{"pcf 16", {.technique = "pcf", .samples = 16}},
	{"pcss 16", {.technique = "pcss", .samples = 16}, LINEAR},
	{"pcss 32", {.technique = "pcss", .samples = 32}, LINEAR},
	{"vsm 5", {.technique = "vsm", .samples = 5}},
	{"vsm 9", {.technique = "vsm", .samples = 9}},
	{"maps 4", {.technique = "maps", .samples = 4}, LINEAR},
	{"maps 16", {.technique = "maps", .samples = 16}, LINEAR},
	{"maps 64", {.technique = "maps", .samples = 64}, LINEAR},
};

static void check(const char *scene, const char *look, const struct likeness *found)
{
	print_message("%-12s %-12s mean %.6f, off %.5f by .001, %.5f by .02, %.5f by .1, %.0f ms\n",
		scene, look, found->mean, found->by_001, found->by_02, found->by_1,
		1e3 * found->seconds);
	if (found->mean > MEAN_MOST || found->by_02 > BY_02_MOST || found->by_1 > BY_1_MOST)
		fail_msg("%s, %s: mean %.6f, %.5f off by .02, %.5f by .1", scene, look, found->mean,
			found->by_02, found->by_1);
	assert_true(found->seconds < SECONDS_MOST);
}

static void compare(struct rig *rig, const char *name, const struct sm_scene *scene,
	const struct sm_camera *camera, const struct look *looked, size_t count)
{
	int way = way_choose(&rig->renderer->gpu, DRIVER_COMPARISON, NULL);
	bool blended = way == COMPARISON_SAMPLER;
	for (size_t i = 0; i < count; i++) {
		struct sm_shadow_options options = looked[i].options;
		options.map_size = 512;
		if ((looked[i].linear && !blended) || !rig_can_draw(options.technique))
			continue;
		struct likeness found = likeness_of(rig, scene, camera, &options);
		check(name, looked[i].name, &found);
	}
}

static void compare_builtin(
	struct rig *rig, const char *scene, const struct look *looked, size_t count)
{
	struct stage stage;
	likeness_load(&stage, scene);
	compare(rig, scene, stage.scene, &stage.camera, looked, count);
	stage_finish(&stage);
}

/* Whole scenes come first, up to this one. */
#define LAST_SCENE "primitives"

static size_t scene_count(void)
{
	size_t last = 0;
	while (strcmp(builtin_name(last), LAST_SCENE) != 0)
		last++;
	return last + 1;
}

static void test_scenes_look_alike(void **state)
{
	for (size_t i = 0; i < scene_count(); i += SCENES_STEP)
		compare_builtin(*state, builtin_name(i), looks, COUNT(looks));
}

static void test_solids_look_alike(void **state)
{
	static const struct look few[] = {
		{"smoothie", {.technique = "smoothie"}},
		{"two-sided", {.technique = "smoothie-two-sided"}},
		{"hard", {.technique = "hard"}},
	};
	for (size_t i = scene_count(); builtin_name(i) != NULL; i += SCENES_STEP)
		compare_builtin(*state, builtin_name(i), few, COUNT(few));
}

static void compare_strip(struct rig *rig, const char *name, const struct strip_profile *profile)
{
	static const struct look gather = {
		"gather", {.technique = "gather", .sampling = SM_SAMPLING_DENSE}};
	struct sm_camera camera = strip_camera(-0.7f);
	strip_add(rig->scene, profile);
	compare(rig, name, rig->scene, &camera, &gather, 1);
}

static void test_a_level_strip_looks_alike(void **state)
{
	compare_strip(*state, "level", &strip_level);
}

static void test_a_bent_strip_looks_alike(void **state)
{
	compare_strip(*state, "bent", &strip_bent);
}

static void test_a_falling_strip_looks_alike(void **state)
{
	compare_strip(*state, "falling", &strip_falling);
}

/* What the built-in scenes have not: open meshes, mirrored ones, objects that only cast or only
 * receive, some before casters, and the camera's and the light's near planes cut through. */
static void add_parts(struct sm_scene *scene, const float at[3])
{
	const struct {
		bool cube;
		unsigned int roles;
		struct pose pose;
	} parts[] = {
		{false, PART_RECEIVES, {{20, 1, 20}, 0, {0, 0, 0}}},
		{false, PART_BOTH, {{0.7f, 1, 0.4f}, 30, {-0.8f, 1.1f, 0.2f}}},
		{true, PART_BOTH, {{-0.3f, 0.5f, 0.3f}, 20, {0.6f, 0.6f, 0.1f}}},
		{true, PART_RECEIVES, {{0.2f, 0.2f, 0.2f}, 50, {0.5f, 0.3f, -0.9f}}},
		{true, PART_CASTS, {{0.1f, 0.9f, 0.1f}, 10, {1.3f, 1.0f, 0.8f}}},
		{false, PART_RECEIVES, {{0.3f, 1, 0.3f}, 70, {-0.6f, 1.9f, 0.5f}}},
	};
	uint32_t square = parts_add_square(scene), cube = parts_add_cube(scene);
	for (size_t i = 0; i < COUNT(parts); i++) {
		struct pose pose = parts[i].pose;
		for (int axis = 0; axis < 3; axis++)
			pose.position[axis] += at[axis];
		parts_add_object(scene, parts[i].cube ? cube : square, parts[i].roles, &pose);
	}
}

static void compare_parts(struct rig *rig, const char *name, enum sm_light_type type,
	const float at[3], const float eye[3])
{
	struct sm_light_desc light = {.type = type,
		.position = {at[0] + 1, at[1] + 5, at[2] + 1.5f},
		.target = {at[0], at[1], at[2]},
		.radius = 0.2f,
		.angle = 60};
	struct sm_camera camera = {.eye = {at[0] + eye[0], at[1] + eye[1], at[2] + eye[2]},
		.target = {at[0], at[1] + 0.4f, at[2]},
		.up = {0, 1, 0},
		.fov = 50};
	add_parts(rig->scene, at);
	parts_add_light(rig->scene, &light);
	compare(rig, name, rig->scene, &camera, looks, COUNT(looks));
}

static void test_a_directional_light_looks_alike(void **state)
{
	static const float origin[3] = {0, 0, 0}, eye[3] = {-2, 3, 4};
	compare_parts(*state, "directional", SM_LIGHT_DIRECTIONAL, origin, eye);
}

static void test_odd_parts_look_alike(void **state)
{
	static const float origin[3] = {0, 0, 0}, eye[3] = {2, 2.5f, 3};
	compare_parts(*state, "spot", SM_LIGHT_SPOT, origin, eye);
}

/* The ground reaches behind the eye. */
static void test_near_the_ground_it_looks_alike(void **state)
{
	static const float origin[3] = {0, 0, 0}, eye[3] = {-1.5f, 0.25f, 2};
	compare_parts(*state, "low", SM_LIGHT_SPOT, origin, eye);
}

/* Where floats have no digits left for matrices that lead there and back. */
static void test_far_away_it_looks_alike(void **state)
{
	static const float away[3] = {20000, -3000, 50000}, eye[3] = {-2, 3, 4};
	compare_parts(*state, "far away", SM_LIGHT_SPOT, away, eye);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(test_scenes_look_alike),
		rig_test(test_solids_look_alike),
		rig_test(test_a_level_strip_looks_alike),
		rig_test(test_a_bent_strip_looks_alike),
		rig_test(test_a_falling_strip_looks_alike),
		rig_test(test_a_directional_light_looks_alike),
		rig_test(test_odd_parts_look_alike),
		rig_test(test_near_the_ground_it_looks_alike),
		rig_test(test_far_away_it_looks_alike),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
