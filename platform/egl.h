/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_EGL_H
#define PLATFORM_EGL_H

#include <EGL/egl.h>
#include <smoothie.h>

/** An EGL display with a context that is current without a surface; zero is empty. */
struct egl {
	EGLDisplay display;
	EGLContext context;
	bool native_fences; /* EGL_ANDROID_native_fence_sync */
	bool software;      /* the processor draws, as far as the driver tells */
};

/** The display that needs neither window nor node: whichever way the EGL here offers. */
bool egl_init_surfaceless(struct egl *egl, bool debug, struct sm_error *error);

/** The display of a GBM device (struct gbm_device *), which must outlive it. format: of the buffers
 *  that will be drawn to (DRM_FORMAT_*); 0: none will. */
bool egl_init_gbm(
	struct egl *egl, void *gbm_device, uint32_t format, bool debug, struct sm_error *error);

/** Makes the context current without a surface again. */
bool egl_use_no_surface(struct egl *egl, struct sm_error *error);

/** A surface on a GBM surface (struct gbm_surface *) of that DRM_FORMAT_*; EGL_NO_SURFACE on
 *  failure (MACHINE). */
EGLSurface egl_create_surface(
	struct egl *egl, void *gbm_surface, uint32_t format, struct sm_error *error);
/** EGL_NO_SURFACE is fine; one in use is left first. */
void egl_destroy_surface(struct egl *egl, EGLSurface surface);

/** Makes the surface the context's framebuffer 0. */
bool egl_use_surface(struct egl *egl, EGLSurface surface, struct sm_error *error);

/** Ends a picture. *fence: signalled when it is drawn, the caller's to close; -1 where fences are
 *  not to be had. */
bool egl_swap(struct egl *egl, EGLSurface surface, int *fence, struct sm_error *error);

/** Has the GPU, not the caller, wait for a fence before it draws on; takes the fence; -1 is fine.
 */
void egl_wait(struct egl *egl, int fence);

/** Releases whatever an init, complete or not, has made. */
void egl_finish(struct egl *egl);

/** Fills *error (MACHINE) with the call that failed and EGL's reason, and returns false. */
bool egl_fail(struct sm_error *error, const char *call);

/** An EGL error code in words. */
const char *egl_error_name(EGLint code);

/** Whether $SMOOTHIE_CONTEXT asks for what there is; fails (INPUT). */
bool egl_check_override(struct sm_error *error);

/**
 * A context of the highest version of OpenGL ES 3 that there is, 3.2 to 3.0. With
 * SMOOTHIE_CONTEXT=strict-3.0 in the environment: of 3.0, with no more than that where ANGLE draws,
 * which otherwise enables extensions and later versions by itself.
 *
 * debug: a debug context, if there is one.
 * EGL_NO_CONTEXT on failure (MACHINE).
 */
EGLContext egl_create_context(
	EGLDisplay display, EGLConfig config, bool debug, struct sm_error *error);

/** EGL_NO_DISPLAY asks for the client's extensions. */
bool egl_has_extension(EGLDisplay display, const char *name);

/** The config that draws to buffers of a DRM_FORMAT_*; fails (MACHINE). */
bool egl_choose_config(
	EGLDisplay display, uint32_t format, EGLConfig *config, struct sm_error *error);

#endif
