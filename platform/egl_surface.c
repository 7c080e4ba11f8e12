/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "base/error.h"
#include "egl.h"
#include <EGL/eglext.h>
#include <stdlib.h>
#include <unistd.h>

/* Several configs match any wish, and the first draws to a format of its own: compare them. */
bool egl_choose_config(
	EGLDisplay display, uint32_t format, EGLConfig *config, struct sm_error *error)
{
	static const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE,
		EGL_WINDOW_BIT, EGL_NONE};
	EGLint count = 0;
	if (!eglChooseConfig(display, wanted, NULL, 0, &count))
		return egl_fail(error, "eglChooseConfig");
	EGLConfig *all = array_alloc((size_t)count, sizeof(*all));
	if (all == NULL)
		return error_no_memory(error);
	bool found = false;
	if (eglChooseConfig(display, wanted, all, count, &count)) {
		for (EGLint i = 0; i < count && !found; i++) {
			EGLint visual = 0;
			eglGetConfigAttrib(display, all[i], EGL_NATIVE_VISUAL_ID, &visual);
			found = (uint32_t)visual == format;
			*config = all[i];
		}
	}
	free(all);
	return found ||
	       error_set(error, SM_ERROR_MACHINE, "EGL draws to no buffers of the format %.4s",
		       (const char[]){(char)format, (char)(format >> 8), (char)(format >> 16),
			       (char)(format >> 24)});
}

EGLSurface egl_create_surface(
	struct egl *egl, void *gbm_surface, uint32_t format, struct sm_error *error)
{
	EGLConfig config;
	PFNEGLCREATEPLATFORMWINDOWSURFACEEXTPROC create =
		(PFNEGLCREATEPLATFORMWINDOWSURFACEEXTPROC)eglGetProcAddress(
			"eglCreatePlatformWindowSurfaceEXT");
	if (create == NULL) {
		error_set(error, SM_ERROR_MACHINE, "EGL lacks EGL_EXT_platform_base");
		return EGL_NO_SURFACE;
	}
	if (!egl_choose_config(egl->display, format, &config, error))
		return EGL_NO_SURFACE;
	EGLSurface surface = create(egl->display, config, gbm_surface, NULL);
	if (surface == EGL_NO_SURFACE)
		egl_fail(error, "eglCreatePlatformWindowSurfaceEXT");
	return surface;
}

void egl_destroy_surface(struct egl *egl, EGLSurface surface)
{
	if (surface == EGL_NO_SURFACE)
		return;
	if (eglGetCurrentSurface(EGL_DRAW) == surface)
		egl_use_no_surface(egl, NULL);
	eglDestroySurface(egl->display, surface);
}

bool egl_use_surface(struct egl *egl, EGLSurface surface, struct sm_error *error)
{
	return eglGetCurrentSurface(EGL_DRAW) == surface ||
	       eglMakeCurrent(egl->display, surface, surface, egl->context) ||
	       egl_fail(error, "eglMakeCurrent");
}

static EGLSyncKHR create_fence(struct egl *egl, int fd)
{
	PFNEGLCREATESYNCKHRPROC create_sync =
		(PFNEGLCREATESYNCKHRPROC)eglGetProcAddress("eglCreateSyncKHR");
	const EGLint attributes[] = {EGL_SYNC_NATIVE_FENCE_FD_ANDROID, fd, EGL_NONE};
	return create_sync(egl->display, EGL_SYNC_NATIVE_FENCE_ANDROID, attributes);
}

static void destroy_fence(struct egl *egl, EGLSyncKHR sync)
{
	PFNEGLDESTROYSYNCKHRPROC destroy_sync =
		(PFNEGLDESTROYSYNCKHRPROC)eglGetProcAddress("eglDestroySyncKHR");
	destroy_sync(egl->display, sync);
}

/* The fence has a descriptor once the commands before it are flushed, which swapping does. */
bool egl_swap(struct egl *egl, EGLSurface surface, int *fence, struct sm_error *error)
{
	EGLSyncKHR sync = EGL_NO_SYNC_KHR;
	*fence = -1;
	if (egl->native_fences)
		sync = create_fence(egl, EGL_NO_NATIVE_FENCE_FD_ANDROID);
	bool swapped = eglSwapBuffers(egl->display, surface) || egl_fail(error, "eglSwapBuffers");
	if (sync == EGL_NO_SYNC_KHR)
		return swapped;
	PFNEGLDUPNATIVEFENCEFDANDROIDPROC dup_fence =
		(PFNEGLDUPNATIVEFENCEFDANDROIDPROC)eglGetProcAddress("eglDupNativeFenceFDANDROID");
	if (swapped)
		*fence = dup_fence(egl->display, sync);
	destroy_fence(egl, sync);
	return swapped;
}

void egl_wait(struct egl *egl, int fence)
{
	if (fence < 0)
		return;
	EGLSyncKHR sync = egl->native_fences ? create_fence(egl, fence) : EGL_NO_SYNC_KHR;
	if (sync == EGL_NO_SYNC_KHR) {
		close(fence); /* a sync that exists has taken it */
		return;
	}
	PFNEGLWAITSYNCKHRPROC wait_sync =
		(PFNEGLWAITSYNCKHRPROC)eglGetProcAddress("eglWaitSyncKHR");
	wait_sync(egl->display, sync, 0);
	destroy_fence(egl, sync);
}
