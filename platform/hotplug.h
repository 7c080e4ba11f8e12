/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_HOTPLUG_H
#define PLATFORM_HOTPLUG_H

#include <smoothie.h>
#include <sys/types.h>

/** News of DRM devices and their connectors, through libudev; without it there are none, and the
 *  caller has to look now and then. */
struct hotplug;

enum hotplug_news {
	HOTPLUG_NOTHING,
	HOTPLUG_CHANGED, /**< a connector changed, or a device came or went */
	HOTPLUG_REMOVED, /**< the device asked for is gone */
};

/** NULL when out of memory; a system without udev gives one that never has news. */
struct hotplug *hotplug_create(struct sm_error *error);
/** NULL is fine. */
void hotplug_destroy(struct hotplug *hotplug);

/** To poll for reading; -1: none. */
int hotplug_fd(const struct hotplug *hotplug);

/** All the news since the last call, as one, without waiting. device: number of the DRM node that
 *  is in use, 0: none. */
enum hotplug_news hotplug_read(struct hotplug *hotplug, dev_t device);

#endif
