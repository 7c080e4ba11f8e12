/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "base/log.h"
#include "egl.h"
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* EGL_ANGLE_create_context_extensions_enabled, EGL_ANGLE_create_context_backwards_compatible */
#define EXTENSIONS_ENABLED 0x345F
#define BACKWARDS_COMPATIBLE 0x3483

static const char * override(void)
{
	const char *value = getenv("SMOOTHIE_CONTEXT");
	return value != NULL && value[0] != '\0' ? value : NULL;
}

bool egl_check_override(struct sm_error *error)
{
	const char *value = override();
	return value == NULL || strcmp(value, "strict-3.0") == 0 ||
	       error_set(error, SM_ERROR_INPUT,
		       "SMOOTHIE_CONTEXT is \"%s\"; it can be \"strict-3.0\"", value);
}

struct attributes {
	EGLint list[16];
	size_t count;
};

static void add(struct attributes *attributes, EGLint name, EGLint value)
{
	attributes->list[attributes->count++] = name;
	attributes->list[attributes->count++] = value;
	attributes->list[attributes->count] = EGL_NONE;
}

/* EGL 1.4 has a major version only, and says so by refusing the others. */
static struct attributes version(EGLint major, EGLint minor, bool debug)
{
	struct attributes attributes = {.count = 0};
	add(&attributes, EGL_CONTEXT_MAJOR_VERSION, major);
	if (minor > 0)
		add(&attributes, EGL_CONTEXT_MINOR_VERSION, minor);
	if (debug)
		add(&attributes, EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE);
	return attributes;
}

static EGLContext create(EGLDisplay display, EGLConfig config, const struct attributes *attributes)
{
	return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes->list);
}

static EGLContext create_strict(EGLDisplay display, EGLConfig config, bool debug)
{
	struct attributes attributes = version(3, 0, debug);
	if (egl_has_extension(display, "EGL_ANGLE_create_context_extensions_enabled"))
		add(&attributes, EXTENSIONS_ENABLED, EGL_FALSE);
	if (egl_has_extension(display, "EGL_ANGLE_create_context_backwards_compatible"))
		add(&attributes, BACKWARDS_COMPATIBLE, EGL_FALSE);
	return create(display, config, &attributes);
}

static EGLContext create_highest(EGLDisplay display, EGLConfig config, bool debug)
{
	EGLContext context = EGL_NO_CONTEXT;
	for (EGLint minor = 2; minor >= 0 && context == EGL_NO_CONTEXT; minor--) {
		struct attributes attributes = version(3, minor, debug);
		context = create(display, config, &attributes);
	}
	return context;
}

/* EGL says no more than that it has no such context: an older one tells the driver's version. */
static void explain(EGLDisplay display, EGLConfig config, struct sm_error *error)
{
	struct attributes attributes = version(2, 0, false);
	EGLContext older;
	int major = 3;
	egl_fail(error, "eglCreateContext for OpenGL ES 3");
	older = create(display, config, &attributes);
	if (older == EGL_NO_CONTEXT)
		return;
	const char *offer = eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, older)
				    ? (const char *)glGetString(GL_VERSION)
				    : NULL;
	if (offer != NULL && sscanf(offer, "OpenGL ES %d", &major) == 1 && major < 3)
		error_set(error, SM_ERROR_MACHINE, "OpenGL ES 3.0 is needed, it offers %s", offer);
	eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
	eglDestroyContext(display, older);
}

EGLContext egl_create_context(
	EGLDisplay display, EGLConfig config, bool debug, struct sm_error *error)
{
	EGLContext (*create_wanted)(EGLDisplay, EGLConfig, bool) =
		override() != NULL ? create_strict : create_highest;
	EGLContext context = create_wanted(display, config, debug);
	if (context == EGL_NO_CONTEXT && debug) {
		EGLint code = eglGetError();
		context = create_wanted(display, config, false);
		if (context != EGL_NO_CONTEXT)
			log_warning("EGL refuses a debug context (%s): going on without",
				egl_error_name(code));
	}
	if (context == EGL_NO_CONTEXT)
		explain(display, config, error);
	return context;
}
