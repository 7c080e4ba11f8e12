/* SPDX-License-Identifier: MIT */
#include "hotplug.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <poll.h>

static void there_is_no_news_at_first(void **state)
{
	(void)state;
	struct hotplug *hotplug = hotplug_create(NULL);
	assert_non_null(hotplug);
	struct pollfd descriptor = {.fd = hotplug_fd(hotplug), .events = POLLIN};
	assert_int_equal(poll(&descriptor, 1, 0), 0); /* also where there is none: -1 */
	assert_int_equal(hotplug_read(hotplug, 0), HOTPLUG_NOTHING);
	hotplug_destroy(hotplug);
	hotplug_destroy(NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(there_is_no_news_at_first),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
