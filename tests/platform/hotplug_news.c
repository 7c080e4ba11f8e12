/* SPDX-License-Identifier: MIT */
/* What events mean, with this program in libudev's place. */
#include "hotplug.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <errno.h>
#include <libudev.h>
#include <unistd.h>

struct udev_device {
	const char *action; /* NULL: no event but the error */
	dev_t number;
	int error;
};

static const struct udev_device *script; /* up to {0} */
static int held;                         /* objects not given back */
static int refusal;                      /* errno of udev_monitor_enable_receiving() */
static const char *group, *subsystem;

struct udev *udev_new(void)
{
	held++;
	return (struct udev *)&held;
}

struct udev *udev_unref(struct udev *udev)
{
	held -= udev != NULL;
	return NULL;
}

struct udev_monitor *udev_monitor_new_from_netlink(struct udev *udev, const char *name)
{
	(void)udev;
	held++;
	group = name;
	return (struct udev_monitor *)&held;
}

int udev_monitor_filter_add_match_subsystem_devtype(
	struct udev_monitor *monitor, const char *name, const char *type)
{
	(void)monitor;
	assert_null(type);
	subsystem = name;
	return 0;
}

int udev_monitor_enable_receiving(struct udev_monitor *monitor)
{
	(void)monitor;
	errno = refusal;
	return -refusal;
}

int udev_monitor_get_fd(struct udev_monitor *monitor)
{
	(void)monitor;
	return 77;
}

struct udev_monitor *udev_monitor_unref(struct udev_monitor *monitor)
{
	held -= monitor != NULL;
	return NULL;
}

struct udev_device *udev_monitor_receive_device(struct udev_monitor *monitor)
{
	(void)monitor;
	if (script->action == NULL && script->error == 0) {
		errno = EAGAIN;
		return NULL;
	}
	errno = script->error;
	held += script->action != NULL;
	const struct udev_device *event = script++;
	return event->action != NULL ? (struct udev_device *)event : NULL;
}

const char *udev_device_get_action(struct udev_device *device)
{
	return device->action[0] != '\0' ? device->action : NULL;
}

dev_t udev_device_get_devnum(struct udev_device *device)
{
	return device->number;
}

struct udev_device *udev_device_unref(struct udev_device *device)
{
	held -= device != NULL;
	return NULL;
}

enum { ours = 0xe200, other = 0xe201 }; /* 226:0 and 226:1 */

static void all_events_are_one_piece_of_news(void **state)
{
	(void)state;
	const struct {
		struct udev_device events[4];
		dev_t device;
		enum hotplug_news news;
	} cases[] = {
		{{{0}}, ours, HOTPLUG_NOTHING},
		{{{"change", ours}}, ours, HOTPLUG_CHANGED},
		{{{"change", other}}, ours, HOTPLUG_CHANGED},
		{{{"add", other}}, 0, HOTPLUG_CHANGED},
		{{{"", ours}}, ours, HOTPLUG_CHANGED},
		{{{"remove", other}}, ours, HOTPLUG_CHANGED},
		{{{"remove", ours}}, ours, HOTPLUG_REMOVED},
		{{{"remove", ours}}, 0, HOTPLUG_CHANGED},
		/* a connector's device has no number */
		{{{"remove", 0}}, ours, HOTPLUG_CHANGED},
		{{{"remove", 0}}, 0, HOTPLUG_CHANGED},
		{{{"change", ours}, {"remove", ours}, {"add", other}}, ours, HOTPLUG_REMOVED},
		/* lost events may have been any */
		{{{.error = ENOBUFS}}, ours, HOTPLUG_CHANGED},
		{{{.error = ENOBUFS}, {"remove", ours}}, ours, HOTPLUG_REMOVED},
		{{{"change", ours}, {.error = EINVAL}}, ours, HOTPLUG_CHANGED},
	};
	struct hotplug *hotplug = hotplug_create(NULL);
	assert_int_equal(hotplug_fd(hotplug), 77);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		script = cases[i].events;
		assert_int_equal(hotplug_read(hotplug, cases[i].device), cases[i].news);
		assert_int_equal(held, 2);
	}
	hotplug_destroy(hotplug);
	assert_int_equal(held, 0);
}

static void only_displays_are_listened_to(void **state)
{
	(void)state;
	hotplug_destroy(hotplug_create(NULL));
	assert_string_equal(subsystem, "drm");
	assert_string_equal(group, access("/run/udev/control", F_OK) == 0 ? "udev" : "kernel");
}

static void a_system_that_refuses_has_no_news(void **state)
{
	(void)state;
	refusal = EPERM;
	struct hotplug *hotplug = hotplug_create(NULL);
	refusal = 0;
	assert_non_null(hotplug);
	assert_int_equal(hotplug_fd(hotplug), -1);
	assert_int_equal(hotplug_read(hotplug, ours), HOTPLUG_NOTHING);
	hotplug_destroy(hotplug);
	assert_int_equal(held, 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(all_events_are_one_piece_of_news),
		cmocka_unit_test(only_displays_are_listened_to),
		cmocka_unit_test(a_system_that_refuses_has_no_news),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
