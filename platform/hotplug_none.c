/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include "base/error.h"
#include "hotplug.h"
#include <stdlib.h>

struct hotplug *hotplug_create(struct sm_error *error)
{
	struct hotplug *hotplug = array_zalloc(1, 1);
	if (hotplug == NULL)
		error_no_memory(error);
	return hotplug;
}

void hotplug_destroy(struct hotplug *hotplug)
{
	free(hotplug);
}

int hotplug_fd(const struct hotplug *hotplug)
{
	(void)hotplug;
	return -1;
}

enum hotplug_news hotplug_read(struct hotplug *hotplug, dev_t device)
{
	(void)hotplug, (void)device;
	return HOTPLUG_NOTHING;
}
