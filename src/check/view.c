/* SPDX-License-Identifier: MIT */
#include "check/view.h"
#include "base/array.h"
#include "base/error.h"
#include <GLES3/gl3.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const scenes[] = {
	"cylinder", "boxes", "fence", "knot", "urchin", "debris", "primitives"};

const char *check_scene_name(size_t index)
{
	return index < sizeof(scenes) / sizeof(scenes[0]) ? scenes[index] : NULL;
}

static void attach(
	const struct check_view *view, GLenum attachment, GLuint buffer, GLenum internal_format)
{
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorage(
		GL_RENDERBUFFER, internal_format, (GLsizei)view->width, (GLsizei)view->height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
}

static bool init_framebuffer(struct check_view *view, struct sm_error *error)
{
	glGenFramebuffers(1, &view->framebuffer);
	glGenRenderbuffers(2, view->buffers);
	glBindFramebuffer(GL_FRAMEBUFFER, view->framebuffer);
	attach(view, GL_COLOR_ATTACHMENT0, view->buffers[0], GL_RGBA8);
	attach(view, GL_DEPTH_ATTACHMENT, view->buffers[1], GL_DEPTH_COMPONENT24);
	return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ||
	       error_set(error, SM_ERROR_MACHINE, "the driver gives no framebuffer of %ux%u",
		       view->width, view->height);
}

bool check_view_init(struct check_view *view, const char *scene, uint32_t width, uint32_t height,
	struct sm_error *error)
{
	char source[64];
	*view = (struct check_view){.width = width, .height = height};
	snprintf(source, sizeof(source), "builtin:%s", scene);
	if (!stage_load(&view->stage, source, NULL, 0, error))
		return false;
	stage_set_size(&view->stage, width, height);
	view->rgba = array_alloc(height, 4 * (size_t)width);
	return view->rgba != NULL ? init_framebuffer(view, error) : error_no_memory(error);
}

void check_view_finish(struct check_view *view)
{
	if (view->framebuffer != 0) {
		glDeleteFramebuffers(1, &view->framebuffer);
		glDeleteRenderbuffers(2, view->buffers);
	}
	free(view->rgba);
	stage_finish(&view->stage);
	*view = (struct check_view){0};
}

/* OpenGL has rows from the bottom. */
static void decode(const struct check_view *view, uint16_t *values)
{
	size_t width = view->width;
	for (size_t y = 0; y < view->height; y++) {
		const uint8_t *row = view->rgba + 4 * width * (view->height - 1 - y);
		for (size_t x = 0; x < width; x++)
			values[y * width + x] = (uint16_t)(row[4 * x] << 8 | row[4 * x + 1]);
	}
}

bool check_view_draw(struct check_view *view, struct sm_renderer *renderer, uint16_t *values,
	struct sm_error *error)
{
	struct sm_view drawn = {
		.camera = view->stage.camera,
		.framebuffer = view->framebuffer,
		.width = view->width,
		.height = view->height,
		.visibility_of = 0,
	};
	if (!sm_renderer_draw(renderer, view->stage.scene, &drawn, error))
		return false;
	glBindFramebuffer(GL_FRAMEBUFFER, view->framebuffer);
	glReadPixels(0, 0, (GLsizei)view->width, (GLsizei)view->height, GL_RGBA, GL_UNSIGNED_BYTE,
		view->rgba);
	GLenum code = glGetError();
	if (code != GL_NO_ERROR)
		return error_set(error, SM_ERROR_MACHINE, "GL has error 0x%04x", code);
	decode(view, values);
	return true;
}
