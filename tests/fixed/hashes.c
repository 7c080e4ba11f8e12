/* SPDX-License-Identifier: MIT */
/* The bits of the exact pictures, for all built-in scenes: what a driver's CI can pin. */
#include "load/builtin.h"
#include "load/stage.h"
#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 256
#define MAP_SIZE 512

static const struct {
	const char *scene;
	uint64_t half, fixed12;
} pinned[] = {
	{"cylinder", UINT64_C(0xe10d7bfc2e7a6e1c), UINT64_C(0x3a2ecd23a885eeb8)},
	{"boxes", UINT64_C(0xdf0cce13a97cc501), UINT64_C(0xf0ef3a0543d18d73)},
	{"fence", UINT64_C(0xc87b32a057a95b67), UINT64_C(0x950eb22d1ed4de78)},
	{"knot", UINT64_C(0xef1bcc32b99ca8ab), UINT64_C(0xd7ed7a2c29a3c637)},
	{"urchin", UINT64_C(0xbf069f93d88699c4), UINT64_C(0xf3e25bb53f5e8cf8)},
	{"debris", UINT64_C(0xe6cc1a2ab7b109e2), UINT64_C(0x23f1eebfcb532c71)},
	{"primitives", UINT64_C(0xd2d8f8fcc1c32840), UINT64_C(0xf6b41a1889dc55b2)},
	{"cube", UINT64_C(0x5b54192368859051), UINT64_C(0x5d7980ffda1f48c8)},
	{"sphere", UINT64_C(0xd9ef82cc6a059a46), UINT64_C(0x256e65818828a07c)},
	{"icosahedron", UINT64_C(0x9137dd6ed3b6cfab), UINT64_C(0x9b0e564d426fd4e8)},
	{"pillar", UINT64_C(0x42b894ac1a67c81f), UINT64_C(0xfb02899d3d037c5f)},
	{"cone", UINT64_C(0x9c5c7bdc6f1609bb), UINT64_C(0x9e1c9e2c4b35910b)},
	{"torus", UINT64_C(0x19f2959042578fbb), UINT64_C(0xfc11e8c6531a1f0f)},
	{"vase", UINT64_C(0xac69566f9f6c435e), UINT64_C(0x7c2db87ac9cbfd9e)},
};

#define SCENES (sizeof(pinned) / sizeof(pinned[0]))

/* FNV-1a, 64 bits, of the values' high and low bytes. */
static uint64_t hash_of(const uint16_t *values, size_t count)
{
	uint64_t hash = UINT64_C(0xcbf29ce484222325);
	for (size_t i = 0; i < 2 * count; i++) {
		hash ^= i % 2 ? values[i / 2] & 0xff : values[i / 2] >> 8;
		hash *= UINT64_C(0x100000001b3);
	}
	return hash;
}

static uint64_t picture_hash(const char *scene, enum sm_precision precision)
{
	static uint16_t values[SIZE * SIZE];
	char source[64];
	struct stage stage;
	struct sm_error error;
	const struct sm_shadow_options options = {.map_size = MAP_SIZE, .precision = precision};
	snprintf(source, sizeof(source), "builtin:%s", scene);
	if (!stage_load(&stage, source, NULL, 0, &error))
		fail_msg("%s", error.text);
	const struct sm_view view = {.camera = stage.camera, .width = SIZE, .height = SIZE};
	if (!sm_model_visibility(stage.scene, &view, &options, values, &error))
		fail_msg("%s", error.text);
	stage_finish(&stage);
	return hash_of(values, SIZE * SIZE);
}

static void every_scene_has_its_bits(void **state)
{
	(void)state;
	bool same = true;
	for (size_t i = 0; builtin_name(i) != NULL; i++) {
		assert_true(i < SCENES);
		assert_string_equal(pinned[i].scene, builtin_name(i));
		uint64_t half = picture_hash(pinned[i].scene, SM_PRECISION_HALF);
		uint64_t fixed12 = picture_hash(pinned[i].scene, SM_PRECISION_FIXED12);
		if (half == pinned[i].half && fixed12 == pinned[i].fixed12)
			continue;
		print_error("{\"%s\", UINT64_C(0x%016" PRIx64 "), UINT64_C(0x%016" PRIx64 ")},\n",
			pinned[i].scene, half, fixed12);
		same = false;
	}
	assert_true(same);
}

/* The table of docs/precision.md. */
static void the_documentation_has_the_same(void **state)
{
	(void)state;
	char line[200];
	size_t found = 0;
	FILE *file = fopen(SMOOTHIE_DOCS "/precision.md", "r");
	assert_non_null(file);
	while (fgets(line, sizeof(line), file) != NULL)
		for (size_t i = 0; i < SCENES; i++) {
			char expected[200];
			snprintf(expected, sizeof(expected),
				"| %s | `%016" PRIx64 "` | `%016" PRIx64 "` |\n", pinned[i].scene,
				pinned[i].half, pinned[i].fixed12);
			found += strcmp(line, expected) == 0;
		}
	fclose(file);
	assert_int_equal(found, SCENES);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_scene_has_its_bits),
		cmocka_unit_test(the_documentation_has_the_same),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
