/* SPDX-License-Identifier: MIT */
/* When passes wait for those before them. */
#include "canvas.h"
#include "parts.h"
#include "platform.h"
#include "visibility.h"
#include <GLES3/gl3.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define SIZE 64

/* Of a frame: how often it waited, and clears that came with draws unfinished. */
static unsigned int waits, late_clears;
static bool unfinished;

static void GL_APIENTRY count_finish(void)
{
	waits++;
	unfinished = false;
	glFinish();
}

static void GL_APIENTRY note_draw(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
	unfinished = true;
	glDrawElements(mode, count, type, indices);
}

static void GL_APIENTRY check_clear(GLenum buffer, GLint index, const GLfloat *value)
{
	late_clears += unfinished;
	glClearBufferfv(buffer, index, value);
}

static void (*get_proc(const char *name))(void)
{
	static const struct {
		const char *name;
		void (*function)(void);
	} watched[] = {
		{"glFinish", count_finish},
		{"glDrawElements", (void (*)(void))note_draw},
		{"glClearBufferfv", (void (*)(void))check_clear},
	};
	for (size_t i = 0; i < sizeof(watched) / sizeof(watched[0]); i++)
		if (strcmp(watched[i].name, name) == 0)
			return watched[i].function;
	return platform_get_proc(name);
}

static void use_renderer(struct rig *rig, const char *path, const char *technique)
{
	const struct sm_driver_options driver = {.paths = &path, .path_count = 1};
	const struct sm_shadow_options options = {.technique = technique, .map_size = 64};
	sm_renderer_destroy(rig->renderer);
	rig->renderer = sm_renderer_create_with(get_proc, &driver, NULL);
	assert_non_null(rig->renderer);
	rig_set_shadows(rig, &options);
}

static void draw(struct rig *rig, const struct canvas *canvas, float height)
{
	const struct sm_view view = {.camera = {.eye = {0, height, 6}, .up = {0, 1, 0}, .fov = 40},
		.framebuffer = canvas->framebuffer,
		.width = SIZE,
		.height = SIZE,
		.visibility_of = SM_NONE};
	waits = late_clears = 0;
	unfinished = false;
	rig_draw(rig, rig->scene, &view);
}

/* Light passes and the picture, then another view with the same shadow. */
static void passes_wait_before_they_clear(void **state)
{
	static const char *const techniques[] = {
		"hard", "pcf", "smoothie", "smoothie-two-sided", "maps", "vsm"};
	struct rig *rig = *state;
	struct canvas canvas;
	parts_add_shadowed_square(rig->scene);
	canvas_init(&canvas, GL_SRGB8_ALPHA8, SIZE, SIZE);
	for (size_t i = 0; i < sizeof(techniques) / sizeof(techniques[0]); i++) {
		if (!rig_can_draw(techniques[i]))
			continue;
		uint8_t *seen[2];
		for (int finished = 0; finished < 2; finished++) {
			use_renderer(
				rig, finished ? "passes=finished" : "passes=queued", techniques[i]);
			draw(rig, &canvas, 3);
			/* Probes wait as well, once. */
			draw(rig, &canvas, 3);
			assert_true(sm_renderer_set_skips(rig->renderer, "-light,-static", NULL));
			draw(rig, &canvas, 3);
			assert_int_equal(waits > 0, finished);
			assert_int_equal(late_clears == 0, finished);
			seen[finished] = canvas_read(&canvas);
			assert_true(sm_renderer_set_skips(rig->renderer, "+light,+static", NULL));
			draw(rig, &canvas, 3.1f);
			assert_int_equal(waits, 0);
		}
		assert_memory_equal(seen[0], seen[1], 4 * SIZE * SIZE);
		free(seen[0]);
		free(seen[1]);
	}
	canvas_finish(&canvas);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		rig_test(passes_wait_before_they_clear),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
