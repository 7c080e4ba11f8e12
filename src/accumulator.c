/* SPDX-License-Identifier: MIT */
#include "accumulator.h"
#include "gles/target.h"

/* Colour and depth. */
static uint64_t bytes_of(uint32_t width, uint32_t height)
{
	return texture_bytes(GL_SRGB8_ALPHA8, (GLsizei)width, (GLsizei)height, 1) +
	       texture_bytes(GL_DEPTH_COMPONENT24, (GLsizei)width, (GLsizei)height, 1);
}

static GLuint make_texture(struct gl *gl, GLenum format, uint32_t width, uint32_t height)
{
	GLuint texture = gl_create_texture(gl);
	gl->ActiveTexture(GL_TEXTURE0);
	gl->BindTexture(GL_TEXTURE_2D, texture);
	gl->TexStorage2D(GL_TEXTURE_2D, 1, format, (GLsizei)width, (GLsizei)height);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	return texture;
}

static bool make(struct accumulator *accumulator, struct gl *gl, uint32_t width, uint32_t height,
	struct sm_error *error)
{
	gl_take_error(gl);
	accumulator_finish(accumulator, gl);
	accumulator->color = make_texture(gl, GL_SRGB8_ALPHA8, width, height);
	accumulator->depth = make_texture(gl, GL_DEPTH_COMPONENT24, width, height);
	accumulator->framebuffer = gl_create_framebuffer(gl);
	gl->BindFramebuffer(GL_FRAMEBUFFER, accumulator->framebuffer);
	gl->FramebufferTexture2D(
		GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, accumulator->color, 0);
	gl->FramebufferTexture2D(
		GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, accumulator->depth, 0);
	const char *problem = gl_take_error(gl);
	if (problem == NULL &&
		gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
		problem = "incomplete";
	if (problem != NULL)
		return error_set(error, SM_ERROR_MACHINE,
			"no framebuffer of %ux%u pixels for several lights: %s", width, height,
			problem);
	gl->target_bytes += bytes_of(width, height);
	accumulator->width = width;
	accumulator->height = height;
	return true;
}

bool accumulator_bind(struct accumulator *accumulator, struct gl *gl, uint32_t width,
	uint32_t height, struct sm_error *error)
{
	if (accumulator->width != width || accumulator->height != height)
		return make(accumulator, gl, width, height, error);
	gl->BindFramebuffer(GL_FRAMEBUFFER, accumulator->framebuffer);
	return true;
}

void accumulator_finish(struct accumulator *accumulator, struct gl *gl)
{
	gl_delete_framebuffer(gl, &accumulator->framebuffer);
	gl_delete_texture(gl, &accumulator->color);
	gl_delete_texture(gl, &accumulator->depth);
	gl->target_bytes -= bytes_of(accumulator->width, accumulator->height);
	accumulator->width = accumulator->height = 0;
}

bool accumulator_copy(
	const struct accumulator *accumulator, struct gpu *gpu, struct sm_error *error)
{
	struct program_key key = {.kind = PROGRAM_COPY};
	if (program_use(&gpu->programs, &gpu->gl, key, error) == NULL)
		return false;
	gpu_fill_viewport(gpu, accumulator->color);
	return true;
}
