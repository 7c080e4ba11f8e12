/* SPDX-License-Identifier: MIT */
#include "app/offscreen.h"
#include "base/error.h"
#include "base/log.h"
#include <GLES3/gl3.h>

static bool check_size(uint32_t width, uint32_t height, struct sm_error *error)
{
	GLint buffer = 0, texture = 0, viewport[2] = {0};
	glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
	glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
	glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
	GLint side = buffer < texture ? buffer : texture;
	GLint max_width = side < viewport[0] ? side : viewport[0];
	GLint max_height = side < viewport[1] ? side : viewport[1];
	if (width > 0 && height > 0 && width <= (GLuint)max_width && height <= (GLuint)max_height)
		return true;
	return error_set(error, SM_ERROR_INPUT,
		"a picture of %ux%u: this driver draws 1x1 to %dx%d", width, height, max_width,
		max_height);
}

static GLsizei available_samples(GLenum color, uint32_t wanted)
{
	GLint color_max = 1, depth_max = 1;
	if (wanted <= 1)
		return 0;
	glGetInternalformativ(GL_RENDERBUFFER, color, GL_SAMPLES, 1, &color_max);
	glGetInternalformativ(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, GL_SAMPLES, 1, &depth_max);
	GLint max = color_max < depth_max ? color_max : depth_max;
	if ((GLint)wanted <= max)
		return (GLsizei)wanted;
	log_info("%u samples a pixel asked, the driver has %d", wanted, max);
	return max > 1 ? max : 0;
}

static void attach_buffer(const struct offscreen *target, GLenum attachment, uint32_t buffer,
	GLenum format, GLsizei samples)
{
	glBindRenderbuffer(GL_RENDERBUFFER, buffer);
	glRenderbufferStorageMultisample(
		GL_RENDERBUFFER, samples, format, (GLsizei)target->width, (GLsizei)target->height);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
}

static void attach_texture(const struct offscreen *target, GLenum format)
{
	glBindTexture(GL_TEXTURE_2D, target->texture);
	glTexStorage2D(GL_TEXTURE_2D, 1, format, (GLsizei)target->width, (GLsizei)target->height);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glFramebufferTexture2D(
		GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target->texture, 0);
	glBindTexture(GL_TEXTURE_2D, 0);
}

static bool check_complete(const struct offscreen *target, struct sm_error *error)
{
	GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
	GLenum code = glGetError();
	if (code == GL_NO_ERROR && status == GL_FRAMEBUFFER_COMPLETE)
		return true;
	return error_set(error, SM_ERROR_MACHINE,
		"the driver gives no framebuffer of %ux%u (GL error 0x%04x, status 0x%04x)",
		target->width, target->height, code, status);
}

bool offscreen_init(struct offscreen *target, enum offscreen_kind kind, uint32_t width,
	uint32_t height, uint32_t samples, struct sm_error *error)
{
	GLenum format = kind == OFFSCREEN_PICTURE ? GL_SRGB8_ALPHA8 : GL_RGBA8;
	*target = (struct offscreen){.width = width, .height = height};
	if (!check_size(width, height, error))
		return false;
	GLsizei multisamples = available_samples(format, samples);
	glGenRenderbuffers(2, target->buffers);
	glGenTextures(1, &target->texture);
	glGenFramebuffers(1, &target->framebuffer);
	target->resolved = target->framebuffer;
	if (multisamples > 0)
		glGenFramebuffers(1, &target->resolved);
	glBindFramebuffer(GL_FRAMEBUFFER, target->resolved);
	attach_texture(target, format);
	if (multisamples > 0) {
		if (!check_complete(target, error))
			return false;
		glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
		attach_buffer(
			target, GL_COLOR_ATTACHMENT0, target->buffers[1], format, multisamples);
	}
	attach_buffer(target, GL_DEPTH_ATTACHMENT, target->buffers[0], GL_DEPTH_COMPONENT24,
		multisamples);
	return check_complete(target, error);
}

void offscreen_resolve(const struct offscreen *target)
{
	GLint width = (GLint)target->width, height = (GLint)target->height;
	if (target->resolved == target->framebuffer)
		return;
	glBindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
	glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target->resolved);
	glBlitFramebuffer(
		0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

bool offscreen_read(const struct offscreen *target, uint8_t *rgba, struct sm_error *error)
{
	glBindFramebuffer(GL_FRAMEBUFFER, target->resolved);
	glReadPixels(0, 0, (GLsizei)target->width, (GLsizei)target->height, GL_RGBA,
		GL_UNSIGNED_BYTE, rgba);
	GLenum code = glGetError();
	return code == GL_NO_ERROR ||
	       error_set(error, SM_ERROR_MACHINE,
		       "reading the picture back fails (GL error 0x%04x)", code);
}

void offscreen_decode_visibility(const struct offscreen *target, const uint8_t *rgba, float *seen)
{
	uint32_t width = target->width, height = target->height;
	for (uint32_t y = 0; y < height; y++) {
		const uint8_t *row = rgba + 4 * (size_t)width * (height - 1 - y);
		for (uint32_t x = 0; x < width; x++)
			seen[(size_t)y * width + x] =
				(float)(row[4 * x] * 256 + row[4 * x + 1]) / 65535.0f;
	}
}

void offscreen_finish(struct offscreen *target)
{
	if (target->framebuffer != 0) {
		if (target->resolved != target->framebuffer)
			glDeleteFramebuffers(1, &target->resolved);
		glDeleteFramebuffers(1, &target->framebuffer);
		glDeleteRenderbuffers(2, target->buffers);
		glDeleteTextures(1, &target->texture);
	}
	*target = (struct offscreen){0};
}
