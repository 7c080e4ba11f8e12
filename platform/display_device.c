/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "base/log.h"
#include "display_state.h"
#include "node.h"
#include "probe.h"
#include <errno.h>
#include <gbm.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xf86drm.h>

/* What became of trying a device. */
enum trial {
	TRIAL_SHOWS,      /* it is open, and has a monitor */
	TRIAL_NO_MONITOR, /* it would do */
	TRIAL_IN_USE,     /* by another program; *error tells */
	TRIAL_UNUSABLE,   /* *error tells */
};

static bool set_path(struct display *display, const char *path, struct sm_error *error)
{
	struct stat node;
	display->path = strdup(path);
	if (display->path == NULL)
		return error_no_memory(error);
	display->number = stat(path, &node) == 0 ? node.st_rdev : 0;
	return true;
}

static bool open_device(struct display *display, const char *path, struct sm_error *error)
{
	if (!set_path(display, path, error))
		return false;
	int fd = seat_open_device(display->seat, path, error);
	if (fd < 0)
		return false;
	display->device.fd = fd;
	if (!kms_device_init(&display->device, fd, display->options.legacy, error))
		return false;
	display->kms = display->device.atomic ? &kms_atomic : &kms_legacy;
	return true;
}

static enum trial try_open_device(struct display *display, const char *path, struct sm_error *error)
{
	if (!open_device(display, path, error))
		return TRIAL_UNUSABLE;
	if (kms_device_take(&display->device) == KMS_DONE)
		return TRIAL_SHOWS;
	error_set(error, SM_ERROR_MACHINE,
		"it is in use by another program: end that (a desktop, a boot splash, another "
		"smoothie), or give another --device");
	return TRIAL_IN_USE;
}

/* What another GPU draws, or the processor, is copied to buffers of the display's own. */
static bool open_context_elsewhere(struct display *display, struct sm_error *error)
{
	if (!display->device.dumb)
		return error_set(error, SM_ERROR_MACHINE, "it has neither a GPU nor dumb buffers");
	display->elsewhere = platform_create(NULL, display->options.debug, error);
	return display->elsewhere != NULL;
}

/* format: DRM_FORMAT_* of the buffers that will be drawn to. */
static bool open_context(struct display *display, uint32_t format, struct sm_error *error)
{
	struct sm_error why = {0};
	platform_prepare(display->options.debug);
	display->gbm = node_create_gbm(display->device.fd, display->options.debug);
	bool opened =
		display->gbm != NULL &&
		egl_init_gbm(&display->egl, display->gbm, format, display->options.debug, &why) &&
		probe_draws(&why);
	if (!opened) {
		log_debug("device %s: no context (%s)", display->path,
			display->gbm != NULL ? why.text : "no GBM driver");
		egl_finish(&display->egl);
		if (display->gbm != NULL)
			gbm_device_destroy(display->gbm);
		display->gbm = NULL;
		opened = open_context_elsewhere(display, error);
	}
	display->has_context = opened;
	return opened;
}

/* With the device open: whether it has a monitor, and something to draw with. */
static enum trial try_monitor(struct display *display, struct sm_error *error)
{
	struct kms_output output;
	switch (kms_output_find(&output, &display->device, &display->wish, true, error)) {
	case KMS_FOUND:
		return open_context(display, output.format->code, error) ? TRIAL_SHOWS
									 : TRIAL_UNUSABLE;
	case KMS_NO_MONITOR:
		error_set(error, SM_ERROR_MACHINE, "it has no monitor");
		return TRIAL_NO_MONITOR;
	default:
		return TRIAL_UNUSABLE;
	}
}

static enum trial try_device(struct display *display, const char *path, struct sm_error *error)
{
	struct sm_error why = {0};
	enum trial trial = try_open_device(display, path, &why);
	if (trial == TRIAL_SHOWS)
		trial = try_monitor(display, &why);
	if (trial != TRIAL_SHOWS) {
		display_close_device(display);
		log_debug("device %s: %s", path, why.text);
		error_set(error, why.status, "device %s: %s", path, why.text);
	}
	return trial;
}

bool display_no_device(struct sm_error *error)
{
	return error_set(error, SM_ERROR_MACHINE,
		"there is no display device (" DISPLAY_DEVICES "); is its driver loaded?");
}

/* The trials of several devices come to the one that promises most. */
static enum trial try_devices(struct display *display, struct sm_error *error)
{
	enum trial best = TRIAL_UNUSABLE;
	glob_t nodes;
	display_no_device(error);
	if (glob(DISPLAY_DEVICES, 0, NULL, &nodes) != 0)
		return best;
	bool told = false;
	for (size_t i = 0; i < nodes.gl_pathc && best != TRIAL_SHOWS; i++) {
		struct sm_error why;
		enum trial trial = try_device(display, nodes.gl_pathv[i], &why);
		/* One device says why it does not do, and that is worth knowing. */
		if ((trial < best || !told) && trial != TRIAL_SHOWS)
			*error = why;
		told = true;
		best = trial < best ? trial : best;
	}
	globfree(&nodes);
	return best;
}

bool display_find_device(struct display *display, bool first, struct sm_error *error)
{
	const char *path = display->options.device;
	enum trial trial =
		path != NULL ? try_device(display, path, error) : try_devices(display, error);
	switch (trial) {
	case TRIAL_SHOWS:
	case TRIAL_NO_MONITOR:
		return true;
	case TRIAL_IN_USE:
		return !first;
	default:
		/* What was good at first the user need not answer for. */
		if (!first && error != NULL)
			error->status = SM_ERROR_MACHINE;
		return false;
	}
}

bool display_device_is_gone(const struct display *display)
{
	uint64_t value;
	/* All calls fail so once the driver has let go of the hardware. */
	return drmGetCap(display->device.fd, DRM_CAP_DUMB_BUFFER, &value) != 0 && errno == ENODEV;
}

bool display_device_removed(struct display *display, struct sm_error *error)
{
	display->removed = true;
	return error_set(error, SM_ERROR_MACHINE, "the display device %s was removed",
		display->path != NULL ? display->path : "");
}

void display_close_device(struct display *display)
{
	platform_destroy(display->elsewhere);
	display->elsewhere = NULL;
	egl_finish(&display->egl);
	if (display->gbm != NULL)
		gbm_device_destroy(display->gbm);
	display->gbm = NULL;
	display->has_context = false;
	if (display->device.fd >= 0)
		seat_close_device(display->seat, display->device.fd);
	display->device = (struct kms_device){.fd = -1};
	free(display->path);
	display->path = NULL;
	display->number = 0;
}
