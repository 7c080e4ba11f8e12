/* SPDX-License-Identifier: MIT */
/* What the service manager hears, with this program in its place. */
#include "app/service.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

static int manager;

static int listen_as_manager(void **state)
{
	(void)state;
	struct sockaddr_un address = {.sun_family = AF_UNIX};
	manager = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
	/* an abstract name, which leaves nothing behind */
	int length = snprintf(address.sun_path + 1, sizeof(address.sun_path) - 1,
		"smoothie-test-%d", (int)getpid());
	char name[sizeof(address.sun_path) + 1];
	snprintf(name, sizeof(name), "@%s", address.sun_path + 1);
	setenv("NOTIFY_SOCKET", name, 1);
	return bind(manager, (struct sockaddr *)&address,
		(socklen_t)(sizeof(sa_family_t) + 1 + (size_t)length));
}

static int stop_listening(void **state)
{
	(void)state;
	unsetenv("NOTIFY_SOCKET");
	return close(manager);
}

static void assert_heard(const char *text)
{
	char message[400];
	ssize_t size = recv(manager, message, sizeof(message) - 1, 0);
	assert_true(size >= 0);
	message[size] = '\0';
	assert_string_equal(message, text);
}

static void each_event_is_one_message(void **state)
{
	(void)state;
	service_ready();
	assert_heard("READY=1");
	service_status("%ux%u on %s", 1920u, 1080u, "HDMI-A-1");
	assert_heard("STATUS=1920x1080 on HDMI-A-1");
	service_alive();
	assert_heard("WATCHDOG=1");
	service_stopping();
	assert_heard("STOPPING=1");
}

static void a_long_status_is_cut(void **state)
{
	(void)state;
	char message[500];
	service_status("%0400d", 0);
	assert_int_equal(recv(manager, message, sizeof(message), 0), 7 + 299);
}

static void without_a_manager_nothing_happens(void **state)
{
	(void)state;
	unsetenv("NOTIFY_SOCKET");
	service_ready();
	service_status("unheard");
	service_alive();
	service_stopping();
	char message[10];
	assert_int_equal(recv(manager, message, sizeof(message), 0), -1);
}

static void the_watchdog_is_fed_twice_as_often_as_it_asks(void **state)
{
	(void)state;
	static const struct {
		const char *microseconds;
		uint32_t interval; /* ms */
	} cases[] = {
		{NULL, 0},
		{"20000000", 10000},
		{"3000", 1},
		{"1", 1}, /* not 0, which means none */
		{"18446744073709551000", INT32_MAX},
		{"", 0},
		{"soon", 0},
		{"-1", 0},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		unsetenv("WATCHDOG_USEC");
		if (cases[i].microseconds != NULL)
			setenv("WATCHDOG_USEC", cases[i].microseconds, 1);
		assert_int_equal(service_watchdog(), cases[i].interval);
	}
	setenv("WATCHDOG_USEC", "20000000", 1);
	setenv("WATCHDOG_PID", "1", 1); /* meant for another process */
	assert_int_equal(service_watchdog(), 0);
	unsetenv("WATCHDOG_USEC");
	unsetenv("WATCHDOG_PID");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
			each_event_is_one_message, listen_as_manager, stop_listening),
		cmocka_unit_test_setup_teardown(
			a_long_status_is_cut, listen_as_manager, stop_listening),
		cmocka_unit_test_setup_teardown(
			without_a_manager_nothing_happens, listen_as_manager, stop_listening),
		cmocka_unit_test(the_watchdog_is_fed_twice_as_often_as_it_asks),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
