/* SPDX-License-Identifier: MIT */
/* What is printed is written whole, and a writer's failure is the printer's. */
#include "page/file.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

static char written[64];

static void print_twice(FILE *file, const void *data)
{
	fprintf(file, "%s%s", (const char *)data, (const char *)data);
}

static bool keep(const char *path, const void *bytes, size_t size, struct sm_error *error)
{
	(void)error;
	assert_true(size < sizeof(written));
	assert_string_equal(path, "a file");
	memcpy(written, bytes, size);
	written[size] = '\0';
	return true;
}

static bool refuse(const char *path, const void *bytes, size_t size, struct sm_error *error)
{
	(void)bytes;
	(void)size;
	return error_set(error, SM_ERROR_MACHINE, "cannot write %s", path);
}

static void test_all_is_written(void **state)
{
	(void)state;
	struct sm_error error;
	assert_true(file_print("a file", print_twice, "text", keep, &error));
	assert_string_equal(written, "texttext");
	assert_true(file_print("a file", print_twice, "", keep, &error));
	assert_string_equal(written, "");
}

static void test_what_cannot_be_written_fails(void **state)
{
	(void)state;
	struct sm_error error = {0};
	assert_false(file_print("a file", print_twice, "text", refuse, &error));
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_string_equal(error.text, "cannot write a file");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_all_is_written),
		cmocka_unit_test(test_what_cannot_be_written_fails),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
