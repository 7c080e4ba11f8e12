/* SPDX-License-Identifier: MIT */
#include "synthetic.h"
#include "base/array.h"
#include "check/report.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define SIZE 128

static const struct check_result specials[] = {
	{.name = SYNTHETIC_PLAIN,
		.status = CHECK_FAIL,
		.first_status = CHECK_FAIL,
		.attempts = 2,
		.seconds = 0.4125,
		.message = "16384 pixels differ, hash 811c9dc5 instead of 01000193",
		.difference = {SIZE * SIZE, SIZE *SIZE, 0, 0, 1, 1}},
	{.name = SYNTHETIC_SHADOW,
		.status = CHECK_FAIL,
		.first_status = CHECK_FAIL,
		.attempts = 2,
		.seconds = 0.71,
		.message = "mean difference 0.0123, above 0.006 for ways of 8 bits",
		.difference = {SIZE * SIZE, 1432, 64, .02, .0123, .17}},
	{.name = "picture.smoothie.half.columns",
		.status = CHECK_EXPECTED_FAIL,
		.first_status = CHECK_FAIL,
		.attempts = 1,
		.seconds = 0.3,
		.message = "mean difference 0.0031",
		.difference = {SIZE * SIZE, 90, 64, .02, .0031, .17}},
	{.name = "format.rg16f.min",
		.status = CHECK_CRASH,
		.first_status = CHECK_CRASH,
		.attempts = 2,
		.seconds = 0.05,
		.message = "ended by signal 11 (Segmentation fault)"},
	{.name = "context.create-destroy",
		.status = CHECK_TIMEOUT,
		.first_status = CHECK_TIMEOUT,
		.attempts = 2,
		.seconds = 120.5,
		.message = "not done after 60 s"},
	{.name = "format.rgb10_a2.min",
		.status = CHECK_UNEXPECTED_PASS,
		.first_status = CHECK_PASS,
		.attempts = 1,
		.seconds = 0.01,
		.message = "a baseline says Fail"},
	{.name = "picture.smoothie.float.fence.smoothie=fetch",
		.status = CHECK_SKIP,
		.first_status = CHECK_SKIP,
		.message = "the driver lacks EXT_shader_framebuffer_fetch"},
	{.name = "frame.repeat",
		.status = CHECK_FLAKE,
		.first_status = CHECK_FAIL,
		.attempts = 2,
		.seconds = 0.8,
		.message = "frame 2 differs from frame 1 in 3 pixels"},
	{.name = "evil." SYNTHETIC_EVIL,
		.status = CHECK_FAIL,
		.first_status = CHECK_FAIL,
		.attempts = 2,
		.seconds = 0.001,
		.message = SYNTHETIC_EVIL},
	{.name = "evil.skip." SYNTHETIC_EVIL,
		.status = CHECK_SKIP,
		.first_status = CHECK_SKIP,
		.message = SYNTHETIC_EVIL},
};

/* 0 where a disc is before the light, 1 outside it, and a ramp that is `soft` wide between. */
static double shadow(double x, double y, double soft)
{
	double distance = hypot(x - .55, y - .5) - .27;
	return fmin(fmax(distance / (soft * (.2 + x)) + .5, 0), 1);
}

static uint16_t quantise(double value)
{
	return (uint16_t)(value * 65535 + .5);
}

static void paint(uint16_t *result, uint16_t *reference, bool plain)
{
	for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) {
		double x = (double)(i % SIZE) / SIZE, y = (double)(i / SIZE) / SIZE;
		result[i] = plain ? UINT16_MAX : quantise(shadow(x, y + .012, .28));
		reference[i] = plain ? 0 : quantise(shadow(x, y, .3));
	}
}

static bool write_pictures(
	struct check_result *result, const char *folder, file_writer write, struct sm_error *error)
{
	static uint16_t drawn[SIZE * SIZE], expected[SIZE * SIZE];
	const struct check_pair pair = {drawn, expected, SIZE, SIZE};
	if (result->difference.pixels == 0)
		return true;
	paint(drawn, expected, result->difference.failing == result->difference.pixels);
	return check_pictures_write(folder, &pair, write, result, error);
}

static struct check_result make_pass(size_t number)
{
	static const char *const techniques[] = {"hard", "pcf-5", "pcss-16", "vsm", "smoothie"};
	static const char *const scenes[] = {"fence", "columns", "cylinder", "bunny", "leaves"};
	struct check_result result = {
		.attempts = 1,
		.seconds = .2 + .013 * (double)(number * 7 % 40),
		.difference = {SIZE * SIZE, number % 3, 64, .02, 2e-5 * (double)(number % 11),
			.001 * (double)(number % 23)},
	};
	snprintf(result.name, sizeof(result.name), "picture.%s.float.%s.copy=%s",
		techniques[number / 10 % COUNT(techniques)], scenes[number / 2 % COUNT(scenes)],
		number % 2 == 0 ? "stored" : "encode");
	return result;
}

static bool add_facts(struct check_run *run)
{
	static const char *const facts[][2] = {
		{"renderer", "llvmpipe (LLVM 15.0.6, 256 bits)"},
		{"version", "OpenGL ES 3.2 Mesa 22.3.6"},
		{"shading language", "OpenGL ES GLSL ES 3.20"},
		{"smoothie", "0.1.0"},
		{"caps", "color_buffer_half_float color_buffer_float float_blend sRGB_decode "
			 "gather timer"},
		{"way of smoothie", "rg16f: MIN blending works in it"},
		{"way of depth", "texture"},
		{"way of comparison", "sampler"},
		{"evil " SYNTHETIC_EVIL, SYNTHETIC_EVIL},
	};
	for (size_t i = 0; i < COUNT(facts); i++)
		if (!check_run_add_fact(run, facts[i][0], facts[i][1]))
			return false;
	return true;
}

bool synthetic_run(
	struct check_run *run, const char *folder, file_writer write, struct sm_error *error)
{
	enum { passes = 50 };
	*run = (struct check_run){
		.results = array_zalloc(passes + COUNT(specials), sizeof(*run->results)),
		.fraction = 4,
		.fraction_start = 2,
		.jobs = 2,
		.started = 1700000000,
		.seconds = 48.2,
		.complete = true,
	};
	if (run->results == NULL || !add_facts(run))
		return error_no_memory(error);
	for (size_t i = 0; i < passes + COUNT(specials); i++) {
		bool special = i % 5 == 4 && i / 5 < COUNT(specials);
		run->results[i] = special ? specials[i / 5] : make_pass(i);
		run->count++;
		if (special && !write_pictures(&run->results[i], folder, write, error))
			return false;
	}
	return true;
}
