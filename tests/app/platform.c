/* SPDX-License-Identifier: MIT */
/* A context without a window: it draws, it says what it is, it can be opened again. */
#include "platform.h"
#include "app/offscreen.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <EGL/egl.h>
#include <GLES3/gl3.h>
#include <cmocka.h>
#include <string.h>

static struct platform *open_platform(const char *device, bool debug)
{
	struct sm_error error = {0};
	struct platform *platform = platform_create(device, debug, &error);
	if (platform == NULL)
		fail_msg("%s", error.text);
	return platform;
}

static void test_contexts_are_opengl_es_3(void **state)
{
	(void)state;
	static const char *const devices[] = {"surfaceless", NULL};
	for (size_t i = 0; i < 2; i++) {
		GLint major = 0;
		struct platform *platform = open_platform(devices[i], false);
		glGetIntegerv(GL_MAJOR_VERSION, &major);
		assert_int_equal(major, 3);
		assert_int_equal(glGetError(), GL_NO_ERROR);
		assert_non_null(platform_get_proc("glDrawElements"));
		platform_destroy(platform);
		assert_ptr_equal(eglGetCurrentContext(), EGL_NO_CONTEXT);
	}
}

static void test_debug_contexts(void **state)
{
	(void)state;
	const GLenum context_flags = 0x821E; /* GL_CONTEXT_FLAGS of OpenGL ES 3.2 */
	GLint flags = 0;
	struct platform *platform = open_platform("surfaceless", true);
	glGetIntegerv(context_flags, &flags);
	if (glGetError() != GL_NO_ERROR) /* ES 3.1 and below do not tell */
		flags = 2;
	assert_int_equal(flags & 2, 2); /* GL_CONTEXT_FLAG_DEBUG_BIT */
	platform_destroy(platform);
}

static void test_devices_that_are_none(void **state)
{
	(void)state;
	static const struct {
		const char *device;
		const char *text;
	} cases[] = {
		{"", "no device \"\""},
		{"llvmpipe", "no device \"llvmpipe\""},
		{"/dev/dri/missing", SMOOTHIE_NODE_PROBLEM},
		{"/dev/null", "device /dev/null does not work: "},
		{"/", "device / does not work: "},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_error error = {0};
		assert_null(platform_create(cases[i].device, false, &error));
		assert_int_not_equal(error.status, SM_OK);
		assert_non_null(strstr(error.text, cases[i].text));
		assert_null(platform_create(cases[i].device, false, NULL));
		assert_null(platform_create_on(cases[i].device, false, &error));
		assert_non_null(strstr(error.text, cases[i].text));
	}
	platform_destroy(NULL);
}

static void keep_device(void *data, const char *key, const char *value)
{
	assert_non_null(value);
	if (strcmp(key, "device") == 0)
		*(bool *)data = strcmp(value, "surfaceless") == 0;
}

static void test_description_names_the_device(void **state)
{
	(void)state;
	bool named = false;
	struct platform *platform = open_platform("surfaceless", false);
	platform_describe(platform, keep_device, &named);
	assert_true(named);
	platform_destroy(platform);
}

/* Half of the picture is cleared, so that one read upside down or of the wrong buffer shows. */
static void assert_reads_back(enum offscreen_kind kind, uint32_t samples)
{
	struct offscreen target;
	uint8_t rgba[5 * 4 * 4];
	assert_true(offscreen_init(&target, kind, 5, 4, samples, NULL));
	glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
	glClearColor(0, 0, 0, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glEnable(GL_SCISSOR_TEST);
	glScissor(0, 0, 5, 2);
	glClearColor(1, 0, .5f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
	offscreen_resolve(&target);
	assert_true(offscreen_read(&target, rgba, NULL));
	for (size_t i = 0; i < 20; i++) {
		/* 0.5 is the byte 188 in sRGB (IEC 61966-2-1), 128 as it stands. */
		int half = kind == OFFSCREEN_PICTURE ? 188 : 128;
		assert_int_equal(rgba[4 * i], i < 10 ? 255 : 0);
		assert_in_range(rgba[4 * i + 2], i < 10 ? half - 1 : 0, i < 10 ? half + 1 : 0);
		assert_int_equal(rgba[4 * i + 3], 255);
	}
	offscreen_finish(&target);
	assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void test_targets_read_back_what_was_drawn(void **state)
{
	(void)state;
	struct platform *platform = open_platform("surfaceless", false);
	assert_reads_back(OFFSCREEN_PICTURE, 1);
	assert_reads_back(OFFSCREEN_PICTURE, 4);
	assert_reads_back(OFFSCREEN_PICTURE, 1000);
	assert_reads_back(OFFSCREEN_VISIBILITY, 1);
	platform_destroy(platform);
}

static void test_targets_refuse_sizes_beyond_the_driver(void **state)
{
	(void)state;
	static const uint32_t sizes[][2] = {
		{0, 5}, {5, 0}, {1u << 20, 1}, {1, 1u << 20}, {UINT32_MAX, UINT32_MAX}};
	struct platform *platform = open_platform("surfaceless", false);
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		struct sm_error error;
		struct offscreen target;
		assert_false(offscreen_init(
			&target, OFFSCREEN_PICTURE, sizes[i][0], sizes[i][1], 4, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		assert_non_null(strstr(error.text, "this driver draws 1x1 to "));
		offscreen_finish(&target);
	}
	platform_destroy(platform);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_contexts_are_opengl_es_3),
		cmocka_unit_test(test_debug_contexts),
		cmocka_unit_test(test_devices_that_are_none),
		cmocka_unit_test(test_description_names_the_device),
		cmocka_unit_test(test_targets_read_back_what_was_drawn),
		cmocka_unit_test(test_targets_refuse_sizes_beyond_the_driver),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
