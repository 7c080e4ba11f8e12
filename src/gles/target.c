/* SPDX-License-Identifier: MIT */
#include "gles/target.h"
#include <math.h>
#include <stdlib.h>

/* Texels around a part of the screen: one that vertices may be snapped across, and one to spare. */
#define PART_SLACK 2.0f

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

GLuint target_create_view(const struct target *target, struct gl *gl, enum storage_owner owner,
	GLenum internal_format)
{
	if (gl->TextureView == NULL)
		return 0;
	gl_take_error(gl);
	GLuint view = gl_create_texture(gl, owner);
	gl->ActiveTexture(GL_TEXTURE0);
	gl->TextureView(view, GL_TEXTURE_2D, target->texture, internal_format, 0, 1, 0, 1);
	gl->BindTexture(GL_TEXTURE_2D, view);
	set_texture_parameters(gl, GL_TEXTURE_2D);
	if (gl_take_error(gl) != NULL)
		gl_delete_texture(gl, &view);
	return view;
}

struct shared_target {
	struct target target;
	enum storage_owner owner;
	GLenum internal_format;
	size_t users;
	struct shared_target *next;
};

static struct shared_target *find_shared(
	struct gl *gl, enum storage_owner owner, GLsizei size, GLenum internal_format)
{
	struct shared_target *shared = gl->shared_targets;
	while (shared != NULL && (shared->owner != owner || shared->target.size != size ||
					 shared->internal_format != internal_format))
		shared = shared->next;
	return shared;
}

static void destroy_shared(struct shared_target *shared, struct gl *gl)
{
	shared->target.shared = NULL;
	target_finish(&shared->target, gl);
	free(shared);
}

static struct shared_target *add_shared(struct gl *gl, enum storage_owner owner, GLsizei size,
	GLenum internal_format, GLenum attachment, struct sm_error *error)
{
	struct shared_target *shared = calloc(1, sizeof(*shared));
	if (shared == NULL) {
		error_no_memory(error);
		return NULL;
	}
	uint32_t light = gl->light;
	gl->light = SM_NONE;
	bool made =
		target_init(&shared->target, gl, owner, size, internal_format, attachment, error);
	gl->light = light;
	if (!made) {
		destroy_shared(shared, gl);
		return NULL;
	}
	shared->owner = owner;
	shared->internal_format = internal_format;
	shared->target.shared = shared;
	shared->next = gl->shared_targets;
	gl->shared_targets = shared;
	return shared;
}

bool target_init_shared(struct target *target, struct gl *gl, enum storage_owner owner,
	GLsizei size, GLenum internal_format, GLenum attachment, struct sm_error *error)
{
	struct shared_target *shared = find_shared(gl, owner, size, internal_format);
	if (shared == NULL)
		shared = add_shared(gl, owner, size, internal_format, attachment, error);
	if (shared == NULL)
		return false;
	shared->users++;
	*target = shared->target;
	gl->ActiveTexture(GL_TEXTURE0);
	gl->BindTexture(GL_TEXTURE_2D, target->texture);
	gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
	return true;
}

size_t targets_shared_bytes(const struct gl *gl)
{
	size_t bytes = 0;
	for (const struct shared_target *shared = gl->shared_targets; shared != NULL;
		shared = shared->next)
		bytes += sizeof(*shared);
	return bytes;
}

static void leave_shared(struct shared_target *shared, struct gl *gl)
{
	if (--shared->users > 0)
		return;
	struct shared_target **link = &gl->shared_targets;
	while (*link != shared)
		link = &(*link)->next;
	*link = shared->next;
	destroy_shared(shared, gl);
}

void target_finish(struct target *target, struct gl *gl)
{
	if (target->shared != NULL) {
		leave_shared(target->shared, gl);
		*target = (struct target){0};
		return;
	}
	gl_delete_framebuffer(gl, &target->framebuffer);
	gl_delete_texture(gl, &target->texture);
	target->whole = false;
}

void target_bind(const struct target *target, struct gl *gl)
{
	gl_begin_pass(gl);
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

/* First and last of the inner texels that a range of NDC may touch. */
static void find_texels(GLsizei size, float min, float max, GLint *first, GLsizei *count)
{
	float half = 0.5f * (float)size;
	float from = fmaxf(floorf(half * min + half) - PART_SLACK, 1.0f);
	float end = fminf(ceilf(half * max + half) + PART_SLACK, (float)(size - 1));
	*first = from < end ? (GLint)from : 0;
	*count = from < end ? (GLsizei)(end - from) : 0;
}

struct target_area target_part(const struct target *target, const struct screen_box *part)
{
	struct target_area area;
	find_texels(target->size, part->min[0], part->max[0], &area.x, &area.width);
	find_texels(target->size, part->min[1], part->max[1], &area.y, &area.height);
	return area.width > 0 && area.height > 0 ? area : (struct target_area){0};
}

struct screen_box target_part_reach(const struct target *target, const struct screen_box *part)
{
	struct target_area area = target_part(target, part);
	float texel = 2.0f / (float)target->size;
	if (screen_box_is_all(part))
		return *part;
	if (area.width == 0 || area.height == 0)
		return screen_box_none();
	const struct screen_box box = {
		{(float)area.x * texel - 1.0f, (float)area.y * texel - 1.0f},
		{(float)(area.x + area.width) * texel - 1.0f,
			(float)(area.y + area.height) * texel - 1.0f},
	};
	return screen_box_widened(&box, PART_SLACK * texel);
}

void target_restrict_clear(
	const struct target *target, const struct screen_box *part, struct gl *gl)
{
	if (screen_box_is_all(part))
		gl->Disable(GL_SCISSOR_TEST);
	else
		target_restrict(target_part(target, part), gl);
}

void target_restrict(struct target_area area, struct gl *gl)
{
	gl->Enable(GL_SCISSOR_TEST);
	gl->Scissor(area.x, area.y, area.width, area.height);
}
