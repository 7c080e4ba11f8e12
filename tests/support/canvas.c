/* SPDX-License-Identifier: MIT */
#include "canvas.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static GLuint attach(GLenum format, GLenum attachment, uint32_t width, uint32_t height)
{
	GLuint buffer;
	glGenRenderbuffers(1, &buffer);
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorage(GL_RENDERBUFFER, format, (GLsizei)width, (GLsizei)height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
	return buffer;
}

void canvas_init(struct canvas *canvas, GLenum color_format, uint32_t width, uint32_t height)
{
	*canvas = (struct canvas){.width = width, .height = height};
	glGenFramebuffers(1, &canvas->framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
	canvas->color = attach(color_format, GL_COLOR_ATTACHMENT0, width, height);
	canvas->depth = attach(GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, width, height);
	assert_int_equal(glCheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
}

void canvas_finish(struct canvas *canvas)
{
	glDeleteFramebuffers(1, &canvas->framebuffer);
	glDeleteRenderbuffers(1, &canvas->color);
	glDeleteRenderbuffers(1, &canvas->depth);
	*canvas = (struct canvas){0};
}

uint8_t *canvas_read(const struct canvas *canvas)
{
	size_t stride = (size_t)canvas->width * 4, height = canvas->height;
	uint8_t *rgba = malloc(stride * height), *row = malloc(stride);
	assert_true(rgba != NULL && row != NULL);
	glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
	glReadPixels(0, 0, (GLsizei)canvas->width, (GLsizei)canvas->height, GL_RGBA,
		GL_UNSIGNED_BYTE, rgba);
	for (size_t y = 0; y < height / 2; y++) {
		uint8_t *upper = rgba + y * stride, *lower = rgba + (height - 1 - y) * stride;
		memcpy(row, upper, stride);
		memcpy(upper, lower, stride);
		memcpy(lower, row, stride);
	}
	free(row);
	return rgba;
}
