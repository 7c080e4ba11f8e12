/* SPDX-License-Identifier: MIT */
#include "gles/gl.h"
#include "base/log.h"

bool gl_load(struct gl *gl, sm_get_proc get_proc, struct sm_error *error)
{
	*gl = (struct gl){.light = SM_NONE};
#define GL_RESOLVE(upper, name)                              \
	gl->name = (PFNGL##upper##PROC)get_proc("gl" #name); \
	if (gl->name == NULL)                                \
		return error_set(error, SM_ERROR_MACHINE,    \
			"the driver lacks gl" #name ", a function of OpenGL ES 3.0");
	GL_FUNCTIONS(GL_RESOLVE)
#undef GL_RESOLVE
	gl->BindImageTexture = (gl_bind_image_texture)get_proc("glBindImageTexture");
	return true;
}

static void GL_APIENTRY log_message(GLenum source, GLenum type, GLuint id, GLenum severity,
	GLsizei length, const GLchar *message, const void *data)
{
	(void)source, (void)id, (void)length, (void)data;
	/* ANGLE finds it severe that reading back has to wait */
	bool severe =
		severity == GL_DEBUG_SEVERITY_HIGH_KHR && type != GL_DEBUG_TYPE_PERFORMANCE_KHR;
	if (type == GL_DEBUG_TYPE_ERROR_KHR || severe)
		log_error("GL: %s", message);
	else
		log_debug("GL: %s", message);
}

void gl_load_debug(struct gl *gl, sm_get_proc get_proc)
{
	gl->DebugMessageCallback = (gl_debug_message_callback)get_proc("glDebugMessageCallbackKHR");
	gl->PushDebugGroup = (gl_push_debug_group)get_proc("glPushDebugGroupKHR");
	gl->PopDebugGroup = (gl_pop_debug_group)get_proc("glPopDebugGroupKHR");
	if (gl->DebugMessageCallback == NULL)
		return;
	gl->DebugMessageCallback(log_message, NULL);
	gl->Enable(GL_DEBUG_OUTPUT_KHR);
	gl->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS_KHR);
}

void gl_load_texture_view(struct gl *gl, sm_get_proc get_proc)
{
	gl->TextureView = (gl_texture_view)get_proc("glTextureViewEXT");
}

void gl_push_group(struct gl *gl, const char *name)
{
	gl->group = name;
	if (gl->observer.begin != NULL)
		gl->observer.begin(gl->observer.data, name);
	if (gl->PushDebugGroup != NULL && gl->PopDebugGroup != NULL)
		gl->PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION_KHR, 0, -1, name);
}

void gl_pop_group(struct gl *gl)
{
	if (gl->observer.end != NULL)
		gl->observer.end(gl->observer.data, gl->group);
	gl->group = NULL;
	if (gl->PushDebugGroup != NULL && gl->PopDebugGroup != NULL)
		gl->PopDebugGroup();
}

void gl_begin_pass(struct gl *gl)
{
	if (gl->finishes_passes)
		gl->Finish();
	gl->has_passes = true;
}

void gl_finish_passes(struct gl *gl)
{
	if (gl->finishes_passes && gl->has_passes)
		gl->Finish();
	gl->has_passes = false;
}

#define GL_OBJECT(kind, Kind)                              \
	GLuint gl_create_##kind(struct gl *gl)             \
	{                                                  \
		GLuint name = 0;                           \
		gl->Gen##Kind##s(1, &name);                \
		gl->objects += name != 0;                  \
		return name;                               \
	}                                                  \
                                                           \
	void gl_delete_##kind(struct gl *gl, GLuint *name) \
	{                                                  \
		gl->objects -= *name != 0;                 \
		gl->Delete##Kind##s(1, name);              \
		*name = 0;                                 \
	}

GL_OBJECT(vertex_array, VertexArray)
GL_OBJECT(sampler, Sampler)
GL_OBJECT(framebuffer, Framebuffer)

#define GL_STORAGE(name_of, Kind, KIND)                                     \
	GLuint gl_create_##name_of(struct gl *gl, enum storage_owner owner) \
	{                                                                   \
		GLuint name = 0;                                            \
		if (!storages_reserve(&gl->storages))                       \
			return 0;                                           \
		gl->Gen##Kind##s(1, &name);                                 \
		if (name == 0)                                              \
			return 0;                                           \
		gl->objects++;                                              \
		storages_add(&gl->storages, &(struct storage){.name = name, \
						    .kind = STORAGE_##KIND, \
						    .owner = owner,         \
						    .light = gl->light});   \
		return name;                                                \
	}                                                                   \
                                                                            \
	void gl_delete_##name_of(struct gl *gl, GLuint *name)               \
	{                                                                   \
		if (*name == 0)                                             \
			return;                                             \
		gl->objects--;                                              \
		gl->Delete##Kind##s(1, name);                               \
		storages_remove(&gl->storages, *name, STORAGE_##KIND);      \
		*name = 0;                                                  \
	}

GL_STORAGE(buffer, Buffer, BUFFER)
GL_STORAGE(texture, Texture, TEXTURE)

static void count(struct gl *gl, GLuint name, enum storage_kind kind, uint64_t bytes)
{
	if (name != 0)
		storages_find(&gl->storages, name, kind)->bytes = bytes;
}

void gl_fill_buffer(
	struct gl *gl, GLenum target, GLuint buffer, size_t bytes, const void *data, GLenum usage)
{
	gl->BindBuffer(target, buffer);
	gl->BufferData(target, (GLsizeiptr)bytes, data, usage);
	count(gl, buffer, STORAGE_BUFFER, bytes);
}

void gl_store_texture(
	struct gl *gl, GLuint texture, GLenum internal_format, GLsizei width, GLsizei height)
{
	gl->BindTexture(GL_TEXTURE_2D, texture);
	gl->TexStorage2D(GL_TEXTURE_2D, 1, internal_format, width, height);
	count(gl, texture, STORAGE_TEXTURE, texture_bytes(internal_format, width, height, 1));
}

void gl_store_layers(
	struct gl *gl, GLuint texture, GLenum internal_format, GLsizei size, GLsizei layers)
{
	gl->BindTexture(GL_TEXTURE_2D_ARRAY, texture);
	gl->TexStorage3D(GL_TEXTURE_2D_ARRAY, 1, internal_format, size, size, layers);
	count(gl, texture, STORAGE_TEXTURE,
		(uint64_t)layers * texture_bytes(internal_format, size, size, 1));
}

void gl_fill_texture(struct gl *gl, GLuint texture, const struct texel_format *as, GLsizei width,
	GLsizei height, const void *texels)
{
	gl->BindTexture(GL_TEXTURE_2D, texture);
	gl->TexImage2D(GL_TEXTURE_2D, 0, (GLint)as->internal, width, height, 0, as->format,
		as->type, texels);
	count(gl, texture, STORAGE_TEXTURE, texture_bytes(as->internal, width, height, 1));
}

void gl_fill_levels(struct gl *gl, GLuint texture, const struct texel_format *as, GLsizei width,
	GLsizei height, const void *texels)
{
	GLsizei levels = 1;
	gl_fill_texture(gl, texture, as, width, height, texels);
	gl->GenerateMipmap(GL_TEXTURE_2D);
	while (width >> levels > 0 || height >> levels > 0)
		levels++;
	count(gl, texture, STORAGE_TEXTURE, texture_bytes(as->internal, width, height, levels));
}

GLuint gl_create_program(struct gl *gl)
{
	GLuint name = gl->CreateProgram();
	gl->objects += name != 0;
	return name;
}

void gl_delete_program(struct gl *gl, GLuint *name)
{
	gl->objects -= *name != 0;
	gl->DeleteProgram(*name);
	*name = 0;
}

GLsync gl_create_fence(struct gl *gl)
{
	GLsync fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
	gl->objects += fence != NULL;
	return fence;
}

void gl_delete_fence(struct gl *gl, GLsync *fence)
{
	gl->objects -= *fence != NULL;
	gl->DeleteSync(*fence);
	*fence = NULL;
}

bool gl_framebuffer_is_srgb(struct gl *gl, uint32_t framebuffer)
{
	GLint encoding = GL_LINEAR;
	gl->GetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER,
		framebuffer != 0 ? GL_COLOR_ATTACHMENT0 : GL_BACK,
		GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING, &encoding);
	return encoding == GL_SRGB;
}

const char *gl_take_error(struct gl *gl)
{
	/* A lost context may report errors for ever: a few are enough. */
	GLenum first = gl->GetError();
	for (int i = 0; i < 8 && gl->GetError() != GL_NO_ERROR; i++)
		;
	switch (first) {
	case GL_NO_ERROR:
		return NULL;
	case GL_INVALID_ENUM:
		return "GL_INVALID_ENUM";
	case GL_INVALID_VALUE:
		return "GL_INVALID_VALUE";
	case GL_INVALID_OPERATION:
		return "GL_INVALID_OPERATION";
	case GL_INVALID_FRAMEBUFFER_OPERATION:
		return "GL_INVALID_FRAMEBUFFER_OPERATION";
	case GL_OUT_OF_MEMORY:
		return "GL_OUT_OF_MEMORY";
	default:
		return "an error of unknown name";
	}
}
