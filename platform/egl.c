/* SPDX-License-Identifier: MIT */
#include "egl.h"
#include "base/error.h"
#include "heap.h"
#include <EGL/eglext.h>
#include <string.h>

const char *egl_error_name(EGLint code)
{
	static const struct {
		EGLint code;
		const char *name;
	} names[] = {
		{EGL_SUCCESS, "no error"},
		{EGL_NOT_INITIALIZED, "EGL_NOT_INITIALIZED"},
		{EGL_BAD_ACCESS, "EGL_BAD_ACCESS"},
		{EGL_BAD_ALLOC, "EGL_BAD_ALLOC"},
		{EGL_BAD_ATTRIBUTE, "EGL_BAD_ATTRIBUTE"},
		{EGL_BAD_CONFIG, "EGL_BAD_CONFIG"},
		{EGL_BAD_CONTEXT, "EGL_BAD_CONTEXT"},
		{EGL_BAD_DISPLAY, "EGL_BAD_DISPLAY"},
		{EGL_BAD_MATCH, "EGL_BAD_MATCH"},
		{EGL_BAD_PARAMETER, "EGL_BAD_PARAMETER"},
		{EGL_BAD_DEVICE_EXT, "EGL_BAD_DEVICE_EXT"},
	};
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		if (names[i].code == code)
			return names[i].name;
	return "unknown EGL error";
}

bool egl_fail(struct sm_error *error, const char *call)
{
	return error_set(
		error, SM_ERROR_MACHINE, "%s failed (%s)", call, egl_error_name(eglGetError()));
}

bool egl_has_extension(EGLDisplay display, const char *name)
{
	const char *list = eglQueryString(display, EGL_EXTENSIONS);
	size_t length = strlen(name);
	for (const char *at = list; at != NULL && (at = strstr(at, name)) != NULL; at += length)
		if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
			return true;
	return false;
}

/* The EXT entry point rather than that of EGL 1.5, because EGL 1.4 libraries lack the latter. */
static bool open_display(struct egl *egl, EGLenum platform, void *native, struct sm_error *error)
{
	PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display =
		(PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
	if (get_platform_display == NULL)
		return error_set(error, SM_ERROR_MACHINE, "EGL lacks EGL_EXT_platform_base");
	egl->display = get_platform_display(platform, native, NULL);
	return egl->display != EGL_NO_DISPLAY || egl_fail(error, "eglGetPlatformDisplayEXT");
}

static bool open_first_device(struct egl *egl, struct sm_error *error)
{
	PFNEGLQUERYDEVICESEXTPROC query_devices =
		(PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
	EGLDeviceEXT device;
	EGLint count = 0;
	if (query_devices == NULL || !query_devices(1, &device, &count) || count == 0)
		return error_set(error, SM_ERROR_MACHINE, "EGL knows no device");
	return open_display(egl, EGL_PLATFORM_DEVICE_EXT, device, error);
}

static bool choose_any_config(EGLDisplay display, EGLConfig *config, struct sm_error *error)
{
	/* An older driver has configs for OpenGL ES 2, and tells its version in that context. */
	static const EGLint versions[] = {EGL_OPENGL_ES3_BIT, EGL_OPENGL_ES2_BIT};
	EGLint count = 0;
	for (size_t i = 0; i < 2 && count == 0; i++) {
		/* EGL_SURFACE_TYPE would default to windows, which headless drivers may not have.
		 */
		const EGLint wanted[] = {
			EGL_RENDERABLE_TYPE, versions[i], EGL_SURFACE_TYPE, 0, EGL_NONE};
		if (!eglChooseConfig(display, wanted, config, 1, &count))
			return egl_fail(error, "eglChooseConfig");
	}
	return count > 0 || error_set(error, SM_ERROR_MACHINE, "EGL has no config for OpenGL ES");
}

/* Mesa's names: swrast, kms_swrast. */
static bool is_software(EGLDisplay display)
{
	PFNEGLGETDISPLAYDRIVERNAMEPROC driver_name =
		egl_has_extension(display, "EGL_MESA_query_driver")
			? (PFNEGLGETDISPLAYDRIVERNAMEPROC)eglGetProcAddress(
				  "eglGetDisplayDriverName")
			: NULL;
	const char *name = driver_name != NULL ? driver_name(display) : NULL;
	return name != NULL && strstr(name, "swrast") != NULL;
}

/* format 0: no surface will be used. */
static bool make_context(struct egl *egl, uint32_t format, bool debug, struct sm_error *error)
{
	EGLConfig config = EGL_NO_CONFIG_KHR;
	if (!eglInitialize(egl->display, NULL, NULL))
		return egl_fail(error, "eglInitialize");
	if (!egl_has_extension(egl->display, "EGL_KHR_surfaceless_context"))
		return error_set(error, SM_ERROR_MACHINE, "EGL lacks EGL_KHR_surfaceless_context");
	if (!eglBindAPI(EGL_OPENGL_ES_API))
		return egl_fail(error, "eglBindAPI");
	if (!egl_has_extension(egl->display, "EGL_KHR_no_config_context") &&
		!(format != 0 ? egl_choose_config(egl->display, format, &config, error)
			      : choose_any_config(egl->display, &config, error)))
		return false;
	egl->context = egl_create_context(egl->display, config, debug, error);
	if (egl->context == EGL_NO_CONTEXT)
		return false;
	egl->native_fences = egl_has_extension(egl->display, "EGL_ANDROID_native_fence_sync") &&
			     egl_has_extension(egl->display, "EGL_KHR_wait_sync");
	egl->software = is_software(egl->display);
	if (egl->software)
		heap_keep();
	return egl_use_no_surface(egl, error);
}

bool egl_init_surfaceless(struct egl *egl, bool debug, struct sm_error *error)
{
	bool opened;
	*egl = (struct egl){0};
	if (egl_has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
		opened = open_display(
			egl, EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, error);
	} else if (egl_has_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
		opened = open_first_device(egl, error);
	} else {
		egl->display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
		opened = egl->display != EGL_NO_DISPLAY ||
			 error_set(error, SM_ERROR_MACHINE, "EGL offers no display");
	}
	return opened && make_context(egl, 0, debug, error);
}

bool egl_init_gbm(
	struct egl *egl, void *gbm_device, uint32_t format, bool debug, struct sm_error *error)
{
	*egl = (struct egl){0};
	if (!egl_has_extension(EGL_NO_DISPLAY, "EGL_KHR_platform_gbm") &&
		!egl_has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_gbm"))
		return error_set(error, SM_ERROR_MACHINE, "EGL lacks EGL_KHR_platform_gbm");
	return open_display(egl, EGL_PLATFORM_GBM_KHR, gbm_device, error) &&
	       make_context(egl, format, debug, error);
}

bool egl_use_no_surface(struct egl *egl, struct sm_error *error)
{
	return eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context) ||
	       egl_fail(error, "eglMakeCurrent");
}

void egl_finish(struct egl *egl)
{
	if (egl->display != EGL_NO_DISPLAY) {
		eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
		if (egl->context != EGL_NO_CONTEXT)
			eglDestroyContext(egl->display, egl->context);
		eglTerminate(egl->display);
		eglReleaseThread();
	}
	*egl = (struct egl){0};
}
