/* SPDX-License-Identifier: MIT */
/* What moves in rig.gltf: a flat triangle that walks, a sail that is blown, and an arm on a bone at
 * (0, 1, 0). All are the triangle 0, x, y; "Go" takes a second. */
#include "base/log.h"
#include "folder.h"
#include "load/gltf.h"
#include "model_file.h"
#include <cglm/cglm.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static void the_rig_is_that_of_the_file(void **state)
{
	static const char *const names[] = {"Go", "Wave", "Broken"};
	static const size_t channels[] = {2, 1, 0}, blends[] = {1, 0, 0};
	struct model *model = load_model(SMOOTHIE_RIG, PLAN_UP_AUTO);
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
	struct model *model = load_model(SMOOTHIE_RIG, PLAN_UP_AUTO);
	struct pose pose;
	(void)state;
	assert_true(pose_init(&pose, &model->rig, model->meshes, NULL));
	pose_find(&pose, &model->rig, model->meshes, &model->rig.clips[0], 7.75);
	check_floats(pose.transforms[0], walked, 16);
	check_floats(pose.transforms[1], still, 16);
	check_floats(pose.shapes[0].positions, (float[]){0, 0, 0, 1, 0, 0, 0, 1, .75f}, 9);
	/* Where its node is does not matter to an arm on bones. */
	check_floats(pose.transforms[2], still, 16);
	check_floats(
		pose.shapes[1].positions, (float[]){s, 1 - c, 0, s + c, 1 - c + s, 0, 0, 1, 0}, 9);
	pose_finish(&pose, &model->rig);
	model_destroy(model);
}

static void z_up_is_turned_as_a_whole(void **state)
{
	struct model *model = load_model(SMOOTHIE_RIG, PLAN_UP_Z);
	struct pose pose;
	(void)state;
	assert_true(pose_init(&pose, &model->rig, model->meshes, NULL));
	pose_find(&pose, &model->rig, model->meshes, &model->rig.clips[0], 0);
	check_floats(&pose.transforms[0][4], (float[]){0, 0, -1, 0, 0, 1, 0}, 7);
	check_floats(pose.shapes[1].positions, (float[]){0, 0, 0, 1, 0, 0, 0, 0, -1}, 9);
	pose_finish(&pose, &model->rig);
	model_destroy(model);
}

static void look_for_curves(void *data, enum sm_log_level level, const char *line)
{
	bool *found = data;
	*found = *found || (level == SM_LOG_WARNING && strstr(line, "straight lines") != NULL);
}

/* A copy of rig.gltf in which the first sampler says how it goes from key to key. */
static const char *write_rig(const char *interpolation)
{
	static const char sampler[] = "\"output\": 3";
	char text[20000], changed[20100];
	FILE *file = fopen(SMOOTHIE_RIG, "r");
	assert_non_null(file);
	text[fread(text, 1, sizeof(text) - 1, file)] = '\0';
	fclose(file);
	const char *at = strstr(text, sampler);
	assert_non_null(at);
	snprintf(changed, sizeof(changed), "%.*s%s, \"interpolation\" :\n%s%s", (int)(at - text),
		text, sampler, interpolation, at + strlen(sampler));
	return folder_write_text("curves.gltf", changed);
}

static void check_curves(const char *interpolation, bool expected)
{
	bool found = false;
	const char *path = write_rig(interpolation);
	log_set_sink(look_for_curves, &found);
	model_destroy(load_model(path, PLAN_UP_AUTO));
	log_set_sink(NULL, NULL);
	assert_int_equal(found, expected);
	assert_int_equal(gltf_has_curves(path), expected);
}

static void curves_between_keys_are_told(void **state)
{
	(void)state;
	check_curves("\"LINEAR\"", false);
	check_curves("\"STEP\"", true);
	check_curves("\"CUBICSPLINE\"", true);
}

/* The first chunk alone holds JSON. */
static void a_binary_file_is_looked_through(void **state)
{
	static const char json[] = "{\"interpolation\":\"STEP\"}";
	char file[20 + sizeof(json)] = "glTF\2\0\0\0\0\0\0\0";
	(void)state;
	memcpy(file + 16, "JSON", 4);
	memcpy(file + 20, json, sizeof(json));
	file[12] = sizeof(json);
	assert_true(gltf_has_curves(folder_write("steps.glb", file, sizeof(file))));
	file[12] = 10;
	assert_false(gltf_has_curves(folder_write("steps.glb", file, sizeof(file))));
	memset(file + 12, -1, 4);
	assert_false(gltf_has_curves(folder_write("steps.glb", file, sizeof(file))));
	assert_false(gltf_has_curves(folder_write("steps.glb", file, 12)));
	assert_false(gltf_has_curves(folder_path("missing.glb")));
}

static void the_fox_runs(void **state)
{
	const char *path = SMOOTHIE_SHARED "/models/fox.glb";
	static const double durations[] = {3.4166667, .7083333, 1.1583333};
	(void)state;
	if (access(path, R_OK) != 0)
		skip();
	struct model *model = load_model(path, PLAN_UP_AUTO);
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
		cmocka_unit_test(curves_between_keys_are_told),
		cmocka_unit_test(a_binary_file_is_looked_through),
		cmocka_unit_test(the_fox_runs),
	};
	return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
