/* SPDX-License-Identifier: MIT */
#include "gles/gl.h"
#include "base/log.h"

bool gl_load(struct gl *gl, sm_get_proc get_proc, struct sm_error *error)
{
	*gl = (struct gl){0};
#define GL_RESOLVE(upper, name)                              \
	gl->name = (PFNGL##upper##PROC)get_proc("gl" #name); \
	if (gl->name == NULL)                                \
		return error_set(error, SM_ERROR_MACHINE,    \
			"the driver lacks gl" #name ", a function of OpenGL ES 3.0");
	GL_FUNCTIONS(GL_RESOLVE)
#undef GL_RESOLVE
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

GL_OBJECT(buffer, Buffer)
GL_OBJECT(vertex_array, VertexArray)
GL_OBJECT(texture, Texture)
GL_OBJECT(sampler, Sampler)
GL_OBJECT(framebuffer, Framebuffer)

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
