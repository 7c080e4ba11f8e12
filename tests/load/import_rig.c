/* SPDX-License-Identifier: MIT */
/* What moves in rig.gltf: a flat triangle that walks, a sail that is blown, and an arm on a bone at
 * (0, 1, 0). All are the triangle 0, x, y; "Go" takes a second. */
#include "load/import.h"
#include <cglm/cglm.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static struct model *load(const char *path, enum plan_up up)
{
	struct sm_error error;
	struct model *model = model_create(&error);
	assert_non_null(model);
	if (!import_model(path, up, model, &error))
		fail_msg("%s", error.text);
	return model;
}

static void check(const float *got, const float *expected, size_t count)
{
	for (size_t i = 0; i < count; i++)
		assert_float_equal(got[i], expected[i], 1e-5);
}

static void the_rig_is_that_of_the_file(void **state)
{
	static const char *const names[] = {"Go", "Wave", "Broken"};
	static const size_t channels[] = {2, 1, 0}, blends[] = {1, 0, 0};
	struct model *model = load(SMOOTHIE_RIG, PLAN_UP_AUTO);
	const struct rig *rig = &model->rig;
	(void)state;
	assert_int_equal(rig->object_count, 3);
	assert_int_equal(rig->shape_count, 2);
	assert_int_equal(rig->shapes[0].target_count, 1);
	assert_null(rig->shapes[0].first);
	assert_int_equal(rig->shapes[1].target_count, 0);
	assert_int_equal(rig->shapes[1].bone_count, 1);
	assert_int_equal(rig->clip_count, 3);
	for (size_t i = 0; i < 3; i++) {
		assert_string_equal(rig->clips[i].name, names[i]);
		assert_int_equal(rig->clips[i].channel_count, channels[i]);
		assert_int_equal(rig->clips[i].blend_count, blends[i]);
	}
	assert_float_equal(rig->clips[0].duration, 1, 1e-6);
	assert_float_equal(rig->clips[1].duration, 1, 1e-6);
	model_destroy(model);
}

static void all_of_it_moves(void **state)
{
	static const float walked[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1.5f, 0, 0, 1};
	static const float still[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
	const float s = sinf(.75f * GLM_PI_2f), c = cosf(.75f * GLM_PI_2f);
	struct model *model = load(SMOOTHIE_RIG, PLAN_UP_AUTO);
	struct pose pose;
	(void)state;
	assert_true(pose_init(&pose, &model->rig, model->meshes, NULL));
	pose_find(&pose, &model->rig, model->meshes, &model->rig.clips[0], 7.75);
	check(pose.transforms[0], walked, 16);
	check(pose.transforms[1], still, 16);
	check(pose.shapes[0].positions, (float[]){0, 0, 0, 1, 0, 0, 0, 1, .75f}, 9);
	/* Where its node is does not matter to an arm on bones. */
	check(pose.transforms[2], still, 16);
	check(pose.shapes[1].positions, (float[]){s, 1 - c, 0, s + c, 1 - c + s, 0, 0, 1, 0}, 9);
	pose_finish(&pose, &model->rig);
	model_destroy(model);
}

static void z_up_is_turned_as_a_whole(void **state)
{
	struct model *model = load(SMOOTHIE_RIG, PLAN_UP_Z);
	struct pose pose;
	(void)state;
	assert_true(pose_init(&pose, &model->rig, model->meshes, NULL));
	pose_find(&pose, &model->rig, model->meshes, &model->rig.clips[0], 0);
	check(&pose.transforms[0][4], (float[]){0, 0, -1, 0, 0, 1, 0}, 7);
	check(pose.shapes[1].positions, (float[]){0, 0, 0, 1, 0, 0, 0, 0, -1}, 9);
	pose_finish(&pose, &model->rig);
	model_destroy(model);
}

static void the_fox_runs(void **state)
{
	const char *path = SMOOTHIE_SHARED "/models/fox.glb";
	static const double durations[] = {3.4166667, .7083333, 1.1583333};
	(void)state;
	if (access(path, R_OK) != 0)
		skip();
	struct model *model = load(path, PLAN_UP_AUTO);
	struct pose pose;
	assert_int_equal(model->rig.clip_count, 3);
	assert_int_equal(model->rig.shape_count, 1);
	assert_true(pose_init(&pose, &model->rig, model->meshes, NULL));
	for (size_t clip = 0; clip < 3; clip++) {
		const struct clip *played = &model->rig.clips[clip];
		assert_float_equal(played->duration, durations[clip], 1e-4);
		for (double time = 0; time < played->duration; time += .1) {
			pose_find(&pose, &model->rig, model->meshes, played, time);
			for (size_t v = 0; v < 3 * model->meshes[0].vertex_count; v++)
				assert_true(fabsf(pose.shapes[0].positions[v]) < 200);
		}
	}
	pose_finish(&pose, &model->rig);
	model_destroy(model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_rig_is_that_of_the_file),
		cmocka_unit_test(all_of_it_moves),
		cmocka_unit_test(z_up_is_turned_as_a_whole),
		cmocka_unit_test(the_fox_runs),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
