/* SPDX-License-Identifier: MIT */
/* Flags of `smoothie check` from a file. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static size_t count_lines(const char *text)
{
	size_t count = 0;
	while ((text = strchr(text, '\n')) != NULL) {
		text++;
		count++;
	}
	return count;
}

static void assert_cases(const struct run *run, size_t count)
{
	struct outcome outcome = run_program(run);
	assert_int_equal(outcome.status, 0);
	assert_string_equal(outcome.error, "");
	assert_int_equal(count_lines(outcome.out), count);
	outcome_finish(&outcome);
}

/* There are eight functions that compare depths. */
static void test_flags_are_taken_in_order(void **state)
{
	(void)state;
	write_text("half.ini", "# of all\n[check]\ntest = depth.test.*\nfraction = 2\n");
	assert_cases(&(struct run){{"check", "--list", "--test", "depth.test.*"}}, 8);
	assert_cases(&(struct run){{"check", "--list", "--preset", "half.ini"}}, 4);
	assert_cases(
		&(struct run){{"check", "--list", "--preset", "half.ini", "--fraction", "4"}}, 2);
	assert_cases(
		&(struct run){{"check", "--list", "--fraction", "4", "--preset", "half.ini"}}, 4);
}

/* 240 bytes, which is more than inih takes for a line */
#define TWENTY "0123456789abcdefghij"
#define LONG TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY TWENTY

static void test_comments_may_be_long(void **state)
{
	(void)state;
	write_text("preset.ini", "# " LONG "\n[check]\ntest = depth.mask\n");
	assert_cases(&(struct run){{"check", "--list", "--preset", "preset.ini"}}, 1);
}

static void test_files_without_text(void **state)
{
	(void)state;
	struct outcome folder = RUN("check", "--list", "--preset", ".");
	struct outcome zeros = RUN("check", "--list", "--preset", "/dev/zero");
	assert_failure(&folder, 2, "cannot read . (Is a directory)");
	assert_failure(&zeros, 2, "/dev/zero:1: a line of text");
	outcome_finish(&folder);
	outcome_finish(&zeros);
}

static void test_files_that_cannot_be_used(void **state)
{
	(void)state;
	static const struct {
		const char *text; /* of the file; NULL: there is none */
		const char *problem;
	} cases[] = {
		{NULL, "cannot read preset.ini"},
		{"[check]\njobs = none\n", "preset.ini:2: --jobs none: "},
		{"[check]\nlist = 1\n", "preset.ini:2: no flag with a value is named \"list\""},
		{"[check]\npreset = preset.ini\n", "preset.ini:2: no flag with a value"},
		{"jobs = 1\n", "preset.ini:1: section [check] is wanted, not []"},
		{"[check]\n\njobs\n", "preset.ini:3: NAME = VALUE is wanted"},
		{"[check]\ntest = " LONG "\n", "preset.ini:2: a line of text shorter than"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		if (cases[i].text != NULL)
			write_text("preset.ini", cases[i].text);
		struct outcome outcome = RUN("check", "--list", "--preset", "preset.ini");
		assert_failure(&outcome, 2, cases[i].problem);
		outcome_finish(&outcome);
	}
}

/* The folder that a program runs in is not the preset's. */
static void test_baselines_are_beside_the_file(void **state)
{
	(void)state;
	write_text("expect.txt", "not a line\n");
	write_text("preset.ini", "[check]\nexpect = expect.txt\ntest = depth.mask\n");
	struct outcome outcome = RUN("check", "--preset", "./preset.ini");
	assert_failure(&outcome, 2, "./expect.txt:1: ");
	outcome_finish(&outcome);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
			test_flags_are_taken_in_order, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(
			test_comments_may_be_long, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(
			test_files_without_text, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(
			test_files_that_cannot_be_used, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(
			test_baselines_are_beside_the_file, enter_scratch, leave_scratch),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
