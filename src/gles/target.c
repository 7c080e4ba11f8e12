/* SPDX-License-Identifier: MIT */
#include "gles/target.h"

static void set_texture_parameters(struct gl *gl, GLenum kind)
{
	gl->TexParameteri(kind, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl->TexParameteri(kind, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	gl->TexParameteri(kind, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	gl->TexParameteri(kind, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/* Makes the target's texture of that kind, bound. */
static void create_texture(
	struct target *target, struct gl *gl, GLenum kind, enum storage_owner owner)
{
	gl_take_error(gl);
	target->texture = gl_create_texture(gl, owner);
	gl->ActiveTexture(GL_TEXTURE0);
	gl->BindTexture(kind, target->texture);
	set_texture_parameters(gl, kind);
}

static void create_framebuffer(struct target *target, struct gl *gl)
{
	target->framebuffer = gl_create_framebuffer(gl);
	gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
	if (target->attachment == GL_DEPTH_ATTACHMENT) {
		GLenum none = GL_NONE;
		gl->DrawBuffers(1, &none);
		gl->ReadBuffer(GL_NONE);
	}
}

static bool check_target(
	struct target *target, struct gl *gl, GLsizei layers, struct sm_error *error)
{
	const char *problem = gl_take_error(gl);
	if (problem == NULL &&
		gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
		problem = "the driver cannot render to this format";
	if (problem != NULL && layers > 1)
		return error_set(error, SM_ERROR_MACHINE, "no %d textures of %dx%d texels: %s",
			layers, target->size, target->size, problem);
	if (problem != NULL)
		return error_set(error, SM_ERROR_MACHINE, "no texture of %dx%d texels: %s",
			target->size, target->size, problem);
	target->whole = true;
	return true;
}

bool target_init(struct target *target, struct gl *gl, enum storage_owner owner, GLsizei size,
	GLenum internal_format, GLenum attachment, struct sm_error *error)
{
	*target = (struct target){.size = size, .attachment = attachment};
	create_texture(target, gl, GL_TEXTURE_2D, owner);
	gl_store_texture(gl, target->texture, internal_format, size, size);
	create_framebuffer(target, gl);
	gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, target->texture, 0);
	return check_target(target, gl, 1, error);
}

bool target_init_layers(struct target *target, struct gl *gl, enum storage_owner owner,
	GLsizei size, GLsizei layers, GLenum internal_format, GLenum attachment,
	struct sm_error *error)
{
	*target = (struct target){.size = size, .attachment = attachment};
	create_texture(target, gl, GL_TEXTURE_2D_ARRAY, owner);
	gl_store_layers(gl, target->texture, internal_format, size, layers);
	create_framebuffer(target, gl);
	target_bind_layer(target, gl, 0);
	return check_target(target, gl, layers, error);
}

void target_finish(struct target *target, struct gl *gl)
{
	gl_delete_framebuffer(gl, &target->framebuffer);
	gl_delete_texture(gl, &target->texture);
	target->whole = false;
}

void target_bind(const struct target *target, struct gl *gl)
{
	gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
	gl->Viewport(0, 0, target->size, target->size);
}

void target_bind_layer(const struct target *target, struct gl *gl, GLint layer)
{
	target_bind(target, gl);
	gl->FramebufferTextureLayer(GL_FRAMEBUFFER, target->attachment, target->texture, 0, layer);
}

struct target_area target_inside(const struct target *target)
{
	GLsizei inside = target->size > 2 ? target->size - 2 : 0;
	return (struct target_area){1, 1, inside, inside};
}

void target_restrict(struct target_area area, struct gl *gl)
{
	gl->Enable(GL_SCISSOR_TEST);
	gl->Scissor(area.x, area.y, area.width, area.height);
}
