/* SPDX-License-Identifier: MIT */
/* How wide penumbrae are told to be, against the two triangles that a blocker and the light make,
 * and when that is drawn. */
#include "scene/penumbra.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define MAP 512

/* A square in the plane at that height. */
static void add_square(struct sm_scene *scene, bool casts, bool receives, float half, float height)
{
	const float positions[4][3] = {{-half, height, -half}, {half, height, -half},
		{half, height, half}, {-half, height, half}};
	static const uint32_t indices[] = {0, 2, 1, 0, 3, 2};
	struct sm_mesh_desc mesh = {
		.positions = positions[0], .vertex_count = 4, .indices = indices, .index_count = 6};
	struct sm_object_desc object = {
		.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
		.image = SM_NONE,
		.casts = casts,
		.receives = receives};
	uint32_t handle;
	assert_true(sm_scene_add_mesh(scene, &mesh, &object.mesh, NULL));
	assert_true(sm_scene_add_object(scene, &object, &handle, NULL));
}

/* From above. */
static struct light_frame frame_of(
	const struct sm_scene *scene, enum sm_light_type type, float radius)
{
	const struct sm_light_desc light = {
		.type = type, .position = {0, 10, 0}, .radius = radius, .angle = 40};
	struct light_frame frame;
	light_frame_init(&frame, &light, scene);
	return frame;
}

static float texels_of(const struct sm_scene *scene, enum sm_light_type type, float radius)
{
	struct light_frame frame = frame_of(scene, type, radius);
	return penumbra_texels(scene, &frame, MAP);
}

/* On the ground below the middle of the light, from what is at that height. */
static double true_texels(const struct light_frame *frame, double radius, double height)
{
	double width =
		frame->parallel ? 2 * radius / 10 * height : 2 * radius * height / (10 - height);
	double screen = 2 * (double)frame->half_extent * (frame->parallel ? 1 : 10);
	return width / screen * MAP;
}

static void test_no_penumbra_is_wider_and_none_much_narrower(void **state)
{
	(void)state;
	static const float heights[] = {9, 5, 1, 0.01f}, radii[] = {1e-3f, 0.1f, 2};
	for (int type = SM_LIGHT_SPOT; type <= SM_LIGHT_DIRECTIONAL; type++)
		for (size_t i = 0; i < COUNT(heights) * COUNT(radii); i++) {
			float height = heights[i / COUNT(radii)], radius = radii[i % COUNT(radii)];
			struct sm_scene *scene = sm_scene_create();
			add_square(scene, false, true, 3, 0);
			add_square(scene, true, false, 0.5f, height);
			struct light_frame frame =
				frame_of(scene, (enum sm_light_type)type, radius);
			double least = true_texels(&frame, radius, height);
			float found = penumbra_texels(scene, &frame, MAP);
			/* By the slant at the screen's corners, and rounding. */
			if (!(found > 0.999 * least && found < 1.2 * least))
				fail_msg("type %d, height %g, radius %g: %g, not %g", type,
					(double)height, (double)radius, (double)found, least);
			sm_scene_destroy(scene);
		}
}

static void test_without_light_or_shadow_there_is_none(void **state)
{
	(void)state;
	struct sm_scene *scene = sm_scene_create();
	assert_float_equal(texels_of(scene, SM_LIGHT_SPOT, 1), 0, 0);
	add_square(scene, false, true, 3, 0);
	assert_float_equal(texels_of(scene, SM_LIGHT_SPOT, 1), 0, 0);
	add_square(scene, true, false, 0.5f, 5);
	assert_float_equal(texels_of(scene, SM_LIGHT_SPOT, 0), 0, 0);
	assert_float_equal(texels_of(scene, SM_LIGHT_DIRECTIONAL, 0), 0, 0);
	assert_true(texels_of(scene, SM_LIGHT_SPOT, 1) > 100);
	sm_scene_destroy(scene);
	scene = sm_scene_create();
	add_square(scene, true, false, 0.5f, 5);
	assert_float_equal(texels_of(scene, SM_LIGHT_SPOT, 1), 0, 0);
	sm_scene_destroy(scene);
}

/* What is above a caster takes no shadow of it. */
static void test_receivers_before_all_casters_take_none(void **state)
{
	(void)state;
	struct sm_scene *scene = sm_scene_create();
	add_square(scene, true, false, 3, 0);
	add_square(scene, false, true, 0.5f, 5);
	assert_float_equal(texels_of(scene, SM_LIGHT_SPOT, 1), 0, 0);
	sm_scene_destroy(scene);
}

static void test_a_width_that_wavers_changes_nothing(void **state)
{
	(void)state;
	static const struct {
		float texels;
		bool shown;
	} steps[] = {{0, false}, {0.99f, false}, {0.8f, false}, {1, false}, {1.01f, true},
		{0.99f, true}, {0.76f, true}, {1.2f, true}, {0.75f, false}, {0.99f, false},
		{0.76f, false}, {1.5f, true}, {INFINITY, true}, {0, false}};
	bool shown = false;
	for (size_t i = 0; i < COUNT(steps); i++) {
		shown = penumbra_shows(steps[i].texels, shown);
		assert_int_equal(shown, steps[i].shown);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_no_penumbra_is_wider_and_none_much_narrower),
		cmocka_unit_test(test_without_light_or_shadow_there_is_none),
		cmocka_unit_test(test_receivers_before_all_casters_take_none),
		cmocka_unit_test(test_a_width_that_wavers_changes_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
