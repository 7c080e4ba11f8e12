/* SPDX-License-Identifier: MIT */
/* What is made and destroyed again and again. */
#include "check/cases.h"
#include "check/context.h"
#include "check/view.h"
#include "platform.h"
#include <GLES3/gl3.h>

#define TIMES 100

/* Draws something small, so that the context has done work. */
static bool draw(const struct check_context *context, struct sm_error *error)
{
	struct check_view view;
	uint16_t values[16 * 16];
	struct sm_renderer *renderer =
		sm_renderer_create_with(platform_get_proc, &context->driver, error);
	bool drawn = renderer != NULL && check_view_init(&view, "cylinder", 16, 16, error);
	if (drawn) {
		drawn = check_view_draw(&view, renderer, values, error);
		check_view_finish(&view);
	}
	sm_renderer_destroy(renderer);
	return drawn;
}

static bool clear(struct sm_error *error)
{
	GLuint texture, framebuffer;
	static const GLfloat color[4] = {.25f, .5f, .75f, 1};
	uint8_t pixel[4] = {0};
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, 1, 1);
	glGenFramebuffers(1, &framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
	glClearBufferfv(GL_COLOR, 0, color);
	glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
	glDeleteFramebuffers(1, &framebuffer);
	glDeleteTextures(1, &texture);
	return (pixel[0] / 2 == 32 && pixel[2] / 2 == 95) ||
	       error_set(error, SM_ERROR_MACHINE, "a clear gives %d,%d,%d,%d", pixel[0], pixel[1],
		       pixel[2], pixel[3]);
}

static bool make_contexts(struct check_context *context, uint32_t *made, struct sm_error *error)
{
	for (*made = 0; *made < TIMES; ++*made) {
		platform_destroy(context->platform);
		context->platform = platform_create_on(context->device, context->debug, error);
		if (context->platform == NULL || !clear(error))
			return false;
	}
	return draw(context, error);
}

static void run_contexts(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	struct sm_error error;
	uint32_t made;
	(void)item;
	if (make_contexts(context, &made, &error))
		check_pass(result, "%u contexts made and destroyed", made);
	else
		check_fail(result, "after %u contexts: %s", made, error.text);
}

static void run_renderers(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	struct sm_error error;
	(void)item;
	for (uint32_t made = 0; made < TIMES / 5; made++) {
		if (draw(context, &error))
			continue;
		check_fail(result, "after %u renderers: %s", made, error.text);
		return;
	}
	check_pass(result, "%d renderers made, used and destroyed", TIMES / 5);
}

void check_context_cases(struct check_list *list)
{
	check_list_add(list, run_contexts, NULL, "context.create-destroy");
	check_list_add(list, run_renderers, NULL, "context.renderers");
}
