/* SPDX-License-Identifier: MIT */
/* A target or a table that could not be made in one frame is made in the next. */
#include "canvas.h"
#include "parts.h"
#include "platform.h"
#include "visibility.h"
#include <GLES3/gl3.h>
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 64

/* A driver that once makes an incomplete framebuffer, or a texture without memory: those that are
 * good until then, and whether it came. */
#define ALL_GOOD 1000000
enum spoil { FRAMEBUFFERS, TEXTURES };
static enum spoil spoils;
static unsigned int good = ALL_GOOD;
static bool spoiled;

static bool is_spoiled(enum spoil what)
{
	bool now = spoils == what && good-- == 0;
	spoiled = spoiled || now;
	return now;
}

static GLenum GL_APIENTRY spoil_status(GLenum target)
{
	PFNGLCHECKFRAMEBUFFERSTATUSPROC status =
		(PFNGLCHECKFRAMEBUFFERSTATUSPROC)platform_get_proc("glCheckFramebufferStatus");
	if (is_spoiled(FRAMEBUFFERS)) {
		glFramebufferTexture2D(target, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
		glFramebufferTexture2D(target, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
	}
	return status(target);
}

/* No texture is as wide. */
static void GL_APIENTRY spoil_storage(
	GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
	PFNGLTEXSTORAGE2DPROC store = (PFNGLTEXSTORAGE2DPROC)platform_get_proc("glTexStorage2D");
	store(target, levels, format, is_spoiled(TEXTURES) ? INT_MAX : width, height);
}

static void (*get_proc(const char *name))(void)
{
	return strcmp(name, "glCheckFramebufferStatus") == 0 ? (void (*)(void))spoil_status
	       : strcmp(name, "glTexStorage2D") == 0         ? (void (*)(void))spoil_storage
							     : platform_get_proc(name);
}

static const struct sm_camera camera = {.eye = {0, 3, 6}, .up = {0, 1, 0}, .fov = 40};

static void ignore_fact(void *data, const char *key, const char *value)
{
	(void)data, (void)key, (void)value;
}

/* One that knows all caps, so that no probe makes targets later. */
static void use_renderer(struct rig *rig, const char *path, const struct sm_shadow_options *options)
{
	const struct sm_driver_options driver = {.paths = &path, .path_count = path != NULL};
	sm_renderer_destroy(rig->renderer);
	rig->renderer = sm_renderer_create_with(get_proc, &driver, NULL);
	assert_non_null(rig->renderer);
	sm_renderer_describe(rig->renderer, ignore_fact, NULL);
	rig_set_shadows(rig, options);
}

/* With one incomplete framebuffer after so many; whether it was drawn all the same. */
static bool draw_spoiled(struct rig *rig, unsigned int good_ones)
{
	struct canvas canvas;
	canvas_init(&canvas, GL_RGBA8, SIZE, SIZE);
	const struct sm_view view = {
		.camera = camera, .framebuffer = canvas.framebuffer, .width = SIZE, .height = SIZE};
	good = good_ones;
	spoiled = false;
	bool drawn = sm_renderer_draw(rig->renderer, rig->scene, &view, NULL);
	if (spoils == TEXTURES)
		rig->problems = 0; /* they are wanted */
	good = ALL_GOOD;
	canvas_finish(&canvas);
	return drawn;
}

/* With the first target, the second, ... until there is none left to spoil; how many frames failed.
 */
static unsigned int spoil_one_by_one(
	struct rig *rig, const char *path, const struct sm_shadow_options *options)
{
	struct visibility right, seen;
	unsigned int failures = 0;
	use_renderer(rig, path, options);
	visibility_draw(&right, rig, rig->scene, &camera, SIZE, SIZE);
	spoiled = true;
	for (unsigned int i = 0; spoiled; i++) {
		use_renderer(rig, path, options);
		failures += !draw_spoiled(rig, i);
		visibility_draw(&seen, rig, rig->scene, &camera, SIZE, SIZE);
		assert_int_equal(visibility_compare(&right, &seen).differing, 0);
		visibility_finish(&seen);
	}
	visibility_finish(&right);
	return failures;
}

static void what_could_not_be_made_is_made_later(void **state)
{
	struct rig *rig = *state;
	static const struct {
		const char *path;
		struct sm_shadow_options options;
		unsigned int targets;
	} cases[] = {
		/* Two shadow maps and the smoothie buffer, then one with its plain depths. */
		{NULL, {.technique = "smoothie"}, 3},
		{NULL, {.technique = "smoothie", .passes = 2}, 4},
		{"depth=rgba8", {.technique = "smoothie"}, 5},
		{NULL, {.technique = "smoothie-two-sided"}, 4},
		{NULL, {.technique = "vsm"}, 4},
		{NULL, {.technique = "maps", .samples = 4}, 1},
		/* A layer and its depths; one to find the raster grid by can be missed. */
		{NULL, {.technique = "gather", .sampling = SM_SAMPLING_DENSE}, 2},
		/* Points of the view as well, and cells. */
		{NULL, {.technique = "gather", .sampling = SM_SAMPLING_SPARSE}, 4},
		{NULL, {.technique = "auto", .sampling = SM_SAMPLING_SPARSE}, 4},
		/* Two shadow maps, two passes of smoothies, the depths of both, the picture. */
		{NULL, {.precision = SM_PRECISION_HALF}, 7},
		{NULL, {.precision = SM_PRECISION_FIXED12}, 7},
	};
	parts_add_shadowed_square(rig->scene);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_shadow_options options = cases[i].options;
		options.map_size = 64;
		unsigned int failures = spoil_one_by_one(rig, cases[i].path, &options);
		if (failures != cases[i].targets)
			fail_msg("case %zu: %u targets and not %u", i, failures, cases[i].targets);
	}
}

/* The driver says so at the frame's end. */
static void what_has_no_memory_has_some_later(void **state)
{
	struct rig *rig = *state;
	static const struct {
		struct sm_shadow_options options;
		unsigned int textures;
	} cases[] = {
		/* Two shadow maps and the smoothie buffer. */
		{{.technique = "smoothie"}, 3},
		/* A layer, its depths, the edges. */
		{{.technique = "gather", .sampling = SM_SAMPLING_DENSE}, 3},
	};
	parts_add_shadowed_square(rig->scene);
	spoils = TEXTURES;
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_shadow_options options = cases[i].options;
		options.map_size = 64;
		unsigned int failures = spoil_one_by_one(rig, NULL, &options);
		if (failures != cases[i].textures)
			fail_msg(
				"case %zu: %u textures and not %u", i, failures, cases[i].textures);
	}
	spoils = FRAMEBUFFERS;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(what_could_not_be_made_is_made_later),
		rig_test(what_has_no_memory_has_some_later),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
