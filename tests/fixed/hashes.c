/* SPDX-License-Identifier: MIT */
/* The bits of the exact pictures, for all built-in scenes: what a driver's CI can pin. */
#include "check/pinned.h"
#include "load/builtin.h"
#include "load/stage.h"
#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint64_t picture_hash(const char *scene, enum sm_precision precision)
{
	static uint16_t values[PINNED_SIZE * PINNED_SIZE];
	char source[64];
	struct stage stage;
	struct sm_error error;
	const struct sm_shadow_options options = {.map_size = PINNED_MAP, .precision = precision};
	snprintf(source, sizeof(source), "builtin:%s", scene);
	if (!stage_load(&stage, source, NULL, 0, &error))
		fail_msg("%s", error.text);
	const struct sm_view view = {
		.camera = stage.camera, .width = PINNED_SIZE, .height = PINNED_SIZE};
	if (!sm_model_visibility(stage.scene, &view, &options, values, &error))
		fail_msg("%s", error.text);
	stage_finish(&stage);
	return pinned_hash(values, PINNED_SIZE * PINNED_SIZE);
}

static void every_scene_has_its_bits(void **state)
{
	(void)state;
	bool same = true;
	size_t i = 0;
	for (; builtin_name(i) != NULL; i++) {
		const struct pinned *pinned = pinned_scene(i);
		assert_non_null(pinned);
		assert_string_equal(pinned->scene, builtin_name(i));
		uint64_t half = picture_hash(pinned->scene, SM_PRECISION_HALF);
		uint64_t fixed12 = picture_hash(pinned->scene, SM_PRECISION_FIXED12);
		if (half == pinned->half && fixed12 == pinned->fixed12)
			continue;
		print_error("{\"%s\", UINT64_C(0x%016" PRIx64 "), UINT64_C(0x%016" PRIx64 ")},\n",
			pinned->scene, half, fixed12);
		same = false;
	}
	assert_null(pinned_scene(i));
	assert_true(same);
}

/* The table of docs/precision.md. */
static void the_documentation_has_the_same(void **state)
{
	(void)state;
	char line[200], expected[200];
	size_t found = 0, scenes = 0;
	const struct pinned *pinned;
	FILE *file = fopen(SMOOTHIE_DOCS "/precision.md", "r");
	assert_non_null(file);
	while (fgets(line, sizeof(line), file) != NULL)
		for (scenes = 0; (pinned = pinned_scene(scenes)) != NULL; scenes++) {
			snprintf(expected, sizeof(expected),
				"| %s | `%016" PRIx64 "` | `%016" PRIx64 "` |\n", pinned->scene,
				pinned->half, pinned->fixed12);
			found += strcmp(line, expected) == 0;
		}
	fclose(file);
	assert_true(scenes > 0);
	assert_int_equal(found, scenes);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_scene_has_its_bits),
		cmocka_unit_test(the_documentation_has_the_same),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
