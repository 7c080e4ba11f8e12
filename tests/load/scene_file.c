/* SPDX-License-Identifier: MIT */
#include "load/scene_file.h"
#include "folder.h"
#include "load/setting.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void every_default_can_be_parsed(void **state)
{
	(void)state;
	struct plan plan;
	assert_true(plan_init(&plan, NULL));
	assert_non_null(plan_add_light(&plan, "a", NULL));
	assert_non_null(plan_add_object(&plan, "b", NULL));
	assert_float_equal(plan.lights[0].desc.intensity, 1, 0);
	assert_true(plan.objects[0].casts);
	assert_true(isnan(plan.camera.desc.eye[0]));
	plan_finish(&plan);
}

/* Reads one key of the first section of its kind as up to three numbers. */
static void get_numbers(struct plan *plan, enum section section, const char *name, float values[3])
{
	const struct key *key = key_at(key_find(section, name));
	const char *field = (char *)plan_get(plan, section, 0).data + key->offset;
	uint32_t counts[2];
	switch (key->type) {
	case KEY_NUMBER:
		memcpy(values, field, sizeof(float));
		break;
	case KEY_SIZE:
		memcpy(counts, field, sizeof(counts));
		values[0] = (float)counts[0];
		values[1] = (float)counts[1];
		break;
	case KEY_COUNT:
	case KEY_WORD:
		memcpy(counts, field, sizeof(*counts));
		values[0] = (float)counts[0];
		break;
	case KEY_PERIOD:
		values[0] = (float)*(const double *)field;
		break;
	case KEY_YES:
		values[0] = *(const bool *)field;
		break;
	default:
		memcpy(values, field, 3 * sizeof(float));
	}
}

static void good_values_are_taken(void **state)
{
	static const struct {
		const char *text;
		enum section section;
		const char *key;
		float values[3];
	} cases[] = {
		{"[camera]\nfov = 40\n", SECTION_CAMERA, "fov", {40}},
		{"[camera]\nfov=40", SECTION_CAMERA, "fov", {40}},
		{"[camera]\nfov : 40", SECTION_CAMERA, "fov", {40}},
		{"[camera]\r\nfov = 40\r\n", SECTION_CAMERA, "fov", {40}},
		{"\xef\xbb\xbf[camera]\nfov = 40\n", SECTION_CAMERA, "fov", {40}},
		{"  [ camera ] ; view\n", SECTION_CAMERA, "up", {NAN, NAN, NAN}},
		{"[camera]\n\tfov = 40 ; wide\n# fov = 50\n;fov = 60\n", SECTION_CAMERA, "fov",
			{40}},
		{"[camera]\n eye = 1 2 3\n  fov = 40\n", SECTION_CAMERA, "fov", {40}},
		{"[camera]\neye = 1 -2.5 3e2\n", SECTION_CAMERA, "eye", {1, -2.5f, 300}},
		{"[camera]\neye = 1,2 ,\t3\n", SECTION_CAMERA, "eye", {1, 2, 3}},
		{"[camera]\n[ground]\n[camera]\nfov = 40\n", SECTION_CAMERA, "fov", {40}},
		{"[light a]\ntype = directional\n", SECTION_LIGHT, "type", {SM_LIGHT_DIRECTIONAL}},
		{"[light a]\nradius = 0\n", SECTION_LIGHT, "radius", {0}},
		{"[light a]\ncolor = .25 .5 1\n", SECTION_LIGHT, "color", {.25f, .5f, 1}},
		{"[light a]\ncolor = #ff8000\n", SECTION_LIGHT, "color", {1, .215861f, 0}},
		{"[light a b]\n[light c]\n[light a b]\nradius = 2\n", SECTION_LIGHT, "radius", {2}},
		{"[object a]\nscale = 2\n", SECTION_OBJECT, "scale", {2, 2, 2}},
		{"[object a]\nscale = 2 3 4\n", SECTION_OBJECT, "scale", {2, 3, 4}},
		{"[object a]\ncasts = no\n", SECTION_OBJECT, "casts", {0}},
		{"[object a]\nup = z\n", SECTION_OBJECT, "up", {PLAN_UP_Z}},
		{"[ground]\nshow = no\n", SECTION_GROUND, "show", {PLAN_SHOW_NO}},
		{"[motion]\n", SECTION_MOTION, "period", {0}},
		{"[motion]\nperiod = -12.5\n", SECTION_MOTION, "period", {-12.5f}},
		{"[motion]\nperiod = .1\n", SECTION_MOTION, "period", {.1f}},
		{"[motion]\nperiod = -1e6\n", SECTION_MOTION, "period", {-1e6f}},
		{"[motion]\nperiod = 0\n", SECTION_MOTION, "period", {0}},
		{"[motion]\nturns = light\n", SECTION_MOTION, "turns", {PLAN_TURNS_LIGHT}},
		{"[shadow]\nmap = 2048\n", SECTION_SHADOW, "map", {2048}},
		{"[shadow]\nfalloff = sinusoid\n", SECTION_SHADOW, "falloff",
			{SM_FALLOFF_SINUSOID}},
		{"[shadow]\nprecision = half\n", SECTION_SHADOW, "precision", {SM_PRECISION_HALF}},
		{"[output]\nsize = 640x480\n", SECTION_OUTPUT, "size", {640, 480}},
		{"[output]\nsamples = 1\n", SECTION_OUTPUT, "samples", {PLAN_SAMPLES_1}},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		struct plan plan;
		struct sm_error error;
		float got[3] = {0};
		assert_true(plan_init(&plan, NULL));
		if (!scene_file_read(folder_write_text("good.ini", cases[i].text), &plan, &error))
			fail_msg("case %zu: %s", i, error.text);
		get_numbers(&plan, cases[i].section, cases[i].key, got);
		for (int k = 0; k < 3; k++)
			if (isnan(cases[i].values[k]) ? !isnan(got[k])
						      : fabsf(got[k] - cases[i].values[k]) > 1e-5f)
				fail_msg("case %zu: %g instead of %g", i, (double)got[k],
					(double)cases[i].values[k]);
		plan_finish(&plan);
	}
}

static void bad_input_is_named_with_its_place(void **state)
{
	static const char very_long[] =
		"[camera]\nfov = 40 00000000000000000000000000000000000000000000000000000000000000"
		"0000000000000000000000000000000000000000000000000000000000000000000000000000000000"
		"000000000000000000000000000000000000000000000000000000000000000000000000000000000"
		"0";
	static const struct {
		const char *text, *error; /* behind the path */
	} cases[] = {
		{"[lihgt a]\n",
			":1: no section [lihgt]; there are [camera], [light NAME], [object NAME], "
			"[ground], [environment], [motion], [shadow], [output]"},
		{"\n[light]\n", ":2: [light] needs a name, as in [light NAME]"},
		{"[camera x]\n", ":1: [camera] takes no name, but has \"x\""},
		{"[camera\n", ":1: a ] is missing after [camera"},
		{"[camera] fov = 3\n", ":1: nothing may follow the heading, but \"fov = 3\" does"},
		{"[camera]\nzoom = 1\n",
			":2: [camera] has no key \"zoom\"; it has eye, target, up, fov, near, "
			"far, orbit, travel, travel-time"},
		{"fov = 3\n", ":1: fov stands before the first [section]"},
		{"[camera]\n\nfov\n", ":3: neither a [section] nor key = value"},
		{"[camera]\nfov\nzoom = 1\n", ":2: neither a [section] nor key = value"},
		{"[camera]\nfov = 40\nfov = 41\n", ":3: fov is given twice"},
		{"[light a]\nradius = 1\n[light b]\n[light a]\nradius = 2\n",
			":5: radius is given twice"},
		{"[camera]\nfov = abc\n",
			":2: fov cannot be \"abc\"; it takes a number from 1 to 170"},
		{"[camera]\nfov =\n", ":2: fov cannot be \"\"; it takes a number from 1 to 170"},
		{"[camera]\r\n\r\nfov = 40x\r\n",
			":3: fov cannot be \"40x\"; it takes a number from 1 to 170"},
		{"[camera]\nfov = 171\n",
			":2: fov cannot be \"171\"; it takes a number from 1 to 170"},
		{"[camera]\nfov = nan\n",
			":2: fov cannot be \"nan\"; it takes a number from 1 to 170"},
		{"[camera]\nup = 0 1\n", ":2: up cannot be \"0 1\"; it takes three numbers from "
					 "-1000000 to 1000000"},
		{"[camera]\nup = 0 1 0 0\n", ":2: up cannot be \"0 1 0 0\"; it takes three numbers "
					     "from -1000000 to 1000000"},
		{"[camera]\nup = 0,,1 0\n", ":2: up cannot be \"0,,1 0\"; it takes three numbers "
					    "from -1000000 to 1000000"},
		{"[object a]\nscale = 1 2\n", ":2: scale cannot be \"1 2\"; it takes one or three "
					      "numbers from 1e-06 to 1000000"},
		{"[light a]\ncolor = #12345g\n", ":2: color cannot be \"#12345g\"; it takes three "
						 "numbers from 0 to 1, or #rrggbb"},
		{"[light a]\ncolor = #123\n", ":2: color cannot be \"#123\"; it takes three "
					      "numbers from 0 to 1, or #rrggbb"},
		{"[light a]\ntype = sun\n", ":2: type cannot be \"sun\"; it takes spot or "
					    "directional"},
		{"[ground]\nshow = ye\n", ":2: show cannot be \"ye\"; it takes auto, yes or no"},
		{"[object a]\ncasts = 1\n", ":2: casts cannot be \"1\"; it takes yes or no"},
		{"[object a]\nmodel =\n", ":2: model cannot be \"\"; it takes text"},
		{"[motion a]\n", ":1: [motion] takes no name, but has \"a\""},
		{"[motion]\nspeed = 1\n",
			":2: [motion] has no key \"speed\"; it has turns, light, period"},
		{"[motion]\nturns = object\n",
			":2: turns cannot be \"object\"; it takes camera or light"},
		{"[motion]\nperiod = .0999\n", ":2: period cannot be \".0999\"; it takes 0, or a "
					       "number from 0.1 to 1000000 with either sign"},
		{"[motion]\nperiod = -1000001\n",
			":2: period cannot be \"-1000001\"; it takes 0, or a "
			"number from 0.1 to 1000000 with either sign"},
		{"[motion]\nperiod = nan\n", ":2: period cannot be \"nan\"; it takes 0, or a "
					     "number from 0.1 to 1000000 with either sign"},
		{"[motion]\nperiod =\n", ":2: period cannot be \"\"; it takes 0, or a "
					 "number from 0.1 to 1000000 with either sign"},
		{"[motion]\nperiod = 4 s\n", ":2: period cannot be \"4 s\"; it takes 0, or a "
					     "number from 0.1 to 1000000 with either sign"},
		{"[shadow]\nmap = 1024.5\n",
			":2: map cannot be \"1024.5\"; it takes a whole number from 1 to 16384"},
		{"[shadow]\nmap = 4294968320\n", ":2: map cannot be \"4294968320\"; it takes a "
						 "whole number from 1 to 16384"},
		{"[output]\nsize = 640x\n", ":2: size cannot be \"640x\"; it takes WIDTHxHEIGHT, "
					    "each from 1 to 16384"},
		{"[output]\nsize = 640x0\n", ":2: size cannot be \"640x0\"; it takes WIDTHxHEIGHT, "
					     "each from 1 to 16384"},
		{"[output]\nsamples = 2\n", ":2: samples cannot be \"2\"; it takes 1 or 4"},
		{very_long, ":2: the line is longer than 197 bytes"},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		const char *path = folder_write_text("bad.ini", cases[i].text);
		char expected[600];
		snprintf(expected, sizeof(expected), "%s%s", path, cases[i].error);
		struct plan plan;
		struct sm_error error = {.text = "taken"};
		assert_true(plan_init(&plan, NULL));
		bool taken = scene_file_read(path, &plan, &error);
		assert_string_equal(error.text, expected);
		assert_false(taken);
		assert_int_equal(error.status, SM_ERROR_INPUT);
		plan_finish(&plan);
	}
}

static void check_refused(const char *path, const char *cause)
{
	struct plan plan;
	struct sm_error error;
	char expected[600];
	snprintf(expected, sizeof(expected), "%s: %s", path, cause);
	assert_true(plan_init(&plan, NULL));
	assert_false(scene_file_read(path, &plan, &error));
	assert_string_equal(error.text, expected);
	plan_finish(&plan);
}

static void files_that_are_no_text_are_refused(void **state)
{
	(void)state;
	check_refused(folder_path("missing.ini"), "No such file or directory");
	check_refused("/tmp", "not a regular file");
	check_refused(folder_write("binary.ini", "[camera]\0\1\2", 11), "not a text file");
	size_t size = (1 << 20) + 1;
	char *huge = malloc(size);
	assert_non_null(huge);
	memset(huge, '\n', size);
	check_refused(folder_write("huge.ini", huge, size),
		"larger than 1 MiB, too large for a scene file");
	struct plan plan;
	assert_true(plan_init(&plan, NULL));
	assert_true(scene_file_read(folder_write("full.ini", huge, size - 1), &plan, NULL));
	plan_finish(&plan);
	free(huge);
}

static void long_comments_are_fine(void **state)
{
	(void)state;
	char text[1000];
	memset(text, ';', sizeof(text));
	memcpy(text + sizeof(text) - 20, "\n[camera]\nfov = 40\n\0", 20);
	struct plan plan;
	assert_true(plan_init(&plan, NULL));
	assert_true(scene_file_read(folder_write_text("comment.ini", text), &plan, NULL));
	assert_float_equal(plan.camera.desc.fov, 40, 0);
	plan_finish(&plan);
}

static void models_are_looked_for_beside_the_file(void **state)
{
	static const struct {
		const char *model;
		bool is_beside;
	} cases[] = {{"a.glb", true}, {"../b/c.obj", true}, {"/abs/d.ply", false},
		{"builtin:cube", false}};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		char text[100], expected[600];
		snprintf(text, sizeof(text), "[object a]\nmodel = %s\n", cases[i].model);
		const char *path = folder_write_text("m.ini", text);
		snprintf(expected, sizeof(expected), "%.*s%s",
			cases[i].is_beside ? (int)(strlen(path) - strlen("m.ini")) : 0, path,
			cases[i].model);
		struct plan plan;
		assert_true(plan_init(&plan, NULL));
		assert_true(scene_file_read(path, &plan, NULL));
		assert_string_equal(plan.objects[0].model, expected);
		plan_finish(&plan);
	}
}

/* A plan with lights key and fill, and an object. */
static void settings_setup(struct plan *plan)
{
	assert_true(plan_init(plan, NULL));
	assert_non_null(plan_add_light(plan, "key", NULL));
	assert_non_null(plan_add_light(plan, "fill", NULL));
	assert_non_null(plan_add_object(plan, "ring.v2", NULL));
}

static void settings_reach_one_or_all(void **state)
{
	static const char *const settings[] = {"camera.fov=30", "camera.fov=31", "light.radius=.5",
		"light fill.radius=.25", "object ring.v2.casts=no", "object.color=#ffffff"};
	struct plan plan;
	(void)state;
	settings_setup(&plan);
	assert_true(settings_apply(&plan, settings, 6, false, NULL));
	assert_float_equal(plan.camera.desc.fov, 31, 0);
	assert_false(plan.objects[0].casts);
	assert_float_equal(plan.objects[0].color[1], 1, 0);
	assert_true(isnan(plan.lights[0].desc.radius));
	assert_true(settings_apply(&plan, settings, 6, true, NULL));
	assert_float_equal(plan.lights[0].desc.radius, .5, 0);
	assert_float_equal(plan.lights[1].desc.radius, .25, 0);
	plan_finish(&plan);
}

static void bad_settings_are_named(void **state)
{
	static const struct {
		const char *setting, *error;
	} cases[] = {
		{"fov=3", "--set fov: not of the form section.key=value or \"section "
			  "NAME.key=value\""},
		{"camera.fov", "--set camera.fov: not of the form section.key=value or \"section "
			       "NAME.key=value\""},
		{"cam.fov=3", "--set cam.fov: no section \"cam\"; there are camera, light, object, "
			      "ground, environment, motion, shadow, output"},
		{"camera x.fov=3", "--set camera x.fov: camera takes no name"},
		{"camera.zoom=3", "--set camera.zoom: [camera] has no key \"zoom\"; it has eye, "
				  "target, up, fov, near, far, orbit, travel, travel-time"},
		{"camera.fov=0", "--set camera.fov: fov cannot be \"0\"; it takes a number from 1 "
				 "to 170"},
		{"light rim.radius=1", "--set light rim.radius: no such light; known: key, fill"},
		{"light.radius=-1",
			"--set light.radius: radius cannot be \"-1\"; it takes a number from 0 to "
			"1000000"},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		struct plan plan;
		struct sm_error error = {.text = "taken"};
		settings_setup(&plan);
		bool taken = settings_apply(&plan, &cases[i].setting, 1, false, &error) &&
			     settings_apply(&plan, &cases[i].setting, 1, true, &error);
		assert_string_equal(error.text, cases[i].error);
		assert_false(taken);
		assert_int_equal(error.status, SM_ERROR_INPUT);
		plan_finish(&plan);
	}
}

static char *read_manual(void)
{
	char *text = calloc(1, 100000);
	FILE *file = fopen(SMOOTHIE_SCENE_FILE_MANUAL, "r");
	assert_non_null(text);
	assert_non_null(file);
	assert_true(fread(text, 1, 99999, file) > 0);
	fclose(file);
	return text;
}

/* The manual's text of a section: from its heading to the next one. */
static char *manual_section(const char *manual, enum section section)
{
	char heading[100];
	snprintf(heading, sizeof(heading), "\n## [%s%s]\n", section_name(section),
		section_is_named(section) ? " NAME" : "");
	const char *start = strstr(manual, heading);
	if (start == NULL) {
		fail_msg("the manual has no heading%s", heading);
		return NULL;
	}
	const char *end = strstr(start + 1, "\n## ");
	return end != NULL ? strndup(start, (size_t)(end - start)) : strdup(start);
}

static size_t count_of(const char *text, const char *part)
{
	size_t count = 0;
	while ((text = strstr(text, part)) != NULL) {
		count++;
		text += strlen(part);
	}
	return count;
}

static void the_manual_tells_each_key(void **state)
{
	(void)state;
	char *manual = read_manual();
	for (enum section section = 0; section < SECTION_COUNT; section++) {
		char *text = manual_section(manual, section);
		const struct key *key;
		size_t keys = 0;
		for (size_t i = 0; (key = key_at(i)) != NULL; i++) {
			char takes[200], entry[400];
			if (key->section != section)
				continue;
			keys++;
			key_describe(key, takes, sizeof(takes));
			snprintf(entry, sizeof(entry), "\n- `%s`: %s; default %s. ", key->name,
				takes, key->initial != NULL ? key->initial : key->follows);
			if (strstr(text, entry) == NULL)
				fail_msg("the manual lacks%s", entry);
		}
		assert_int_equal(count_of(text, "\n- `"), keys);
		free(text);
	}
	free(manual);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_default_can_be_parsed),
		cmocka_unit_test(good_values_are_taken),
		cmocka_unit_test(bad_input_is_named_with_its_place),
		cmocka_unit_test(files_that_are_no_text_are_refused),
		cmocka_unit_test(long_comments_are_fine),
		cmocka_unit_test(models_are_looked_for_beside_the_file),
		cmocka_unit_test(settings_reach_one_or_all),
		cmocka_unit_test(bad_settings_are_named),
		cmocka_unit_test(the_manual_tells_each_key),
	};
	return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
