/* SPDX-License-Identifier: MIT */
#include "app/screen.h"
#include "base/array.h"
#include "base/error.h"
#include <GLES3/gl3.h>
#include <stdlib.h>
#include <string.h>

static bool is_turned(const struct display_target *wanted)
{
	return wanted->rotation % 180 != 0;
}

/* A framebuffer of the screen's size, to be read from. */
static bool init_framebuffer(struct screen *screen, struct sm_error *error)
{
	const struct display_target *wanted = &screen->wanted;
	GLsizei width = (GLsizei)(is_turned(wanted) ? wanted->height : wanted->width);
	GLsizei height = (GLsizei)(is_turned(wanted) ? wanted->width : wanted->height);
	glGenFramebuffers(1, &screen->framebuffer);
	glGenRenderbuffers(1, &screen->buffer);
	glBindFramebuffer(GL_FRAMEBUFFER, screen->framebuffer);
	glBindRenderbuffer(GL_RENDERBUFFER, screen->buffer);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
	glFramebufferRenderbuffer(
		GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, screen->buffer);
	return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ||
	       error_set(error, SM_ERROR_MACHINE, "the driver gives no framebuffer of %dx%d", width,
		       height);
}

/* What the picture's bytes are good for as they are needs no copy. */
static bool needs_copy(const struct display_target *wanted)
{
	static const uint8_t bytes[3] = {8, 8, 8};
	return !wanted->takes_pixels || wanted->rotation != 0 ||
	       memcmp(wanted->bits, bytes, sizeof(bytes)) != 0;
}

static bool init_pixels(struct screen *screen, struct sm_error *error)
{
	const struct display_target *wanted = &screen->wanted;
	screen->pixels = array_alloc(wanted->height, 4 * (size_t)wanted->width);
	if (screen->pixels == NULL)
		return error_no_memory(error);
	return !needs_copy(wanted) || init_framebuffer(screen, error);
}

static bool is_same(const struct display_target *a, const struct display_target *b)
{
	return a->width == b->width && a->height == b->height && a->rotation == b->rotation &&
	       a->takes_pixels == b->takes_pixels && memcmp(a->bits, b->bits, sizeof(a->bits)) == 0;
}

bool screen_fit(struct screen *screen, const struct display_target *wanted, struct stage *stage,
	struct sm_error *error)
{
	if (is_same(&screen->wanted, wanted))
		return true;
	screen_finish(screen);
	if (!offscreen_init(&screen->target, OFFSCREEN_PICTURE, wanted->width, wanted->height,
		    stage->output.samples, error))
		return false;
	stage_set_size(stage, wanted->width, wanted->height);
	screen->wanted = *wanted;
	if (!wanted->takes_pixels || init_pixels(screen, error))
		return true;
	screen_finish(screen);
	return false;
}

static bool read_pixels(const struct screen *screen, struct sm_error *error)
{
	const struct display_target *wanted = &screen->wanted;
	GLsizei width = (GLsizei)(is_turned(wanted) ? wanted->height : wanted->width);
	GLsizei height = (GLsizei)(is_turned(wanted) ? wanted->width : wanted->height);
	glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, screen->pixels);
	GLenum code = glGetError();
	return code == GL_NO_ERROR ||
	       error_set(error, SM_ERROR_MACHINE, "reading the screen back fails (GL error 0x%04x)",
		       code);
}

static struct sm_view view_of(const struct screen *screen, const struct stage *stage)
{
	return (struct sm_view){
		.camera = stage->camera,
		.framebuffer = screen->target.framebuffer,
		.width = screen->wanted.width,
		.height = screen->wanted.height,
		.visibility_of = SM_NONE,
	};
}

bool screen_is_current(
	const struct screen *screen, struct sm_renderer *renderer, const struct stage *stage)
{
	struct sm_view view = view_of(screen, stage);
	return sm_renderer_is_current(renderer, stage->scene, &view);
}

bool screen_draw(struct screen *screen, struct sm_renderer *renderer, const struct stage *stage,
	struct sm_error *error)
{
	const struct display_target *wanted = &screen->wanted;
	struct sm_view view = view_of(screen, stage);
	struct sm_screen copy = {
		.texture = screen->target.texture,
		.width = wanted->width,
		.height = wanted->height,
		.framebuffer = screen->framebuffer,
		.rotation = wanted->rotation,
		.bits = {wanted->bits[0], wanted->bits[1], wanted->bits[2]},
	};
	if (!sm_renderer_draw(renderer, stage->scene, &view, error))
		return false;
	offscreen_resolve(&screen->target);
	if (!needs_copy(wanted))
		return offscreen_read(&screen->target, screen->pixels, error);
	return sm_renderer_copy_to_screen(renderer, &copy, error) &&
	       (!wanted->takes_pixels || read_pixels(screen, error));
}

void screen_finish(struct screen *screen)
{
	if (screen->framebuffer != 0) {
		glDeleteFramebuffers(1, &screen->framebuffer);
		glDeleteRenderbuffers(1, &screen->buffer);
	}
	free(screen->pixels);
	offscreen_finish(&screen->target);
	*screen = (struct screen){0};
}
