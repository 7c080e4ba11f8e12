/* SPDX-License-Identifier: MIT */
#include "canvas.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static GLuint attach(const struct canvas *canvas, GLenum format, GLenum attachment, GLsizei samples)
{
	GLuint buffer;
	glGenRenderbuffers(1, &buffer);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorageMultisample(
		GL_RENDERBUFFER, samples, format, (GLsizei)canvas->width, (GLsizei)canvas->height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
	return buffer;
}

static GLuint make_framebuffer(void)
{
	GLuint framebuffer;
	glGenFramebuffers(1, &framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	return framebuffer;
}

void canvas_init_multisampled(struct canvas *canvas, GLenum color_format, uint32_t width,
	uint32_t height, GLsizei samples)
{
	GLint most = 0;
	glGetIntegerv(GL_MAX_SAMPLES, &most);
	samples = samples < most ? samples : most;
	/* One sample is no multisampling. */
	samples = samples > 1 ? samples : 0;
	*canvas = (struct canvas){.width = width, .height = height};
	if (samples > 0) {
		canvas->resolved_framebuffer = make_framebuffer();
		canvas->resolved = attach(canvas, color_format, GL_COLOR_ATTACHMENT0, 0);
	}
	canvas->framebuffer = make_framebuffer();
	canvas->color = attach(canvas, color_format, GL_COLOR_ATTACHMENT0, samples);
	canvas->depth = attach(canvas, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, samples);
	assert_int_equal(glCheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
}

void canvas_init(struct canvas *canvas, GLenum color_format, uint32_t width, uint32_t height)
{
	canvas_init_multisampled(canvas, color_format, width, height, 0);
}

void canvas_finish(struct canvas *canvas)
{
	glDeleteFramebuffers(1, &canvas->framebuffer);
	glDeleteRenderbuffers(1, &canvas->color);
	glDeleteRenderbuffers(1, &canvas->depth);
	glDeleteFramebuffers(1, &canvas->resolved_framebuffer);
	glDeleteRenderbuffers(1, &canvas->resolved);
	*canvas = (struct canvas){0};
}

uint8_t *canvas_read(const struct canvas *canvas)
{
	size_t stride = (size_t)canvas->width * 4, height = canvas->height;
	uint8_t *rgba = malloc(stride * height), *row = malloc(stride);
	assert_true(rgba != NULL && row != NULL);
	glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
	if (canvas->resolved != 0) {
		GLint right = (GLint)canvas->width, top = (GLint)canvas->height;
		glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas->resolved_framebuffer);
		glBlitFramebuffer(
			0, 0, right, top, 0, 0, right, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
		glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas->resolved_framebuffer);
	}
	glReadPixels(0, 0, (GLsizei)canvas->width, (GLsizei)canvas->height, GL_RGBA,
		GL_UNSIGNED_BYTE, rgba);
	glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
	for (size_t y = 0; y < height / 2; y++) {
		uint8_t *upper = rgba + y * stride, *lower = rgba + (height - 1 - y) * stride;
		memcpy(row, upper, stride);
		memcpy(upper, lower, stride);
		memcpy(lower, row, stride);
	}
	free(row);
	return rgba;
}
