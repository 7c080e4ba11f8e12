/* SPDX-License-Identifier: MIT */
/* The bar that shows how far work has come, on terminals of several widths. */
#define _GNU_SOURCE /* posix_openpt() */
#include "app/progress.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

struct terminal {
	int master, slave, before; /* before: what stderr was */
};

/* Makes a terminal of that width stderr. */
static void terminal_init(struct terminal *terminal, unsigned short columns)
{
	const struct winsize size = {.ws_row = 20, .ws_col = columns};
	terminal->master = posix_openpt(O_RDWR | O_NOCTTY);
	assert_true(terminal->master >= 0);
	assert_int_equal(grantpt(terminal->master), 0);
	assert_int_equal(unlockpt(terminal->master), 0);
	terminal->slave = open(ptsname(terminal->master), O_RDWR | O_NOCTTY);
	assert_true(terminal->slave >= 0);
	assert_int_equal(ioctl(terminal->slave, TIOCSWINSZ, &size), 0);
	terminal->before = dup(STDERR_FILENO);
	dup2(terminal->slave, STDERR_FILENO);
}

static void terminal_finish(struct terminal *terminal)
{
	dup2(terminal->before, STDERR_FILENO);
	close(terminal->before);
	close(terminal->slave);
	close(terminal->master);
}

/* Half of the work, done in ten seconds. */
static void draw(unsigned short columns, char line[256])
{
	struct terminal terminal;
	struct progress progress;
	terminal_init(&terminal, columns);
	progress_start(&progress, 600, false);
	progress.start -= 10000;
	progress_update(&progress, 300);
	ssize_t size = read(terminal.master, line, 255);
	terminal_finish(&terminal);
	assert_true(size > 0);
	line[size] = '\0';
}

/* Between the return and what clears the rest. */
static size_t width_of(const char *line)
{
	const char *end = strchr(line, '\033');
	assert_int_equal(line[0], '\r');
	assert_non_null(end);
	return (size_t)(end - line - 1);
}

static void test_lines_do_not_wrap(void **state)
{
	(void)state;
	for (unsigned short columns = 1; columns < 100; columns++) {
		char line[256];
		draw(columns, line);
		assert_true(width_of(line) < columns);
	}
}

static void test_a_wide_one_has_all(void **state)
{
	char line[256];
	(void)state;
	draw(200, line);
	assert_non_null(strstr(line, "[####################                    ] 300 of 600, 0:10 "
				     "left"));
	draw(40, line);
	assert_non_null(strstr(line, "] 300 of 600, 0:10 left"));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_lines_do_not_wrap),
		cmocka_unit_test(test_a_wide_one_has_all),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
