/* SPDX-License-Identifier: MIT */
/* A driver's faults, each seeded between the renderer and GL, take its pictures clearly off the
 * model: farther than agreement.c lets a driver without faults be. They show in whole maps alone:
 * in the single texels that caps are probed by they would be found out, and avoided. */
#include "likeness.h"
#include "platform.h"
#include <GLES3/gl32.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define MAP_SIZE 512

static void draw_maps_beside(GLint x, GLint y, GLsizei width, GLsizei height)
{
	glViewport(width == MAP_SIZE ? x + 1 : x, y, width, height);
}

static void draw_always(GLenum function)
{
	(void)function;
	glDepthFunc(GL_ALWAYS);
}

static void add_for_min(GLenum equation)
{
	GLint viewport[4];
	glGetIntegerv(GL_VIEWPORT, viewport);
	bool faulty = equation == GL_MIN && viewport[2] == MAP_SIZE;
	glBlendEquation(faulty ? GL_FUNC_ADD : equation);
}

static bool is_float(GLenum format, GLsizei width)
{
	return (format == GL_RG16F || format == GL_RG32F) && width == MAP_SIZE;
}

/* Floats of 16 bits have 11 that count; these have 7. */
static void store_short(GLenum kind, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
	glTexStorage2D(
		kind, levels, is_float(format, width) ? GL_R11F_G11F_B10F : format, width, height);
}

static void store_bytes(GLenum kind, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
	glTexStorage2D(kind, levels, is_float(format, width) ? GL_RG8 : format, width, height);
}

typedef void (*function)(void);

static const struct {
	const char *name;
	function replaced;
} faults[] = {
	{"glViewport", (function)draw_maps_beside},
	{"glDepthFunc", (function)draw_always},
	{"glBlendEquation", (function)add_for_min},
	{"glTexStorage2D", (function)store_short},
	{"glTexStorage2D", (function)store_bytes},
};

enum fault {
	ONE_TEXEL_BESIDE,
	DEPTH_NOT_TESTED,
	MIN_IS_ADD,
	FLOATS_SHORT,
	FLOATS_ARE_BYTES,
	NO_FAULT
};

static enum fault seeded;

static function get_faulty_proc(const char *name)
{
	bool faulty = seeded != NO_FAULT && strcmp(name, faults[seeded].name) == 0;
	return faulty ? faults[seeded].replaced : platform_get_proc(name);
}

/* Of a picture that the rig's renderer draws over a faulty GL. */
static struct likeness likeness_with(
	struct rig *rig, enum fault fault, const char *scene, const char *technique)
{
	struct stage stage;
	struct sm_error error;
	struct rig faulty = *rig;
	/* What is drawn by a minimum or stored as floats is no integers, nor has a view of such. */
	const char *path = "pairs=apart";
	const struct sm_driver_options driver = {.paths = &path, .path_count = fault >= MIN_IS_ADD};
	seeded = fault;
	faulty.renderer = sm_renderer_create_with(get_faulty_proc, &driver, &error);
	if (faulty.renderer == NULL)
		fail_msg("%s", error.text);
	likeness_load(&stage, scene);
	struct sm_shadow_options options = {.technique = technique, .map_size = MAP_SIZE};
	struct likeness found = likeness_of(&faulty, stage.scene, &stage.camera, &options);
	stage_finish(&stage);
	sm_renderer_destroy(faulty.renderer);
	print_message("%-10s %-18s mean %.5f, off %.4f by .001, %.4f by .02\n", scene, technique,
		found.mean, found.by_001, found.by_02);
	return found;
}

static const char *const scenes[] = {
	"cylinder", "boxes", "fence", "knot", "urchin", "debris", "primitives"};
static const char *const techniques[] = {
	"smoothie", "smoothie-two-sided", "penumbra-map", "hard", "pcf", "pcss", "vsm", "maps"};

/* Thrice what agreement.c allows. */
static bool is_off(const struct likeness *found)
{
	return found->mean > 3.6e-4 && found->by_02 > 28e-4;
}

/* Of each technique in each scene. */
static void assert_all_off(struct rig *rig, enum fault fault)
{
	for (size_t i = 0; i < COUNT(scenes); i += SCENES_STEP)
		for (size_t j = 0; j < COUNT(techniques); j++) {
			struct likeness found = likeness_with(rig, fault, scenes[i], techniques[j]);
			assert_true(is_off(&found));
		}
}

static void test_maps_one_texel_beside_are_noticed(void **state)
{
	assert_all_off(*state, ONE_TEXEL_BESIDE);
}

static void test_depth_that_is_not_tested_is_noticed(void **state)
{
	assert_all_off(*state, DEPTH_NOT_TESTED);
}

/* Where many fins overlap. */
static void test_adding_for_the_minimum_is_noticed(void **state)
{
	static const struct {
		const char *scene, *technique;
	} overlaps[] = {
		{"debris", "smoothie"},
		{"debris", "penumbra-map"},
		{"fence", "penumbra-map"},
	};
	for (size_t i = 0; i < COUNT(overlaps); i++) {
		struct likeness found =
			likeness_with(*state, MIN_IS_ADD, overlaps[i].scene, overlaps[i].technique);
		assert_true(is_off(&found));
	}
}

/* Alpha in steps of 1/256 to 1/64 shows in penumbrae, which are right to .001 otherwise. */
static void test_alpha_of_few_bits_is_noticed(void **state)
{
	for (size_t i = 0; i < COUNT(scenes); i += SCENES_STEP) {
		struct likeness good = likeness_with(*state, NO_FAULT, scenes[i], "penumbra-map");
		struct likeness few =
			likeness_with(*state, FLOATS_SHORT, scenes[i], "penumbra-map");
		struct likeness bytes =
			likeness_with(*state, FLOATS_ARE_BYTES, scenes[i], "penumbra-map");
		assert_true(good.by_001 < 4e-4);
		assert_true(few.by_001 > 12e-4 && bytes.by_001 > 12e-4);
	}
}

static void test_moments_of_few_bits_are_noticed(void **state)
{
	for (size_t i = 0; i < COUNT(scenes); i += SCENES_STEP) {
		struct likeness few = likeness_with(*state, FLOATS_SHORT, scenes[i], "vsm");
		struct likeness bytes = likeness_with(*state, FLOATS_ARE_BYTES, scenes[i], "vsm");
		assert_true(is_off(&few) && is_off(&bytes));
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(test_maps_one_texel_beside_are_noticed),
		rig_test(test_depth_that_is_not_tested_is_noticed),
		rig_test(test_adding_for_the_minimum_is_noticed),
		rig_test(test_alpha_of_few_bits_is_noticed),
		rig_test(test_moments_of_few_bits_are_noticed),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
