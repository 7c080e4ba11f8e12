/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "base/error.h"
#include "base/log.h"
#include "hotplug.h"
#include <errno.h>
#include <libudev.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct hotplug {
	struct udev *udev;
	struct udev_monitor *monitor; /* NULL: no news */
};

/* What the kernel says is passed on by udevd once it has made the nodes and their rights; a small
 * system without udevd hears the kernel itself. */
static const char *source(void)
{
	return access("/run/udev/control", F_OK) == 0 ? "udev" : "kernel";
}

static bool listen(struct hotplug *hotplug)
{
	hotplug->monitor = udev_monitor_new_from_netlink(hotplug->udev, source());
	return hotplug->monitor != NULL &&
	       udev_monitor_filter_add_match_subsystem_devtype(hotplug->monitor, "drm", NULL) >=
		       0 &&
	       udev_monitor_enable_receiving(hotplug->monitor) >= 0;
}

struct hotplug *hotplug_create(struct sm_error *error)
{
	struct hotplug *hotplug = array_zalloc(1, sizeof(*hotplug));
	if (hotplug == NULL || (hotplug->udev = udev_new()) == NULL) {
		error_no_memory(error);
		hotplug_destroy(hotplug);
		return NULL;
	}
	if (!listen(hotplug)) {
		log_warning("no hotplug events: %s", strerror(errno));
		udev_monitor_unref(hotplug->monitor);
		hotplug->monitor = NULL;
	}
	return hotplug;
}

void hotplug_destroy(struct hotplug *hotplug)
{
	if (hotplug == NULL)
		return;
	udev_monitor_unref(hotplug->monitor);
	udev_unref(hotplug->udev);
	free(hotplug);
}

int hotplug_fd(const struct hotplug *hotplug)
{
	return hotplug->monitor != NULL ? udev_monitor_get_fd(hotplug->monitor) : -1;
}

static enum hotplug_news judge(struct udev_device *event, dev_t device)
{
	const char *action = udev_device_get_action(event);
	bool removed = action != NULL && strcmp(action, "remove") == 0;
	return removed && device != 0 && udev_device_get_devnum(event) == device ? HOTPLUG_REMOVED
										 : HOTPLUG_CHANGED;
}

enum hotplug_news hotplug_read(struct hotplug *hotplug, dev_t device)
{
	enum hotplug_news news = HOTPLUG_NOTHING;
	if (hotplug->monitor == NULL)
		return news;
	for (;;) {
		errno = 0;
		struct udev_device *event = udev_monitor_receive_device(hotplug->monitor);
		if (event == NULL && errno != ENOBUFS) /* ENOBUFS: some were lost */
			return news;
		enum hotplug_news one = event != NULL ? judge(event, device) : HOTPLUG_CHANGED;
		news = one > news ? one : news;
		udev_device_unref(event);
	}
}
