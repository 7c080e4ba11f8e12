/* SPDX-License-Identifier: MIT */
/* A seat without a manager: devices are opened as they are. */
#include "seat.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int create(void **state)
{
	/* Whatever runs on this machine is not to be asked. */
	setenv("LIBSEAT_BACKEND", "nobody", 1);
	*state = seat_create(NULL);
	return *state == NULL;
}

static int destroy(void **state)
{
	seat_destroy(*state);
	return 0;
}

static void it_is_active_from_the_start(void **state)
{
	struct sm_error error;
	assert_string_equal(seat_name(*state), "direct");
	assert_int_equal(seat_fd(*state), -1);
	assert_true(seat_dispatch(*state, &error));
	assert_true(seat_is_active(*state));
	assert_int_equal(seat_activations(*state), 1);
}

static bool is_open(int fd)
{
	return fcntl(fd, F_GETFD) >= 0;
}

static void devices_are_for_this_process_to_read_and_write(void **state)
{
	int fd = seat_open_device(*state, "/dev/null", NULL);
	assert_true(fd >= 0);
	assert_int_equal(fcntl(fd, F_GETFD) & FD_CLOEXEC, FD_CLOEXEC);
	assert_int_equal(fcntl(fd, F_GETFL) & O_ACCMODE, O_RDWR);
	seat_close_device(*state, fd);
	assert_false(is_open(fd));
}

static void what_is_none_of_its_devices_stays_open(void **state)
{
	int fd = open("/dev/null", O_RDONLY | O_CLOEXEC);
	seat_close_device(*state, fd);
	seat_close_device(*state, -1);
	seat_close_device(NULL, -1);
	assert_true(is_open(fd));
	close(fd);
}

static void its_devices_end_with_it(void **state)
{
	(void)state;
	int fds[5];
	struct seat *seat = seat_create(NULL);
	for (size_t i = 0; i < 5; i++)
		fds[i] = seat_open_device(seat, "/dev/null", NULL);
	seat_close_device(seat, fds[1]);
	assert_true(is_open(fds[4]));
	seat_destroy(seat);
	for (size_t i = 0; i < 5; i++)
		assert_false(is_open(fds[i]));
	seat_destroy(NULL);
}

static void assert_refused(
	struct seat *seat, const char *path, enum sm_status status, const char *text)
{
	struct sm_error error = {0};
	assert_int_equal(seat_open_device(seat, path, &error), -1);
	assert_int_equal(error.status, status);
	assert_non_null(strstr(error.text, text));
	assert_null(strchr(error.text, '\n'));
	assert_int_equal(seat_open_device(seat, path, NULL), -1);
}

static void paths_that_are_none(void **state)
{
	assert_refused(*state, "/dev/missing", SM_ERROR_INPUT, "No such file or directory");
	assert_refused(*state, "/dev/null/card0", SM_ERROR_INPUT, "Not a directory");
	assert_refused(*state, "", SM_ERROR_INPUT, "No such file or directory");
	assert_refused(*state, "/", SM_ERROR_MACHINE, "Is a directory");
}

static void a_forbidden_path_says_what_to_do(void **state)
{
	char path[] = "/tmp/smoothie-seat-XXXXXX";
	const uid_t user = geteuid(), nobody = 65534;
	int fd = mkstemp(path);
	assert_true(fd >= 0);
	assert_int_equal(fchmod(fd, 0), 0);
	close(fd);
	if (user == 0)
		assert_int_equal(seteuid(nobody), 0);
	assert_refused(*state, path, SM_ERROR_MACHINE,
		"permission denied: run it from a seat (seatd or logind), as a member of the group "
		"video, or as root");
	assert_int_equal(seteuid(user), 0);
	unlink(path);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(it_is_active_from_the_start),
		cmocka_unit_test(devices_are_for_this_process_to_read_and_write),
		cmocka_unit_test(what_is_none_of_its_devices_stays_open),
		cmocka_unit_test(its_devices_end_with_it),
		cmocka_unit_test(paths_that_are_none),
		cmocka_unit_test(a_forbidden_path_says_what_to_do),
	};
	return cmocka_run_group_tests(tests, create, destroy);
}
