/* SPDX-License-Identifier: MIT */
/* Preloaded (LD_PRELOAD), a driver with one fault, for OpenGL ES programs of any kind:
 *
 *   GL_FAULT=none                 the driver as it is
 *   GL_FAULT=min-is-add           GL_MIN adds
 *   GL_FAULT=depth-func-ignored   depths are compared by GL_LESS whatever is asked for
 *   GL_FAULT=r16f-truncated       R16F and RG16F hold 6 bits of a number, not 10, and no sign
 *   GL_FAULT=texel-off-by-one     what shaders look up in a texture is one texel to the right
 *   GL_FAULT=float-target-8-bit   textures of floats hold bytes from 0 to 1
 *   GL_FAULT=float-target-refused framebuffers of floats are incomplete, whatever is advertised
 *
 * No function returns anything that tells. */
#include "faults.h"
#include <EGL/egl.h>
#include <GLES3/gl3.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void (*function)(void);

function real_function(const char *name)
{
	static function (*get_proc)(const char *);
	if (get_proc == NULL)
		get_proc = (function(*)(const char *))dlsym(RTLD_NEXT, "eglGetProcAddress");
	return get_proc(name);
}

enum fault fault_seeded(void)
{
	static const char *const names[] = {
		[FAULT_NONE] = "none",
		[FAULT_MIN_IS_ADD] = "min-is-add",
		[FAULT_DEPTH_FUNC_IGNORED] = "depth-func-ignored",
		[FAULT_R16F_TRUNCATED] = "r16f-truncated",
		[FAULT_TEXEL_OFF_BY_ONE] = "texel-off-by-one",
		[FAULT_FLOAT_TARGET_8_BIT] = "float-target-8-bit",
		[FAULT_FLOAT_TARGET_REFUSED] = "float-target-refused",
	};
	const char *wanted = getenv("GL_FAULT");
	for (size_t i = 0; wanted != NULL && i < sizeof(names) / sizeof(names[0]); i++)
		if (strcmp(names[i], wanted) == 0)
			return (enum fault)i;
	fprintf(stderr, "there is no GL_FAULT=%s\n", wanted != NULL ? wanted : "");
	abort();
}

/* Programs compiled without the fault must not be loaded, nor those with it be kept. */
EXPORT void glGetIntegerv(GLenum name, GLint *values)
{
	REAL(GETINTEGERV, glGetIntegerv)(name, values);
	if (name == GL_NUM_PROGRAM_BINARY_FORMATS && fault_seeded() != FAULT_NONE)
		values[0] = 0;
}

/* While the equation is GL_MIN the factors do not count, and the fault's are there. */
static struct {
	GLenum factors[4];
	bool asked, adds;
} blending = {.factors = {GL_ONE, GL_ZERO, GL_ONE, GL_ZERO}};

static void use_factors(void)
{
	const GLenum *f = blending.factors;
	if (blending.adds)
		REAL(BLENDFUNC, glBlendFunc)(GL_ONE, GL_ONE);
	else
		REAL(BLENDFUNCSEPARATE, glBlendFuncSeparate)(f[0], f[1], f[2], f[3]);
}

EXPORT void glBlendFuncSeparate(
	GLenum source, GLenum target, GLenum source_alpha, GLenum target_alpha)
{
	blending.factors[0] = source;
	blending.factors[1] = target;
	blending.factors[2] = source_alpha;
	blending.factors[3] = target_alpha;
	use_factors();
}

EXPORT void glBlendFunc(GLenum source, GLenum target)
{
	glBlendFuncSeparate(source, target, source, target);
}

EXPORT void glBlendEquationSeparate(GLenum color, GLenum alpha)
{
	if (fault_seeded() == FAULT_MIN_IS_ADD) {
		blending.adds = color == GL_MIN || alpha == GL_MIN;
		use_factors();
		color = color == GL_MIN ? GL_FUNC_ADD : color;
		alpha = alpha == GL_MIN ? GL_FUNC_ADD : alpha;
	}
	REAL(BLENDEQUATIONSEPARATE, glBlendEquationSeparate)(color, alpha);
}

EXPORT void glBlendEquation(GLenum mode)
{
	glBlendEquationSeparate(mode, mode);
}

EXPORT void glDepthFunc(GLenum compare)
{
	if (fault_seeded() != FAULT_DEPTH_FUNC_IGNORED)
		REAL(DEPTHFUNC, glDepthFunc)(compare);
}

static GLenum as_bytes(GLenum format)
{
	switch (format) {
	case GL_R16F:
	case GL_R32F:
		return GL_R8;
	case GL_RG16F:
	case GL_RG32F:
		return GL_RG8;
	case GL_RGBA16F:
	case GL_RGBA32F:
	case GL_R11F_G11F_B10F:
		return GL_RGBA8;
	default:
		return format;
	}
}

static GLenum stored_format(GLenum format)
{
	enum fault fault = fault_seeded();
	if (fault == FAULT_FLOAT_TARGET_8_BIT)
		return as_bytes(format);
	if (fault == FAULT_R16F_TRUNCATED && (format == GL_R16F || format == GL_RG16F))
		return GL_R11F_G11F_B10F;
	return format;
}

EXPORT void glTexStorage2D(
	GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
	REAL(TEXSTORAGE2D, glTexStorage2D)(target, levels, stored_format(format), width, height);
}

EXPORT void glTexStorage3D(
	GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height, GLsizei depth)
{
	REAL(TEXSTORAGE3D, glTexStorage3D)
	(target, levels, stored_format(format), width, height, depth);
}

static GLint attachment_value(GLenum target, GLenum attachment, GLenum name)
{
	GLint value = GL_NONE;
	REAL(GETFRAMEBUFFERATTACHMENTPARAMETERIV, glGetFramebufferAttachmentParameteriv)
	(target, attachment, name, &value);
	return value;
}

static bool has_floats(GLenum target)
{
	GLenum color = GL_COLOR_ATTACHMENT0;
	return attachment_value(target, color, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE &&
	       attachment_value(target, color, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) ==
		       GL_FLOAT;
}

EXPORT GLenum glCheckFramebufferStatus(GLenum target)
{
	if (fault_seeded() == FAULT_FLOAT_TARGET_REFUSED && has_floats(target))
		return GL_FRAMEBUFFER_UNSUPPORTED;
	return REAL(CHECKFRAMEBUFFERSTATUS, glCheckFramebufferStatus)(target);
}

/* What is stored as bytes is read as bytes, and given as the floats that were asked for. */
EXPORT void glReadPixels(
	GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, void *pixels)
{
	PFNGLREADPIXELSPROC read = REAL(READPIXELS, glReadPixels);
	GLint buffer = GL_NONE, component = GL_NONE;
	if (fault_seeded() == FAULT_FLOAT_TARGET_8_BIT && format == GL_RGBA && type == GL_FLOAT) {
		REAL(GETINTEGERV, glGetIntegerv)(GL_READ_BUFFER, &buffer);
		component = attachment_value(GL_READ_FRAMEBUFFER, (GLenum)buffer,
			GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE);
	}
	if (component != GL_UNSIGNED_NORMALIZED) {
		read(x, y, width, height, format, type, pixels);
		return;
	}
	size_t count = 4 * (size_t)width * (size_t)height;
	GLubyte *bytes = malloc(count);
	if (bytes == NULL)
		abort();
	read(x, y, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
	for (size_t i = 0; i < count; i++)
		((GLfloat *)pixels)[i] = (GLfloat)bytes[i] / 255;
	free(bytes);
}

EXPORT void glShaderSource(
	GLuint shader, GLsizei count, const GLchar *const *strings, const GLint *lengths)
{
	PFNGLSHADERSOURCEPROC source = REAL(SHADERSOURCE, glShaderSource);
	if (fault_seeded() != FAULT_TEXEL_OFF_BY_ONE) {
		source(shader, count, strings, lengths);
		return;
	}
	char *shifted = shift_look_ups(count, strings, lengths);
	source(shader, 1, (const GLchar *const[]){shifted}, NULL);
	free(shifted);
}

EXPORT function eglGetProcAddress(const char *name)
{
#define OWN(name)                     \
	{                             \
#name, (function)name \
	}
	static const struct {
		const char *name;
		function function;
	} own[] = {OWN(glBlendEquation), OWN(glBlendEquationSeparate), OWN(glBlendFunc),
		OWN(glBlendFuncSeparate), OWN(glCheckFramebufferStatus), OWN(glDepthFunc),
		OWN(glGetIntegerv), OWN(glReadPixels), OWN(glShaderSource), OWN(glTexStorage2D),
		OWN(glTexStorage3D)};
#undef OWN
	for (size_t i = 0; i < sizeof(own) / sizeof(own[0]); i++)
		if (strcmp(own[i].name, name) == 0)
			return own[i].function;
	return real_function(name);
}
