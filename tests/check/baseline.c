/* SPDX-License-Identifier: MIT */
/* Baselines: which files are read, which are refused and where, and what an outcome is against one.
 */
#include "check/baseline.h"
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/smoothie-baseline-XXXXXX";

static int enter(void **state)
{
	(void)state;
	return mkdtemp(folder) != NULL && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
	(void)state;
	return chdir("/") == 0 && rmdir(folder) == 0 ? 0 : -1;
}

static bool read_text(
	struct check_baseline *baseline, const char *name, const char *text, struct sm_error *error)
{
	FILE *file = fopen(name, "w");
	assert_non_null(file);
	fputs(text, file);
	assert_int_equal(fclose(file), 0);
	bool read = check_baseline_read(baseline, name, error);
	unlink(name);
	return read;
}

static void test_refused(void **state)
{
	static const struct {
		const char *name, *text, *problem;
	} rows[] = {
		{"a-fails.txt", "clip.near", "a-fails.txt:1: NAME,Status is wanted: clip.near"},
		{"a-fails.txt", "# why\n\nclip.near,Fail\nclip.far,Sad\n",
			"a-fails.txt:4: no status: Sad"},
		{"a-fails.txt", "clip.near,fail", "a-fails.txt:1: no status: fail"},
		{"a-fails.txt", "clip.near,Fail,0.5", "a-fails.txt:1: no status: Fail,0.5"},
		{"a-fails.txt", "clip.near, Fail", "a-fails.txt:1: no status:  Fail"},
		{"a-fails.txt", ",Fail", "a-fails.txt:1: no name of a case"},
		{"a-fails.txt", "clip near,Fail", "a-fails.txt:1: no name of a case: clip near"},
		{"a-fails.txt", "clip.near,Fail\nclip.near,Crash",
			"a-fails.txt:2: a case is named twice: clip.near"},
		{"a-skips.txt", "clip.(near", "a-skips.txt:1: "},
		{"a-flakes.txt", "clip.near\n*[", "a-flakes.txt:2: "},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct check_baseline baseline = {0};
		struct sm_error error = {0};
		assert_false(read_text(&baseline, rows[i].name, rows[i].text, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		assert_ptr_equal(strstr(error.text, rows[i].problem), error.text);
		assert_null(strchr(error.text, '\n'));
		check_baseline_finish(&baseline);
	}
}

static void test_unreadable(void **state)
{
	static const char *const paths[] = {"missing.txt", "."};
	(void)state;
	for (size_t i = 0; i < 2; i++) {
		struct check_baseline baseline = {0};
		struct sm_error error = {0};
		assert_false(check_baseline_read(&baseline, paths[i], &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		check_baseline_finish(&baseline);
	}
}

static void test_zero_byte(void **state)
{
	struct check_baseline baseline = {0};
	struct sm_error error = {0};
	(void)state;
	FILE *file = fopen("a.txt", "w");
	assert_non_null(file);
	assert_int_equal(fwrite("clip.near,Fail\0\n", 1, 16, file), 16);
	assert_int_equal(fclose(file), 0);
	assert_false(check_baseline_read(&baseline, "a.txt", &error));
	assert_non_null(strstr(error.text, "a.txt:1: "));
	unlink("a.txt");
	check_baseline_finish(&baseline);
}

/* What has no end of lines must not be read to its end. */
static void test_a_line_without_end(void **state)
{
	struct check_baseline baseline = {0};
	struct sm_error error = {0};
	(void)state;
	assert_false(check_baseline_read(&baseline, "/dev/zero", &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_string_equal(error.text, "/dev/zero:1: the line is too long: ");
	check_baseline_finish(&baseline);
}

static void test_names_of_no_case(void **state)
{
	struct check_baseline baseline = {0};
	struct check_list list = {0};
	struct sm_error error = {0};
	(void)state;
	assert_non_null(check_list_add(&list, NULL, NULL, "clip.near"));
	assert_true(read_text(&baseline, "a.txt", "clip.near,Fail\n", NULL));
	assert_true(check_baseline_match(&baseline, &list, &error));
	assert_true(read_text(&baseline, "b.txt", "\nclip.nearer,Crash\n", NULL));
	assert_false(check_baseline_match(&baseline, &list, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_non_null(strstr(error.text, "b.txt:2: no case is named clip.nearer;"));
	check_list_finish(&list);
	check_baseline_finish(&baseline);
}

static const char fails[] = "# Comment\n"
			    "\n"
			    "a.fails,Fail\r\n"
			    "  a.crashes,Crash  \n"
			    "a.late,Timeout\n"
			    "a.again,ExpectedFail\n"
			    "a.passes,Pass\n"
			    "a.left,Skip\n"
			    "a.way.smoothie=rg16f,Fail\n";

static void test_judgement(void **state)
{
	static const struct {
		const char *name;
		enum check_status status, judged;
	} rows[] = {
		{"b.other", CHECK_PASS, CHECK_PASS},
		{"b.other", CHECK_FAIL, CHECK_FAIL},
		{"a.fails", CHECK_FAIL, CHECK_EXPECTED_FAIL},
		{"a.fails", CHECK_PASS, CHECK_UNEXPECTED_PASS},
		{"a.fails", CHECK_CRASH, CHECK_CRASH},
		{"a.fails", CHECK_SKIP, CHECK_SKIP},
		{"a.crashes", CHECK_CRASH, CHECK_EXPECTED_FAIL},
		{"a.crashes", CHECK_FAIL, CHECK_FAIL},
		{"a.late", CHECK_TIMEOUT, CHECK_EXPECTED_FAIL},
		{"a.again", CHECK_FAIL, CHECK_EXPECTED_FAIL},
		{"a.passes", CHECK_PASS, CHECK_PASS},
		{"a.passes", CHECK_FAIL, CHECK_FAIL},
		{"a.left", CHECK_PASS, CHECK_PASS},
		{"a.way.smoothie=rg16f", CHECK_FAIL, CHECK_EXPECTED_FAIL},
		{"f.now-and-then", CHECK_FAIL, CHECK_FLAKE},
		{"f.now-and-then", CHECK_CRASH, CHECK_FLAKE},
		{"f.now-and-then", CHECK_PASS, CHECK_PASS},
	};
	struct check_baseline baseline = {0};
	(void)state;
	assert_true(read_text(&baseline, "driver-fails.txt", fails, NULL));
	assert_true(read_text(&baseline, "driver-flakes.txt", "# often\n^f\\.now", NULL));
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		assert_int_equal(check_baseline_judge(&baseline, rows[i].name, rows[i].status),
			rows[i].judged);
	check_baseline_finish(&baseline);
}

static void test_skips(void **state)
{
	struct check_baseline baseline = {0};
	(void)state;
	assert_true(read_text(&baseline, "x-skips.txt", "^clip\\.\n\n(min|max)$\n", NULL));
	assert_string_equal(check_baseline_skips(&baseline, "clip.near"), "x-skips.txt:1");
	assert_string_equal(check_baseline_skips(&baseline, "format.r8.max"), "x-skips.txt:3");
	assert_null(check_baseline_skips(&baseline, "format.r8.maximum"));
	check_baseline_finish(&baseline);
}

static void test_attempts(void **state)
{
	static const struct {
		enum check_status first, second, both;
	} rows[] = {
		{CHECK_FAIL, CHECK_FAIL, CHECK_FAIL},
		{CHECK_FAIL, CHECK_PASS, CHECK_FLAKE},
		{CHECK_FAIL, CHECK_CRASH, CHECK_FAIL},
		{CHECK_CRASH, CHECK_FAIL, CHECK_CRASH},
		{CHECK_CRASH, CHECK_EXPECTED_FAIL, CHECK_FLAKE},
		{CHECK_TIMEOUT, CHECK_PASS, CHECK_FLAKE},
		{CHECK_FAIL, CHECK_UNEXPECTED_PASS, CHECK_FAIL},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		assert_int_equal(check_attempts_judge(rows[i].first, rows[i].second), rows[i].both);
}

static void test_status_names(void **state)
{
	(void)state;
	for (int i = 0; i < CHECK_STATUS_COUNT; i++) {
		enum check_status found = CHECK_STATUS_COUNT;
		assert_true(check_status_find(check_status_name((enum check_status)i), &found));
		assert_int_equal(found, i);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_refused),
		cmocka_unit_test(test_unreadable),
		cmocka_unit_test(test_zero_byte),
		cmocka_unit_test(test_a_line_without_end),
		cmocka_unit_test(test_names_of_no_case),
		cmocka_unit_test(test_judgement),
		cmocka_unit_test(test_skips),
		cmocka_unit_test(test_attempts),
		cmocka_unit_test(test_status_names),
	};
	return cmocka_run_group_tests(tests, enter, leave);
}
