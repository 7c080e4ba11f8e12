/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void an_error_is_a_status_and_one_line(void **state)
{
	(void)state;
	struct sm_error error;
	assert_false(error_set(&error, SM_ERROR_INPUT, "mesh %s: no vertex %u", "stone", 7u));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_string_equal(error.text, "mesh stone: no vertex 7");
	assert_false(error_no_memory(&error));
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_string_equal(error.text, "out of memory");
}

/* Names and values from files are in it. */
static void control_characters_are_blanks(void **state)
{
	(void)state;
	struct sm_error error;
	error_set(&error, SM_ERROR_INPUT, "%s", "two\nlines\r\x1b[31m\x7f, caf\xc3\xa9");
	assert_string_equal(error.text, "two lines  [31m , caf\xc3\xa9");
}

static void no_one_need_listen(void **state)
{
	(void)state;
	assert_false(error_set(NULL, SM_ERROR_INPUT, "%d", 1));
	assert_false(error_no_memory(NULL));
}

static void a_long_line_is_cut(void **state)
{
	(void)state;
	struct {
		struct sm_error error;
		char after;
	} guarded = {.after = 'x'};
	char text[2 * sizeof(guarded.error.text)];
	memset(text, 'a', sizeof(text));
	text[sizeof(text) - 1] = '\0';
	error_set(&guarded.error, SM_ERROR_INPUT, "%s", text);
	assert_int_equal(strlen(guarded.error.text), sizeof(guarded.error.text) - 1);
	assert_int_equal(guarded.after, 'x');
}

/* smoothie.h: the values are the exit statuses of the program. */
static void statuses_are_exit_statuses(void **state)
{
	(void)state;
	assert_int_equal(SM_OK, 0);
	assert_int_equal(SM_ERROR_MACHINE, 1);
	assert_int_equal(SM_ERROR_INPUT, 2);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(an_error_is_a_status_and_one_line),
		cmocka_unit_test(control_characters_are_blanks),
		cmocka_unit_test(no_one_need_listen),
		cmocka_unit_test(a_long_line_is_cut),
		cmocka_unit_test(statuses_are_exit_statuses),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
