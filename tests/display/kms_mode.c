/* SPDX-License-Identifier: MIT */
/* Which mode is meant, and how fast it is. */
#include "kms_mode.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void wishes(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		bool is_one;
		struct mode_wish wish;
	} cases[] = {
		{"preferred", true, {0}},
		{"current", true, {.current = true}},
		{"1920x1080", true, {.width = 1920, .height = 1080}},
		{"1x1", true, {.width = 1, .height = 1}},
		{"65535x65535", true, {.width = 65535, .height = 65535}},
		{"1920x1080@60", true, {.width = 1920, .height = 1080, .hz = 60}},
		{"1920x1080@59.94", true, {.width = 1920, .height = 1080, .hz = 59.94}},
		{"1x1@1000", true, {.width = 1, .height = 1, .hz = 1000}},
		{"", false, {0}},
		{"Preferred", false, {0}},
		{"9x", false, {0}},
		{"x9", false, {0}},
		{"9", false, {0}},
		{"0x9", false, {0}},
		{"9x0", false, {0}},
		{"09x9", false, {0}},
		{"-9x9", false, {0}},
		{"9 x9", false, {0}},
		{"65536x9", false, {0}},
		{"99999999999999999999x9", false, {0}},
		{"9x9x9", false, {0}},
		{"9x9@", false, {0}},
		{"9x9@0", false, {0}},
		{"9x9@-1", false, {0}},
		{"9x9@nan", false, {0}},
		{"9x9@60Hz", false, {0}},
		{"9x9@1001", false, {0}},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct mode_wish wish;
		if (mode_wish_parse(&wish, cases[i].text) != cases[i].is_one)
			fail_msg("\"%s\"", cases[i].text);
		if (!cases[i].is_one)
			continue;
		assert_int_equal(wish.current, cases[i].wish.current);
		assert_int_equal(wish.width, cases[i].wish.width);
		assert_int_equal(wish.height, cases[i].wish.height);
		assert_true(wish.hz == cases[i].wish.hz);
	}
}

/* CEA-861 timings: 1080p at 60, 59.94 and 24 Hz, 720p at 60, 1080i, and one without timing. */
static const drmModeModeInfo modes[] = {
	{.clock = 74250,
		.hdisplay = 1280,
		.htotal = 1650,
		.vdisplay = 720,
		.vtotal = 750,
		.vrefresh = 60},
	{.clock = 148500,
		.hdisplay = 1920,
		.htotal = 2200,
		.vdisplay = 1080,
		.vtotal = 1125,
		.vrefresh = 60,
		.type = DRM_MODE_TYPE_PREFERRED},
	{.clock = 148352,
		.hdisplay = 1920,
		.htotal = 2200,
		.vdisplay = 1080,
		.vtotal = 1125,
		.vrefresh = 60},
	{.clock = 74250,
		.hdisplay = 1920,
		.htotal = 2750,
		.vdisplay = 1080,
		.vtotal = 1125,
		.vrefresh = 24},
	{.clock = 74250,
		.hdisplay = 1920,
		.htotal = 2200,
		.vdisplay = 540,
		.vtotal = 1125,
		.vrefresh = 60,
		.flags = DRM_MODE_FLAG_INTERLACE},
	{.hdisplay = 800, .vdisplay = 600, .vrefresh = 75},
	{.hdisplay = 640, .vdisplay = 480},
	{.clock = 12587,
		.hdisplay = 320,
		.htotal = 400,
		.vdisplay = 240,
		.vtotal = 262,
		.flags = DRM_MODE_FLAG_DBLSCAN},
};
#define MODES (sizeof(modes) / sizeof(modes[0]))

static void rates(void **state)
{
	(void)state;
	static const double hz[MODES] = {60, 60, 59.9402, 24, 60, 75, 60, 60.0525};
	for (size_t i = 0; i < MODES; i++) {
		struct refresh refresh = mode_refresh(&modes[i]);
		assert_true(refresh.denominator > 0);
		assert_true(fabs((double)refresh.numerator / refresh.denominator - hz[i]) < 1e-3);
	}
}

static void choices(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		size_t count;
		int current, chosen; /* -1: none */
	} cases[] = {
		{"preferred", MODES, 0, 1},
		{"preferred", 1, -1, 0},
		{"preferred", 0, -1, -1},
		{"current", MODES, 3, 3},
		{"current", MODES, -1, 1},
		{"1920x1080", MODES, -1, 1},
		{"1920x1080@60", MODES, -1, 1},
		{"1920x1080@59.9", MODES, -1, 2},
		{"1920x1080@59.5", MODES, -1, 2},
		{"1920x1080@24", MODES, -1, 3},
		{"1920x1080@50", MODES, -1, -1},
		{"1280x720@60.4", MODES, -1, 0},
		{"1280x720@60.6", MODES, -1, -1},
		{"800x600", MODES, -1, 5},
		{"1024x768", MODES, -1, -1},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct mode_wish wish;
		assert_true(mode_wish_parse(&wish, cases[i].text));
		const drmModeModeInfo *current =
			cases[i].current >= 0 ? &modes[cases[i].current] : NULL;
		const drmModeModeInfo *mode = mode_choose(&wish, modes, cases[i].count, current);
		if (mode != (cases[i].chosen >= 0 ? &modes[cases[i].chosen] : NULL))
			fail_msg("%s of %zu", cases[i].text, cases[i].count);
	}
}

static void modes_are_equal_on_the_wire(void **state)
{
	(void)state;
	drmModeModeInfo other = modes[1];
	strcpy(other.name, "another");
	other.type = 0;
	other.vrefresh = 59;
	assert_true(mode_equal(&modes[1], &other));
	other.hsync_start++;
	assert_false(mode_equal(&modes[1], &other));
	other = modes[1];
	other.flags ^= DRM_MODE_FLAG_INTERLACE;
	assert_false(mode_equal(&modes[1], &other));
	assert_false(mode_equal(&modes[1], &modes[2]));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(wishes),
		cmocka_unit_test(rates),
		cmocka_unit_test(choices),
		cmocka_unit_test(modes_are_equal_on_the_wire),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
