/* SPDX-License-Identifier: MIT */
#include "gles/picture.h"

static GLuint make_texture(
	struct gl *gl, enum storage_owner owner, GLsizei width, GLsizei height, GLenum format)
{
	GLuint texture = gl_create_texture(gl, owner);
	gl->ActiveTexture(GL_TEXTURE0);
	gl_store_texture(gl, texture, format, width, height);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	gl->BindTexture(GL_TEXTURE_2D, 0);
	return texture;
}

bool picture_init(struct picture *picture, struct gl *gl, enum storage_owner owner, uint32_t width,
	uint32_t height, GLenum color_format, GLuint depth, struct sm_error *error)
{
	GLsizei w = (GLsizei)width, h = (GLsizei)height;
	*picture = (struct picture){0};
	gl_take_error(gl);
	picture->color = make_texture(gl, owner, w, h, color_format);
	if (depth == 0)
		depth = picture->depth = make_texture(gl, owner, w, h, GL_DEPTH_COMPONENT24);
	picture->framebuffer = gl_create_framebuffer(gl);
	gl->BindFramebuffer(GL_FRAMEBUFFER, picture->framebuffer);
	gl->FramebufferTexture2D(
		GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture->color, 0);
	gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
	gl->Viewport(0, 0, w, h);
	const char *problem = gl_take_error(gl);
	if (problem == NULL &&
		gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
		problem = "incomplete";
	if (problem != NULL)
		return error_set(error, SM_ERROR_MACHINE, "no framebuffer of %ux%u pixels: %s",
			width, height, problem);
	picture->width = width;
	picture->height = height;
	return true;
}

bool picture_resize(struct picture *picture, struct gl *gl, enum storage_owner owner,
	uint32_t width, uint32_t height, GLenum color_format, struct sm_error *error)
{
	if (picture->width == width && picture->height == height) {
		picture_bind(picture, gl);
		return true;
	}
	picture_finish(picture, gl);
	return picture_init(picture, gl, owner, width, height, color_format, 0, error);
}

void picture_finish(struct picture *picture, struct gl *gl)
{
	gl_delete_framebuffer(gl, &picture->framebuffer);
	gl_delete_texture(gl, &picture->color);
	gl_delete_texture(gl, &picture->depth);
	*picture = (struct picture){0};
}

void picture_bind(const struct picture *picture, struct gl *gl)
{
	gl->BindFramebuffer(GL_FRAMEBUFFER, picture->framebuffer);
	gl->Viewport(0, 0, (GLsizei)picture->width, (GLsizei)picture->height);
}
