/* SPDX-License-Identifier: MIT */
#include "probe.h"
#include "base/error.h"
#include <GLES3/gl3.h>
#include <string.h>

bool probe_draws(struct sm_error *error)
{
	static const GLubyte wanted[4] = {255, 0, 255, 255};
	GLubyte pixel[4] = {0};
	GLuint framebuffer, color;
	glGenFramebuffers(1, &framebuffer);
	glGenRenderbuffers(1, &color);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glBindRenderbuffer(GL_RENDERBUFFER, color);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
	glClearColor(1.f, 0.f, 1.f, 1.f);
	glClear(GL_COLOR_BUFFER_BIT);
	glFinish();
	glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
	GLenum code = glGetError();
	glClearColor(0.f, 0.f, 0.f, 0.f);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glBindRenderbuffer(GL_RENDERBUFFER, 0);
	glDeleteRenderbuffers(1, &color);
	glDeleteFramebuffers(1, &framebuffer);
	if (code != GL_NO_ERROR)
		return error_set(
			error, SM_ERROR_MACHINE, "it fails to clear (GL error 0x%04x)", code);
	if (memcmp(pixel, wanted, sizeof(pixel)) != 0)
		return error_set(error, SM_ERROR_MACHINE, "it clears to the wrong colour");
	return true;
}
