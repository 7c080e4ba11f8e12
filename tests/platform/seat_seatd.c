/* SPDX-License-Identifier: MIT */
/* A seat from a seatd of the test's own, which has /run for itself and no virtual terminal. */
#include "seat.h"
#include "seat_backend.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <fcntl.h>
#include <libseat.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

static pid_t seatd;

/* Returns once it listens, or has failed to. */
static bool start_seatd(void)
{
	int ready[2];
	char byte = 0;
	assert_int_equal(pipe(ready), 0);
	seatd = fork();
	assert_true(seatd >= 0);
	if (seatd == 0) {
		int null = open("/dev/null", O_RDWR);
		dup2(null, STDERR_FILENO);
		dup2(ready[1], 3);
		setenv("SEATD_VTBOUND", "0", 1);
		execlp("seatd", "seatd", "-n", "3", (char *)NULL);
		execl("/usr/sbin/seatd", "seatd", "-n", "3", (char *)NULL);
		_exit(127);
	}
	close(ready[1]);
	bool started = read(ready[0], &byte, 1) == 1;
	close(ready[0]);
	return started;
}

static void end_seatd(void)
{
	if (seatd > 0) {
		kill(seatd, SIGKILL);
		waitpid(seatd, NULL, 0);
	}
	seatd = 0;
}

static int set_up(void **state)
{
	(void)state;
	return start_seatd() ? 0 : -1;
}

static int tear_down(void **state)
{
	(void)state;
	end_seatd();
	unlink("/run/seatd.sock");
	return 0;
}

static void await_news(struct seat *seat)
{
	struct pollfd descriptor = {.fd = seat_fd(seat), .events = POLLIN};
	assert_int_equal(poll(&descriptor, 1, 5000), 1);
	assert_true(seat_dispatch(seat, NULL));
}

static void without_a_manager_it_is_direct_even_for_root(void **state)
{
	(void)state;
	struct seat *seat = seat_create(NULL);
	assert_string_equal(seat_name(seat), "direct");
	assert_true(seat_is_active(seat));
	assert_null(getenv("LIBSEAT_BACKEND"));
	seat_destroy(seat);
}

static void seatd_is_found(void **state)
{
	(void)state;
	struct seat *seat = seat_create(NULL);
	assert_string_equal(seat_name(seat), "seatd");
	assert_true(seat_fd(seat) >= 0);
	assert_true(seat_is_active(seat));
	assert_int_equal(seat_activations(seat), 1);
	assert_true(seat_dispatch(seat, NULL));
	seat_destroy(seat);
}

static void only_devices_of_a_seat_are_opened(void **state)
{
	(void)state;
	static const struct {
		const char *path, *text;
	} cases[] = {
		{"/dev/null", "it is no device of a seat"},
		{"/dev/missing", "No such file or directory"},
		{"", "No such file or directory"},
	};
	struct seat *seat = seat_create(NULL);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_error error = {0};
		assert_int_equal(seat_open_device(seat, cases[i].path, &error), -1);
		assert_int_equal(error.status, SM_ERROR_INPUT);
		assert_string_equal(error.text, cases[i].text);
	}
	seat_destroy(seat);
}

static void it_is_given_up_and_comes_back(void **state)
{
	(void)state;
	struct sm_error error = {0};
	struct seat *first = seat_create(NULL), *second = seat_create(NULL);
	assert_false(seat_is_active(second));
	assert_int_equal(seat_open_device(second, "/dev/null", &error), -1);
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_non_null(strstr(error.text, "not active"));

	libseat_switch_session(first->manager, 1);
	await_news(first);
	assert_false(seat_is_active(first));
	await_news(second);
	assert_true(seat_is_active(second));
	assert_int_equal(seat_activations(second), 1);

	seat_destroy(second);
	await_news(first);
	assert_true(seat_is_active(first));
	assert_int_equal(seat_activations(first), 2);
	seat_destroy(first);
}

static void a_manager_that_dies_is_noticed(void **state)
{
	(void)state;
	struct sm_error error = {0};
	struct seat *seat = seat_create(NULL);
	struct pollfd descriptor = {.fd = seat_fd(seat), .events = POLLIN};
	end_seatd();
	assert_int_equal(poll(&descriptor, 1, 5000), 1);
	assert_false(seat_dispatch(seat, &error));
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_non_null(strstr(error.text, "seatd has gone"));
	assert_false(seat_is_active(seat));
	assert_int_equal(seat_fd(seat), -1);
	assert_int_equal(seat_open_device(seat, "/dev/null", NULL), -1);
	seat_destroy(seat);
}

static bool write_line(const char *path, const char *line)
{
	const ssize_t length = (ssize_t)strlen(line);
	int fd = open(path, O_WRONLY | O_CLOEXEC);
	bool written = fd >= 0 && write(fd, line, (size_t)length) == length;
	if (fd >= 0)
		close(fd);
	return written;
}

/* To this process, a user becomes root, which may mount. */
static bool become_root(uid_t user, gid_t group)
{
	char users[40], groups[40];
	snprintf(users, sizeof(users), "0 %u 1", user);
	snprintf(groups, sizeof(groups), "0 %u 1", group);
	return unshare(CLONE_NEWUSER) == 0 && write_line("/proc/self/setgroups", "deny") &&
	       write_line("/proc/self/uid_map", users) && write_line("/proc/self/gid_map", groups);
}

static bool own_run(void)
{
	return (geteuid() == 0 || become_root(geteuid(), getegid())) && unshare(CLONE_NEWNS) == 0 &&
	       mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) == 0 &&
	       mount("none", "/run", "tmpfs", 0, NULL) == 0;
}

static int leave_out(const char *why)
{
	printf("skipped: %s\n", why);
	return 77;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(without_a_manager_it_is_direct_even_for_root),
		cmocka_unit_test_setup_teardown(seatd_is_found, set_up, tear_down),
		cmocka_unit_test_setup_teardown(
			only_devices_of_a_seat_are_opened, set_up, tear_down),
		cmocka_unit_test_setup_teardown(it_is_given_up_and_comes_back, set_up, tear_down),
		cmocka_unit_test_setup_teardown(a_manager_that_dies_is_noticed, set_up, tear_down),
	};
	unsetenv("SEATD_SOCK");
	unsetenv("LIBSEAT_BACKEND");
	if (!own_run())
		return leave_out("this user may not mount a /run of its own");
	bool installed = start_seatd();
	tear_down(NULL);
	if (!installed)
		return leave_out("seatd does not start, or is not installed");
	return cmocka_run_group_tests(tests, NULL, NULL);
}
