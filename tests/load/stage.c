/* SPDX-License-Identifier: MIT */
#include "load/stage.h"
#include "folder.h"
#include "scene/scene.h"
#include <cglm/cglm.h>
#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void load(struct stage *stage, const char *source, const char *setting)
{
	struct sm_error error;
	if (!stage_load(stage, source, &setting, setting != NULL, &error))
		fail_msg("%s", error.text);
}

static void check_vector(const float got[3], float x, float y, float z)
{
	assert_float_equal(got[0], x, 1e-4);
	assert_float_equal(got[1], y, 1e-4);
	assert_float_equal(got[2], z, 1e-4);
}

static void study_scenes_are_as_the_truth_was_made(void **state)
{
	static const char *const names[] = {
		"cylinder", "boxes", "fence", "knot", "urchin", "debris"};
	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++) {
		char source[50];
		struct stage stage;
		snprintf(source, sizeof(source), "builtin:%s", names[i]);
		load(&stage, source, NULL);
		assert_int_equal(stage.output.width, 512);
		assert_int_equal(stage.output.height, 512);
		assert_float_equal(stage.camera.fov, 40, 0);
		assert_int_equal(sm_scene_light_count(stage.scene), 1);
		const struct sm_light_desc *light = &stage.scene->lights[0].desc;
		check_vector(light->position, 1.5f, 5.6f, 1.2f);
		check_vector(light->target, 0, .2f, 0);
		assert_float_equal(light->angle, 44, 0);
		assert_float_equal(light->radius, .171945, 1e-6);
		const struct object *ground = &stage.scene->objects[0];
		check_vector(ground->min, -30, 0, -30);
		check_vector(ground->max, 30, 0, 30);
		assert_true(ground->receives && !ground->casts);
		assert_true(stage.scene->objects[1].casts);
		stage_finish(&stage);
	}
}

static void settings_change_a_builtin_scene(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage, "builtin:cylinder", "light.radius=.573149");
	assert_float_equal(stage.scene->lights[0].desc.radius, .573149, 1e-6);
	stage_finish(&stage);
	load(&stage, "builtin:cylinder", "ground.show=no");
	assert_int_equal(sm_scene_object_count(stage.scene), 1);
	stage_finish(&stage);
	load(&stage, "builtin:knot", "output.size=640x360");
	assert_int_equal(stage.output.width, 640);
	assert_int_equal(stage.output.height, 360);
	stage_finish(&stage);
}

/* Where a point is in the picture, both from -1 to 1 inside; false if it lies behind. */
static bool project(const struct stage *stage, const float point[3], float at[2])
{
	const struct sm_camera *camera = &stage->camera;
	vec3 ahead, right, up, away;
	glm_vec3_sub((float *)camera->target, (float *)camera->eye, ahead);
	glm_vec3_normalize(ahead);
	glm_vec3_crossn(ahead, (float *)camera->up, right);
	glm_vec3_cross(right, ahead, up);
	glm_vec3_sub((float *)point, (float *)camera->eye, away);
	float depth = glm_vec3_dot(away, ahead), tangent = tanf(glm_rad(camera->fov) / 2);
	if (depth <= 0)
		return false;
	float aspect = (float)stage->output.width / (float)stage->output.height;
	at[0] = glm_vec3_dot(away, right) / (depth * tangent * aspect);
	at[1] = glm_vec3_dot(away, up) / (depth * tangent);
	return true;
}

/* All corners of the casters' box must be in the picture, fill a good part of it, and be lit by
 * the cone of the light, from above. */
static void check_framing(const struct stage *stage)
{
	float box[2][3], at[2] = {0}, min[2] = {1, 1}, max[2] = {-1, -1};
	const struct sm_light_desc *light = &stage->scene->lights[0].desc;
	vec3 axis;
	assert_true(sm_scene_get_bounds(stage->scene, true, box[0], box[1]));
	glm_vec3_sub((float *)light->target, (float *)light->position, axis);
	for (int i = 0; i < 8; i++) {
		vec3 corner = {box[i & 1][0], box[i >> 1 & 1][1], box[i >> 2][2]}, ray;
		assert_true(project(stage, corner, at));
		assert_true(fabsf(at[0]) <= 1 && fabsf(at[1]) <= 1);
		for (int k = 0; k < 2; k++) {
			min[k] = fminf(min[k], at[k]);
			max[k] = fmaxf(max[k], at[k]);
		}
		glm_vec3_sub(corner, (float *)light->position, ray);
		assert_true(glm_deg(glm_vec3_angle(axis, ray)) < light->angle / 2);
		assert_true(light->position[1] > corner[1]);
	}
	assert_true(max[0] - min[0] > .8f || max[1] - min[1] > .8f);
}

/* The ground must reach beyond the corners of the picture, so that no edge of it shows. */
static void check_ground(const struct stage *stage)
{
	const struct sm_camera *camera = &stage->camera;
	const struct object *ground = &stage->scene->objects[0];
	float tangent = tanf(glm_rad(camera->fov) / 2);
	float aspect = (float)stage->output.width / (float)stage->output.height;
	vec3 ahead, right, up;
	glm_vec3_sub((float *)camera->target, (float *)camera->eye, ahead);
	glm_vec3_normalize(ahead);
	glm_vec3_crossn(ahead, (float *)camera->up, right);
	glm_vec3_cross(right, ahead, up);
	for (int i = 0; i < 4; i++) {
		vec3 ray;
		glm_vec3_copy(ahead, ray);
		glm_vec3_muladds(right, (i & 1 ? 1 : -1) * tangent * aspect, ray);
		glm_vec3_muladds(up, (i & 2 ? 1 : -1) * tangent, ray);
		assert_true(ray[1] < 0);
		float reach = (ground->max[1] - camera->eye[1]) / ray[1];
		for (int axis = 0; axis < 3; axis += 2) {
			float at = camera->eye[axis] + reach * ray[axis];
			assert_true(at > ground->min[axis] && at < ground->max[axis]);
		}
	}
}

static void the_default_view_shows_solids_of_any_shape(void **state)
{
	static const char *const shapes[] = {"1", "1000", ".001", "1 5 1", "5 1 1", "1 1 5"};
	(void)state;
	for (size_t i = 0; i < sizeof(shapes) / sizeof(*shapes); i++) {
		char setting[50];
		struct stage stage;
		snprintf(setting, sizeof(setting), "object.scale=%s", shapes[i]);
		load(&stage, "builtin:cube", setting);
		check_framing(&stage);
		check_ground(&stage);
		assert_int_equal(sm_scene_object_count(stage.scene), 2);
		assert_float_equal(stage.scene->objects[0].max[1], 0, 1e-5);
		assert_int_equal(stage.output.width, 1280);
		assert_int_equal(stage.output.samples, 4);
		stage_finish(&stage);
	}
}

/* A turned cube touches the ground with its edge, not with the corner of some box around it. */
static void the_ground_is_at_the_lowest_point(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage, "builtin:torus", "object.rotation=45 0 0");
	/* Ring radius .35 and tube radius .15, about (0, .15, 0) turned by 45 degrees. */
	float lowest = .15f * sqrtf(.5f) - .35f * sqrtf(.5f) - .15f;
	assert_float_equal(stage.scene->objects[0].min[1], lowest, 2e-3);
	stage_finish(&stage);
}

static void shadow_settings_are_passed_on(void **state)
{
	struct stage stage;
	struct sm_error error;
	static const char *const settings[] = {"shadow.technique=smoothie", "shadow.map=2048",
		"shadow.width=.1", "shadow.falloff=sinusoid", "shadow.passes=2",
		"shadow.precision=fixed12", "output.samples=1"};
	(void)state;
	assert_true(stage_load(&stage, "builtin:cube", settings, 7, &error));
	assert_string_equal(stage.shadow.technique, "smoothie");
	assert_int_equal(stage.shadow.map_size, 2048);
	assert_float_equal(stage.shadow.width, .1, 1e-6);
	assert_int_equal(stage.shadow.falloff, SM_FALLOFF_SINUSOID);
	assert_int_equal(stage.shadow.passes, 2);
	assert_int_equal(stage.shadow.precision, SM_PRECISION_FIXED12);
	assert_int_equal(stage.output.samples, 1);
	stage_finish(&stage);
	load(&stage, "builtin:cube", NULL);
	assert_null(stage.shadow.technique);
	assert_int_equal(stage.shadow.map_size, 0);
	assert_float_equal(stage.shadow.width, 0, 0);
	assert_int_equal(stage.shadow.falloff, SM_FALLOFF_DEFAULT);
	assert_int_equal(stage.shadow.passes, 0);
	assert_int_equal(stage.shadow.precision, SM_PRECISION_DEFAULT);
	assert_int_equal(stage.shadow.sampling, SM_SAMPLING_DEFAULT);
	stage_finish(&stage);
	load(&stage, "builtin:cube", "shadow.sampling=sparse");
	assert_int_equal(stage.shadow.sampling, SM_SAMPLING_SPARSE);
	stage_finish(&stage);
}

static void a_scene_file_becomes_a_scene(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage,
		folder_write_text("scene.ini",
			"[object ball]\nmodel = builtin:sphere\nposition = 1 2 3\nscale = 2\n"
			"color = 1 .5 .25\ncasts = no\n"
			"[object box]\nmodel = builtin:cube\nreceives = no\n"
			"[light sun]\ntype = directional\nposition = 0 9 0\ntarget = 0 0 0\n"
			"intensity = .5\n"
			"[light lamp]\nradius = .5\n"
			"[ground]\nheight = -1\nsize = 8\n"
			"[environment]\nbackground = 1 0 0\n"
			"[camera]\neye = 0 0 9\ntarget = 0 0 0\nnear = 1\nfar = 20\n"),
		NULL);
	const struct sm_scene *scene = stage.scene;
	assert_int_equal(scene->object_count, 3);
	assert_int_equal(scene->light_count, 2);
	check_vector(scene->objects[0].min, -4, -1, -4);
	assert_string_equal(scene->objects[1].name, "ball");
	check_vector(scene->objects[1].min, 0, 2, 2);
	check_vector(scene->objects[1].max, 2, 4, 4);
	check_vector(scene->objects[1].base_color, 1, .5f, .25f);
	assert_false(scene->objects[1].casts);
	assert_false(scene->objects[2].receives);
	assert_int_equal(scene->lights[0].desc.type, SM_LIGHT_DIRECTIONAL);
	assert_float_equal(scene->lights[0].desc.intensity, .5, 0);
	assert_float_equal(scene->lights[0].desc.radius, .36, 1e-5); /* .04 of 9 */
	assert_float_equal(scene->lights[1].desc.radius, .5, 0);
	check_vector(scene->environment.background, 1, 0, 0);
	check_vector(stage.camera.eye, 0, 0, 9);
	assert_float_equal(stage.camera.far, 20, 0);
	stage_finish(&stage);
}

/* Rotation about x, then y, then z; a point on the y axis goes to z, then x, then y. */
static void rotations_follow_one_another(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage, "builtin:cone", "object.rotation=90 90 90");
	vec3 tip;
	mat4 *transform = &stage.scene->objects[1].transform;
	glm_mat4_mulv3(*transform, (vec3){0, 1, 0}, 1, tip);
	check_vector(tip, 0, 1, 0);
	stage_finish(&stage);
}

/* 80 cd at 4 units give 5, 20 cd at 2 give 5 as well, 2.5 lx half of that: scaled to 1, 1, .5. */
static void lights_of_a_model_are_scaled_to_one(void **state)
{
	struct stage stage;
	(void)state;
	const char *gltf =
		"{\"asset\":{\"version\":\"2.0\"},\"scene\":0,"
		"\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
		"AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
		"\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
		"\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
		"\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"
		"\"extensionsUsed\":[\"KHR_lights_punctual\"],"
		"\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\","
		"\"intensity\":80,\"spot\":{}},{\"type\":\"point\",\"intensity\":20},"
		"{\"type\":\"directional\",\"intensity\":2.5}]}},"
		"\"scenes\":[{\"nodes\":[0,1,2,3]}],"
		"\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
		"\"nodes\":[{\"mesh\":0,\"translation\":[-0.5,-0.5,0]},"
		"{\"translation\":[0,0,4],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
		"{\"translation\":[0,2,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},"
		"{\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}}]}";
	const char *path = folder_write_text("lights.gltf", gltf);
	struct sm_error error;
	if (!stage_load(&stage, path, NULL, 0, &error)) {
		/* A build without assimp says so. */
		assert_non_null(strstr(error.text, "assimp"));
		skip();
	}
	const struct light *lights = stage.scene->lights;
	assert_int_equal(stage.scene->light_count, 3);
	assert_float_equal(lights[0].desc.intensity, 1, 1e-4);
	check_vector(lights[0].desc.target, 0, 0, 0);
	assert_float_equal(lights[0].desc.radius, .16, 1e-4);
	assert_int_equal(lights[1].desc.type, SM_LIGHT_SPOT);
	check_vector(lights[1].desc.target, 0, 0, 0);
	assert_float_equal(lights[1].desc.intensity, 1, 1e-4);
	assert_float_equal(lights[2].desc.intensity, .5, 1e-4);
	check_vector(lights[2].desc.target, 0, 0, 0);
	stage_finish(&stage);
}

static void scenes_stand_still_by_default(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage, "builtin:primitives", NULL);
	struct sm_camera camera = stage.camera;
	assert_false(stage_moves(&stage));
	assert_true(stage_set_time(&stage, 1.5, NULL));
	assert_memory_equal(&stage.camera, &camera, sizeof(camera));
	stage_finish(&stage);
}

/* A whole turn later, and at time 0 from anywhere, each bit is that of the scene at rest. */
static void the_camera_goes_round_its_target(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage, "builtin:cube", NULL);
	struct sm_camera rest = stage.camera;
	stage_finish(&stage);
	load(&stage, "builtin:cube", "motion.period=-.4");
	assert_true(stage_moves(&stage));
	assert_int_equal(stage.motion.light_count, 0);
	assert_memory_equal(&stage.camera, &rest, sizeof(rest));
	assert_true(stage_set_time(&stage, .1, NULL));
	check_vector(stage.camera.eye, rest.target[0] - (rest.eye[2] - rest.target[2]), rest.eye[1],
		rest.target[2] + (rest.eye[0] - rest.target[0]));
	check_vector(stage.camera.up, 0, 1, 0);
	for (int turn = 3; turn >= 0; turn--) {
		assert_true(stage_set_time(&stage, turn * .4 + .3, NULL));
		assert_true(stage_set_time(&stage, turn / 2 * .8, NULL));
		assert_memory_equal(&stage.camera, &rest, sizeof(rest));
	}
	stage_finish(&stage);
}

static const char two_lights[] = "[object a]\nmodel = builtin:cube\n"
				 "[light sun]\ntype = directional\nposition = 0 9 1\n"
				 "target = 0 0 0\n"
				 "[light lamp]\nposition = 3 4 2\ntarget = 1 0 2\n"
				 "[motion]\nturns = light\nperiod = 8\n";

static void a_light_goes_round_its_target(void **state)
{
	struct stage stage;
	(void)state;
	const char *path = folder_write_text("lights.ini", two_lights);
	load(&stage, path, NULL);
	struct light *lights = stage.scene->lights;
	struct sm_camera camera = stage.camera;
	struct sm_light_desc sun = lights[0].desc;
	assert_int_equal(stage.motion.light_count, 1);
	assert_int_equal(stage.motion.lights[0].light, 0);
	assert_true(stage_set_time(&stage, 2, NULL));
	check_vector(lights[0].desc.position, 1, 9, 0);
	check_vector(lights[1].desc.position, 3, 4, 2);
	assert_true(stage_set_time(&stage, 16, NULL));
	assert_memory_equal(lights[0].desc.position, sun.position, sizeof(sun.position));
	assert_int_equal(lights[0].desc.type, SM_LIGHT_DIRECTIONAL);
	assert_float_equal(lights[0].desc.radius, sun.radius, 0);
	assert_memory_equal(&stage.camera, &camera, sizeof(camera));
	stage_finish(&stage);

	load(&stage, path, "motion.light=lamp");
	lights = stage.scene->lights;
	assert_int_equal(stage.motion.lights[0].light, 1);
	assert_true(stage_set_time(&stage, 2, NULL));
	check_vector(lights[0].desc.position, 0, 9, 1);
	check_vector(lights[1].desc.position, 1, 4, 0);
	check_vector(lights[1].desc.target, 1, 0, 2);
	stage_finish(&stage);
}

static void check_place(const struct stage *stage, size_t object, const float expected[16])
{
	const struct object *placed = &stage->scene->objects[object];
	for (int i = 0; i < 16; i++)
		assert_float_equal(placed->transform[i / 4][i % 4], expected[i], 1e-5);
}

/* A cube that stands at (3, 0, 0), turned to the left by 90 degrees about y; behind the ground. */
static void objects_spin_travel_and_orbit(void **state)
{
	static const struct {
		const char *motion;
		double seconds;
		float place[16];
	} cases[] = {
		{"spin = 0 30 0", 3, {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 3, 0, 0, 1}},
		{"spin = 0 -90 0", 401, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}},
		{"travel = 0 2 0\ntravel-time = 8", 2,
			{0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 3, 1, 0, 1}},
		{"orbit = 4", 1, {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, -3, 1}},
		{"orbit = -4\ncenter = 2 0 1", 1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 2, 1}},
		{"orbit = 4\ntravel = 2 0 0", 1,
			{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, -4, 1}},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		char text[300];
		struct stage stage;
		snprintf(text, sizeof(text),
			"[object a]\nmodel = builtin:cube\nposition = 3 0 0\n"
			"rotation = 0 90 0\n%s\n",
			cases[i].motion);
		load(&stage, folder_write_text("motion.ini", text), NULL);
		struct object rest = stage.scene->objects[1];
		assert_true(stage_moves(&stage));
		assert_true(stage_set_time(&stage, cases[i].seconds, NULL));
		check_place(&stage, 1, cases[i].place);
		assert_true(stage_set_time(&stage, 0, NULL));
		assert_memory_equal(
			stage.scene->objects[1].transform, rest.transform, sizeof(rest.transform));
		stage_finish(&stage);
	}
}

static void cameras_and_lights_have_paths_of_their_own(void **state)
{
	struct stage stage;
	(void)state;
	load(&stage,
		folder_write_text("paths.ini",
			"[object a]\nmodel = builtin:cube\n[camera]\neye = 0 1 5\n"
			"target = 0 0 0\norbit = 4\n[light still]\nposition = 1 4 0\n"
			"[light a]\nposition = 0 3 1\ntarget = 0 0 0\ntravel = 2 0 0\n"
			"[light b]\nposition = 0 3 1\ntarget = 0 0 0\norbit = -4\n"),
		NULL);
	assert_int_equal(stage.motion.light_count, 2);
	assert_true(stage_set_time(&stage, 1, NULL));
	check_vector(stage.camera.eye, 5, 1, 0);
	check_vector(stage.scene->lights[0].desc.position, 1, 4, 0);
	check_vector(stage.scene->lights[1].desc.position, 1, 3, 1);
	check_vector(stage.scene->lights[2].desc.position, -1, 3, 0);
	stage_finish(&stage);
}

/* A unit in the last place of 1e6 is 1/16. */
static void a_light_that_rounding_puts_on_its_target_is_an_error(void **state)
{
	struct stage stage;
	struct sm_error error = {0};
	(void)state;
	load(&stage,
		folder_write_text("far.ini", "[object a]\nmodel = builtin:cube\n"
					     "[light a]\nposition = 1e6 0 1.001\ntarget = 1e6 0 1\n"
					     "[motion]\nturns = light\nperiod = 4\n"),
		NULL);
	assert_false(stage_set_time(&stage, 1, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_true(stage_set_time(&stage, 0, NULL));
	stage_finish(&stage);
}

static void scenes_that_make_no_sense_are_refused(void **state)
{
	static const struct {
		const char *text, *error;
	} cases[] = {
		{"[camera]\nfov = 40\n", ": no [object NAME], so nothing to draw"},
		{"[object a]\ncasts = no\n", ": [object a] has no model"},
		{"[object a]\nmodel = builtin:cube\n[camera]\neye = 1 1 1\ntarget = 1 1 1\n",
			": [camera] eye and target are the same point"},
		{"[object a]\nmodel = builtin:cube\n[camera]\neye = 0 3 0\ntarget = 0 0 0\n",
			": [camera] up is along the view"},
		{"[object a]\nmodel = builtin:cube\n[camera]\nnear = 1\n",
			": [camera] near and far go together"},
		{"[object a]\nmodel = builtin:cube\n[camera]\nnear = 2\nfar = 2\n",
			": [camera] near is not less than far"},
		{"[object a]\nmodel = builtin:cube\n[light a]\n[motion]\nlight = a\nperiod = 4\n",
			": [motion] light is given, but turns is camera"},
		{"[object a]\nmodel = builtin:cube\n[camera]\norbit = 3\n[motion]\nperiod = 4\n",
			": [motion] turns what has an orbit of its own"},
		{"[object a]\nmodel = builtin:cube\n[light sun]\n[light lamp]\n"
		 "[motion]\nturns = light\nlight = lmap\n",
			": [motion] no light is called \"lmap\"; known: sun, lamp"},
		{"[object a]\nmodel = builtin:cube\n[motion]\nturns = light\nlight = sun\n",
			": [motion] no light is called \"sun\"; known: key"},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		const char *path = folder_write_text("senseless.ini", cases[i].text);
		char expected[700];
		struct stage stage;
		struct sm_error error = {.text = "taken"};
		snprintf(expected, sizeof(expected), "%s%s", path, cases[i].error);
		bool taken = stage_load(&stage, path, NULL, 0, &error);
		assert_string_equal(error.text, expected);
		assert_false(taken);
		assert_null(stage.scene);
		stage_finish(&stage);
	}
}

/* All but the presets of a conformance run. */
static void the_configs_load(void **state)
{
	glob_t found;
	(void)state;
	assert_int_equal(glob(SMOOTHIE_CONFIGS "/*.ini", 0, NULL, &found), 0);
	for (size_t i = 0; i < found.gl_pathc; i++) {
		struct stage stage;
		if (strstr(found.gl_pathv[i], "/ci-") != NULL)
			continue;
		load(&stage, found.gl_pathv[i], NULL);
		assert_true(sm_scene_object_count(stage.scene) > 1);
		stage_finish(&stage);
	}
	globfree(&found);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(study_scenes_are_as_the_truth_was_made),
		cmocka_unit_test(settings_change_a_builtin_scene),
		cmocka_unit_test(the_default_view_shows_solids_of_any_shape),
		cmocka_unit_test(the_ground_is_at_the_lowest_point),
		cmocka_unit_test(shadow_settings_are_passed_on),
		cmocka_unit_test(a_scene_file_becomes_a_scene),
		cmocka_unit_test(rotations_follow_one_another),
		cmocka_unit_test(lights_of_a_model_are_scaled_to_one),
		cmocka_unit_test(scenes_stand_still_by_default),
		cmocka_unit_test(the_camera_goes_round_its_target),
		cmocka_unit_test(a_light_goes_round_its_target),
		cmocka_unit_test(objects_spin_travel_and_orbit),
		cmocka_unit_test(cameras_and_lights_have_paths_of_their_own),
		cmocka_unit_test(a_light_that_rounding_puts_on_its_target_is_an_error),
		cmocka_unit_test(scenes_that_make_no_sense_are_refused),
		cmocka_unit_test(the_configs_load),
	};
	return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
