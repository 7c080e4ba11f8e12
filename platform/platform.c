/* SPDX-License-Identifier: MIT */
#include "platform.h"
#include "base/array.h"
#include "base/error.h"
#include "base/log.h"
#include "egl.h"
#include "node.h"
#include "probe.h"
#include <GLES3/gl3.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char surfaceless[] = "surfaceless";

struct platform {
	char *device;
	struct node node;
	struct egl egl;
};

static bool start(struct platform *platform, bool debug, struct sm_error *error)
{
	if (strcmp(platform->device, surfaceless) == 0)
		return egl_init_surfaceless(&platform->egl, debug, error);
	return node_init(&platform->node, platform->device, debug, error) &&
	       egl_init_gbm(&platform->egl, platform->node.gbm, 0, debug, error);
}

/* The error says why, without the device's name. */
static struct platform *open_device(const char *device, bool debug, struct sm_error *error)
{
	struct platform *platform = array_zalloc(1, sizeof(*platform));
	if (platform == NULL) {
		error_no_memory(error);
		return NULL;
	}
	platform->node.fd = -1;
	platform->device = strdup(device);
	if (platform->device == NULL) {
		error_no_memory(error);
		goto error;
	}
	if (!start(platform, debug, error) || !probe_draws(error))
		goto error;
	return platform;

error:
	platform_destroy(platform);
	return NULL;
}

static bool is_device(const char *device, struct sm_error *error)
{
	return strcmp(device, surfaceless) == 0 || strchr(device, '/') != NULL ||
	       error_set(error, SM_ERROR_INPUT,
		       "no device \"%s\": give \"surfaceless\" or the path of a DRM node, such as "
		       "/dev/dri/renderD128",
		       device);
}

/* GBM needs a GPU's driver on a render node; where the display has a node but no GPU, Mesa draws in
 * software on the primary node alone. */
static struct platform *open_instead(const char *device, bool debug)
{
	char primary[64];
	struct sm_error why;
	struct platform *platform = NULL;
	if (node_primary(device, primary, sizeof(primary)))
		platform = open_device(primary, debug, &why);
	return platform != NULL ? platform : open_device(surfaceless, debug, &why);
}

static struct platform *open_named(const char *device, bool debug, struct sm_error *error)
{
	struct sm_error why;
	if (!is_device(device, error))
		return NULL;
	struct platform *platform = open_device(device, debug, &why);
	if (platform == NULL)
		error_set(error, why.status, "device %s does not work: %s", device, why.text);
	return platform;
}

static struct platform *open_named_or_instead(
	const char *device, bool debug, struct sm_error *error)
{
	struct sm_error why;
	struct platform *platform = open_named(device, debug, &why);
	if (platform != NULL)
		return platform;
	if (why.status == SM_ERROR_MACHINE && strcmp(device, surfaceless) != 0)
		platform = open_instead(device, debug);
	if (platform == NULL)
		error_set(error, why.status, "%s", why.text);
	else
		log_warning("%s; going on with %s", why.text, platform->device);
	return platform;
}

struct search {
	bool debug;
	char tried[400]; /* "DEVICE: why; DEVICE: why", cut short */
};

static struct platform *try_device(struct search *search, const char *device)
{
	struct sm_error why;
	struct platform *platform = open_device(device, search->debug, &why);
	if (platform == NULL) {
		size_t used = strlen(search->tried);
		snprintf(search->tried + used, sizeof(search->tried) - used, "%s%s: %.100s",
			used > 0 ? "; " : "", device, why.text);
		log_debug("device %s refused: %s", device, why.text);
	}
	return platform;
}

static struct platform *try_nodes(struct search *search, const char *pattern)
{
	struct platform *platform = NULL;
	glob_t nodes;
	if (glob(pattern, 0, NULL, &nodes) != 0)
		return NULL;
	for (size_t i = 0; i < nodes.gl_pathc && platform == NULL; i++)
		platform = try_device(search, nodes.gl_pathv[i]);
	globfree(&nodes);
	return platform;
}

/* A render node needs no rights over a display, but a driver without a GPU serves the primary node
 * only: try, do not guess from names. */
static struct platform *open_first(bool debug, struct sm_error *error)
{
	struct search search = {.debug = debug};
	struct platform *platform = try_nodes(&search, "/dev/dri/renderD*");
	if (platform == NULL)
		platform = try_nodes(&search, "/dev/dri/card*");
	if (platform == NULL)
		platform = try_device(&search, surfaceless);
	if (platform == NULL)
		error_set(error, SM_ERROR_MACHINE,
			"no device can render with OpenGL ES 3; tried %s", search.tried);
	return platform;
}

void platform_prepare(bool debug)
{
	/* Mesa warns on stderr about each driver that it tries and leaves; we report the outcome.
	 */
	setenv("EGL_LOG_LEVEL", debug ? "warning" : "fatal", 0);
}

static bool begin(bool debug, struct sm_error *error)
{
	platform_prepare(debug);
	return egl_check_override(error);
}

static struct platform *tell(struct platform *platform)
{
	if (platform != NULL)
		log_debug("device %s opened", platform->device);
	return platform;
}

struct platform *platform_create(const char *device, bool debug, struct sm_error *error)
{
	if (!begin(debug, error))
		return NULL;
	return tell(device != NULL ? open_named_or_instead(device, debug, error)
				   : open_first(debug, error));
}

struct platform *platform_create_on(const char *device, bool debug, struct sm_error *error)
{
	return begin(debug, error) ? tell(open_named(device, debug, error)) : NULL;
}

void platform_destroy(struct platform *platform)
{
	if (platform == NULL)
		return;
	egl_finish(&platform->egl);
	node_finish(&platform->node);
	free(platform->device);
	free(platform);
}

void (*platform_get_proc(const char *name))(void)
{
	return eglGetProcAddress(name);
}

bool platform_has_extension(const char *name)
{
	GLint count = 0;
	glGetIntegerv(GL_NUM_EXTENSIONS, &count);
	for (GLint i = 0; i < count; i++)
		if (strcmp((const char *)glGetStringi(GL_EXTENSIONS, (GLuint)i), name) == 0)
			return true;
	return false;
}

void platform_describe(const struct platform *platform, sm_fact fact, void *data)
{
	fact(data, "device", platform->device);
	fact(data, "EGL vendor", eglQueryString(platform->egl.display, EGL_VENDOR));
	fact(data, "EGL version", eglQueryString(platform->egl.display, EGL_VERSION));
}
