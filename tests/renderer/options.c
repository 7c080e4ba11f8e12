/* SPDX-License-Identifier: MIT */
/* sm_renderer_set_shadows(): what it takes, and what it says to the rest. */
#include "platform.h"
#include "rig.h"
#include <GLES3/gl3.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void good_options_are_taken(void **state)
{
	struct rig *rig = *state;
	GLint most;
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
	const struct sm_shadow_options cases[] = {
		{0},
		{.technique = "hard"},
		{.technique = "hard", .map_size = 1},
		{.technique = "hard", .map_size = (uint32_t)most},
		{.technique = "smoothie", .width = 1.0f},
		{.technique = "smoothie", .width = 1e-6f, .falloff = SM_FALLOFF_SINUSOID},
		{.falloff = SM_FALLOFF_LINEAR, .passes = 1},
		{.map_size = 17, .passes = 2},
		{.technique = "hard", .precision = SM_PRECISION_FLOAT},
		{.precision = SM_PRECISION_HALF, .width = 0.1f},
		{.precision = SM_PRECISION_FIXED12, .map_size = 2047, .passes = 2},
		{.technique = "gather", .sampling = SM_SAMPLING_SPARSE},
		{.sampling = SM_SAMPLING_DENSE},
		{.technique = "pcf", .samples = 4},
		{.technique = "pcf", .samples = 16},
		{.technique = "pcss", .samples = 32},
		{.technique = "vsm", .samples = 9},
		{.technique = "maps", .samples = 64, .map_size = 16},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		rig_set_shadows(rig, &cases[i]);
}

static void bad_options_are_refused_with_a_reason(void **state)
{
	struct rig *rig = *state;
	GLint most;
	char limit[32];
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
	snprintf(limit, sizeof(limit), "from 1 to %d", most);
	const struct {
		struct sm_shadow_options options;
		const char *text;
	} cases[] = {
		{{.technique = "soft"}, "no technique \"soft\"; there are: auto, "},
		{{.technique = ""}, "no technique \"\""},
		{{.technique = "hard", .width = 0.1f}, "shadow width does nothing"},
		{{.technique = "hard", .falloff = SM_FALLOFF_LINEAR},
			"shadow falloff does nothing"},
		{{.technique = "hard", .passes = 1}, "shadow passes does nothing"},
		{{.map_size = (uint32_t)most + 1}, limit},
		{{.technique = "hard", .map_size = UINT32_MAX}, limit},
		{{.passes = 3}, "3 smoothie passes"},
		{{.technique = "pcf", .sampling = SM_SAMPLING_DENSE},
			"shadow sampling does nothing"},
		{{.sampling = SM_SAMPLING_SPARSE, .width = 0.1f}, "shadow width does nothing"},
		{{.sampling = (enum sm_sampling)5}, "a sampling of number 5; the last is 4"},
		{{.technique = "hard", .samples = 4}, "shadow samples does nothing"},
		{{.technique = "pcf", .samples = 5},
			"5 shadow samples; with the technique \"pcf\" there are: 4, 16"},
		{{.technique = "pcf", .precision = SM_PRECISION_HALF},
			"shadow precision does nothing"},
		{{.precision = SM_PRECISION_HALF, .passes = 1},
			"1 smoothie pass; with the precision \"half\" there are always 2"},
		{{.precision = SM_PRECISION_FIXED12, .map_size = 2048},
			"2048 texels a side; with the precision \"fixed12\" there are at most "
			"2047"},
		{{.precision = (enum sm_precision)4}, "a precision of number 4; the last is 3"},
		{{.width = 2.0f}, "smoothie width of 2"},
		{{.width = -0.1f}, "smoothie width of -0.1"},
		{{.width = (float)NAN}, "smoothie width of nan"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_error error = {0};
		assert_false(sm_renderer_set_shadows(rig->renderer, &cases[i].options, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		if (strstr(error.text, cases[i].text) == NULL)
			fail_msg("\"%s\" says nothing of \"%s\"", error.text, cases[i].text);
		assert_false(sm_renderer_set_shadows(rig->renderer, &cases[i].options, NULL));
	}
}

static void techniques_have_names_and_summaries_the_default_first(void **state)
{
	struct rig *rig = *state;
	size_t count = 0;
	assert_string_equal(sm_technique_name(0), "auto");
	for (; sm_technique_name(count) != NULL; count++) {
		struct sm_shadow_options options = {.technique = sm_technique_name(count)};
		rig_set_shadows(rig, &options);
		assert_true(strlen(sm_technique_summary(count)) > 0);
	}
	assert_null(sm_technique_summary(count));
	assert_null(sm_technique_name(SIZE_MAX));
}

static void precisions_have_names(void **state)
{
	(void)state;
	assert_string_equal(sm_precision_name(SM_PRECISION_FLOAT - 1), "float");
	assert_string_equal(sm_precision_name(SM_PRECISION_HALF - 1), "half");
	assert_string_equal(sm_precision_name(SM_PRECISION_FIXED12 - 1), "fixed12");
	assert_null(sm_precision_name(3));
	assert_null(sm_precision_name(SIZE_MAX));
}

static void needs_and_their_ways_have_names(void **state)
{
	struct rig *rig = *state;
	size_t need = 0;
	assert_string_equal(sm_need_name(0), "smoothie");
	for (; sm_need_name(need) != NULL; need++) {
		size_t way = 0;
		for (; sm_way_name(need, way) != NULL; way++)
			;
		assert_true(way > 1);
		assert_null(sm_way_name(need, SIZE_MAX));
	}
	assert_null(sm_way_name(need, 0));
	assert_null(sm_need_name(SIZE_MAX));
	/* As sm_renderer_create(). */
	rig_use_driver(rig, &(struct sm_driver_options){0});
}

static void bad_driver_options_are_refused_with_a_reason(void **state)
{
	static const struct {
		enum sm_status status;
		const char *caps, *path, *text;
	} cases[] = {
		{SM_ERROR_INPUT, "-warp", NULL,
			"no cap \"warp\"; there are: EXT_color_buffer_float "},
		{SM_ERROR_INPUT, "+warp", NULL, " fragment_images"}, /* the last of them, whole */
		{SM_ERROR_INPUT, "", NULL, "caps \"\": a list"},
		{SM_ERROR_INPUT, "-", NULL, "no cap \"\""},
		{SM_ERROR_INPUT, "-min_rg16f,,", NULL, "caps \"\": a list"},
		{SM_ERROR_INPUT, NULL, "smoothie", "path \"smoothie\": NEED=WAY"},
		{SM_ERROR_INPUT, NULL, "=rg16f", "no need \"\"; there are: smoothie, "},
		{SM_ERROR_INPUT, NULL,
			"taps=", "no way \"\" of the need taps; there are: gather, "},
		{SM_ERROR_MACHINE, "-texture_gather", "taps=gather",
			"takes texture_gather, which is not there: taken away"},
		{SM_ERROR_MACHINE, "-EXT_shader_framebuffer_fetch", "smoothie=fetch",
			"takes fetch_rg16f, which is not there: without "},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_error error = {0};
		struct sm_driver_options options = {
			cases[i].caps, &cases[i].path, cases[i].path != NULL};
		assert_null(sm_renderer_create_with(platform_get_proc, &options, &error));
		assert_int_equal(error.status, cases[i].status);
		if (strstr(error.text, cases[i].text) == NULL)
			fail_msg("\"%s\" says nothing of \"%s\"", error.text, cases[i].text);
		assert_true(strlen(error.text) < sizeof(error.text) - 1); /* nothing is cut off */
	}
}

struct facts {
	int count;
	bool renderer, cap, need;
};

static void note_fact(void *data, const char *key, const char *value)
{
	struct facts *facts = data;
	assert_true(strlen(key) > 0 && strlen(value) > 0);
	facts->count++;
	facts->renderer |= strcmp(key, "renderer") == 0;
	facts->cap |= strcmp(key, "cap min_rgb10_a2") == 0 && strncmp(value, "yes: ", 5) == 0;
	facts->need |=
		strcmp(key, "need smoothie") == 0 && strstr(value, "MIN blending in ") != NULL;
}

static void the_renderer_describes_itself(void **state)
{
	struct rig *rig = *state;
	struct facts first = {0}, second = {0};
	sm_renderer_describe(rig->renderer, note_fact, &first);
	sm_renderer_describe(rig->renderer, note_fact, &second);
	assert_true(first.renderer && first.cap && first.need);
	assert_int_equal(first.count, second.count);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(good_options_are_taken),
		rig_test(bad_options_are_refused_with_a_reason),
		rig_test(techniques_have_names_and_summaries_the_default_first),
		cmocka_unit_test(precisions_have_names),
		rig_test(needs_and_their_ways_have_names),
		rig_test(bad_driver_options_are_refused_with_a_reason),
		rig_test(the_renderer_describes_itself),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
