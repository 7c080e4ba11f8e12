/* SPDX-License-Identifier: MIT */
#include "load/motion.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static void frames_have_their_times(void **state)
{
	static const struct {
		uint64_t frame;
		uint32_t numerator, denominator;
		double seconds;
	} cases[] = {
		{1, 25, 1, 0},
		{1, 60000, 1001, 0},
		{2, 25, 1, 1 / 25.},
		{26, 25, 1, 1},
		{2, 60000, 1001, 1001 / 60000.},
		{60001, 60000, 1001, 1001},
		{2, 1, 1000, 1000},
		{UINT64_C(1) << 32 | 1, INT32_MAX, INT32_MAX, 4294967296},
	};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++)
		assert_true(motion_time(cases[i].frame, cases[i].numerator, cases[i].denominator) ==
			    cases[i].seconds);
}

static void turns_repeat(void **state)
{
	static const struct {
		double seconds, period, phase;
	} cases[] = {
		{0, 4, 0},
		{1, 4, .25},
		{3, 4, .75},
		{4, 4, 0},
		{4e9 + 1, 4, .25},
		{1, -4, -.25},
		{5, -4, -.25},
		{-1, 4, -.25},
		{1e6, 1e6, 0},
		{7, 0, 0},
		{7, -0., 0},
	};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++)
		if (motion_phase(cases[i].seconds, cases[i].period) != cases[i].phase)
			fail_msg("case %zu", i);
}

/* Values of which sums round, and signs of zero. */
static const struct sm_camera far_camera = {.eye = {1e-7f, -0.f, -0.f},
	.target = {1e6f, 3, 0},
	.up = {-0.f, 1, 0},
	.fov = 35,
	.near = .1f,
	.far = 9};

/* Also a whole turn and a whole way later. */
static void at_rest_each_bit_is_kept(void **state)
{
	const struct motion_path path = {.orbit = 4, .travel = {1, 0, -2}, .travel_time = 2};
	struct sm_light_desc rest = {.radius = 2, .intensity = 3};
	(void)state;
	memcpy(rest.position, far_camera.eye, sizeof(rest.position));
	memcpy(rest.target, far_camera.target, sizeof(rest.target));
	for (double seconds = 0; seconds < 20; seconds += 4) {
		struct sm_camera camera;
		struct sm_light_desc light;
		motion_camera(&path, seconds, &far_camera, &camera);
		assert_memory_equal(&camera, &far_camera, sizeof(camera));
		motion_light(&path, seconds, &rest, &light);
		assert_memory_equal(&light, &rest, sizeof(light));
	}
}

static void check_vector(const float got[3], const float wanted[3])
{
	for (int i = 0; i < 3; i++)
		assert_float_equal(got[i], wanted[i], 1e-6);
}

/* In front of the target, to its right, behind it, to its left: as seen from above, where x points
 * right and z down. */
static void quarters_go_counter_clockwise(void **state)
{
	static const struct {
		double phase;
		float eye[3], up[3];
	} quarters[] = {
		{0, {1, 5, 5}, {0, .6f, .8f}},
		{.25, {4, 5, 2}, {.8f, .6f, 0}},
		{.5, {1, 5, -1}, {0, .6f, -.8f}},
		{.75, {-2, 5, 2}, {-.8f, .6f, 0}},
		{-.25, {-2, 5, 2}, {-.8f, .6f, 0}},
	};
	struct sm_camera rest = {.eye = {1, 5, 5}, .target = {1, 0, 2}, .up = {0, .6f, .8f}};
	struct sm_light_desc lamp = {.position = {1, 5, 5}, .target = {1, 0, 2}};
	(void)state;
	for (size_t i = 0; i < COUNT(quarters); i++) {
		struct sm_camera camera;
		struct sm_light_desc light;
		const struct motion_path path = {.orbit = 3, .travel_time = 1};
		motion_camera(&path, 3 * quarters[i].phase, &rest, &camera);
		check_vector(camera.eye, quarters[i].eye);
		check_vector(camera.up, quarters[i].up);
		check_vector(camera.target, rest.target);
		motion_light(&path, 3 * quarters[i].phase, &lamp, &light);
		check_vector(light.position, quarters[i].eye);
		check_vector(light.target, lamp.target);
	}
}

static void height_and_distance_are_kept(void **state)
{
	const struct sm_light_desc lamp = {.position = {-3, 7, .5f}, .target = {.2f, .4f, .1f}};
	const struct motion_path path = {.orbit = 1, .travel_time = 1};
	double level = hypot(-3.2f, .4f);
	(void)state;
	for (int i = -500; i <= 500; i++) {
		struct sm_light_desc light;
		motion_light(&path, i / 500., &lamp, &light);
		assert_true(light.position[1] == lamp.position[1]);
		assert_float_equal(
			hypot(light.position[0] - .2f, light.position[2] - .1f), level, 1e-6);
	}
}

static void the_way_leads_there_and_back(void **state)
{
	static const struct {
		double seconds, share;
	} cases[] = {{0, 0}, {1, .5}, {2, 1}, {3, .5}, {4, 0}, {6, 1}, {-2, 1}, {2. / 3, .25}};
	const struct motion_path path = {.travel = {4, 0, -8}, .travel_time = 4};
	const float rest[3] = {1, 2, 3}, center[3] = {9, 9, 9};
	(void)state;
	assert_true(motion_moves(&path));
	assert_false(motion_moves(&(struct motion_path){.travel_time = 4}));
	for (size_t i = 0; i < COUNT(cases); i++) {
		float point[3], share = (float)cases[i].share;
		motion_point(&path, cases[i].seconds, center, rest, point);
		check_vector(point, (float[]){1 + 4 * share, 2, 3 - 8 * share});
	}
}

/* Half of the way out, a quarter of a turn about (1, 0). */
static void the_way_turns_along(void **state)
{
	const struct motion_path path = {.orbit = 4, .travel = {2, 0, 0}, .travel_time = 2};
	const float rest[3] = {2, 5, 0}, center[3] = {1, 0, 0};
	float point[3];
	(void)state;
	motion_point(&path, 1, center, rest, point);
	check_vector(point, (float[]){1, 5, -3});
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(frames_have_their_times),
		cmocka_unit_test(turns_repeat),
		cmocka_unit_test(at_rest_each_bit_is_kept),
		cmocka_unit_test(quarters_go_counter_clockwise),
		cmocka_unit_test(the_way_leads_there_and_back),
		cmocka_unit_test(the_way_turns_along),
		cmocka_unit_test(height_and_distance_are_kept),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
