/* SPDX-License-Identifier: MIT */
/* The conformance run as a whole: what it refuses, prints and leaves, and with which status. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const struct {
	const char *text;
	const char *arguments[MAX_ARGUMENTS];
} refused[] = {
	{"no argument is wanted, but clip.near; see smoothie check --help", {"check", "clip.near"}},
	{"unknown flag --frob;", {"check", "--frob"}},
	{"--test clip.none-such: no case is named so", {"check", "--test", "clip.none-such"}},
	{"--test nothing.*: no case",
		{"check", "--list", "--test", "clip.*", "--test", "nothing.*"}},
	{"--jobs 0: a number from 1 to 1024", {"check", "--jobs", "0"}},
	{"--fraction x: ", {"check", "--fraction", "x"}},
	{"--fraction-start 3 is beyond --fraction 2",
		{"check", "--fraction", "2", "--fraction-start", "3"}},
	{"--fraction-start 2 is beyond --fraction 1", {"check", "--fraction-start", "2"}},
	{"--timeout 0: ", {"check", "--timeout", "0"}},
	{"--timeout nan: ", {"check", "--timeout", "nan"}},
	{"--size 64: ", {"check", "--size", "64"}},
	{"--size 64x5000: ", {"check", "--size", "64x5000"}},
	{"cannot read missing.txt (No such file", {"check", "--expect", "missing.txt"}},
	{"bad-fails.txt:2: no status: Sad", {"check", "--expect", "bad-fails.txt"}},
	{"old-fails.txt:1: no case is named clip.once",
		{"check", "--list", "--test", "clip.near", "--expect", "old-fails.txt"}},
	{"bad-skips.txt:1: ", {"check", "--expect", "bad-skips.txt"}},
	{"no cap \"warp\"; there are: ", {"check", "--test", "clip.near", "--caps", "-warp"}},
	{"no way \"x\" of the need smoothie",
		{"check", "--test", "clip.near", "--path", "smoothie=x"}},
	{"nowhere", {"check", "--test", "clip.near", "--device", "nowhere"}},
};

static void test_bad_command_lines(void **state)
{
	(void)state;
	write_text("bad-fails.txt", "clip.near,Fail\nclip.far,Sad\n");
	write_text("old-fails.txt", "clip.once,Fail\n");
	write_text("bad-skips.txt", "clip.(\n");
	for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++) {
		struct run run = {0};
		memcpy(run.arguments, refused[i].arguments, sizeof(run.arguments));
		struct outcome outcome = run_program(&run);
		assert_failure(&outcome, 2, refused[i].text);
		assert_string_equal(outcome.out, "");
		outcome_finish(&outcome);
	}
}

static size_t count_lines(const char *text)
{
	size_t lines = 0;
	for (; *text != '\0'; text++)
		lines += *text == '\n';
	return lines;
}

static void test_lists_are_shared_out(void **state)
{
	static const char *const starts[] = {"1", "2", "3"};
	(void)state;
	struct outcome all = RUN("check", "--list");
	size_t lines = 0;
	assert_int_equal(all.status, 0);
	for (size_t i = 0; i < 3; i++) {
		struct outcome part =
			RUN("check", "--list", "--fraction", "3", "--fraction-start", starts[i]);
		assert_int_equal(part.status, 0);
		lines += count_lines(part.out);
		outcome_finish(&part);
	}
	assert_int_equal(lines, count_lines(all.out));
	outcome_finish(&all);
}

static bool exists(const char *path)
{
	return access(path, R_OK) == 0;
}

static char *read_text(const char *path)
{
	FILE *file = fopen(path, "r");
	char *text = calloc(1, 65536);
	assert_true(file != NULL && text != NULL);
	assert_true(fread(text, 1, 65535, file) > 0);
	fclose(file);
	return text;
}

#define SURFACELESS "--device", "surfaceless"

static void test_a_run_leaves_reports(void **state)
{
	static const char *const lines[] = {
		"llvmpipe", ", device surfaceless\n", "Pass            2\n"};
	static const char *const files[] = {
		"out/results.csv", "out/failures.csv", "out/junit.xml", "out/report.html"};
	(void)state;
	struct outcome outcome = RUN("check", SURFACELESS, "--test", "clip.near", "--test",
		"clip.none", "--output", "out");
	ASSERT_LINES(&outcome, lines);
	for (size_t i = 0; i < sizeof(files) / sizeof(files[0]); i++)
		assert_true(exists(files[i]));
	char *results = read_text("out/results.csv");
	assert_int_equal(count_lines(results), 2);
	assert_non_null(strstr(results, "clip.near,Pass,"));
	free(results);
	outcome_finish(&outcome);
}

static void test_baselines(void **state)
{
	(void)state;
	write_text("driver-fails.txt", "# none of it is so\nclip.near,Fail\n");
	write_text("driver-skips.txt", "^clip\\.near$\n");
	struct outcome passes =
		RUN("check", SURFACELESS, "--test", "clip.near", "--expect", "driver-fails.txt");
	assert_failure(&passes, 1, "1 of 1 cases did not end as expected");
	assert_non_null(strstr(passes.out, "UnexpectedPass clip.near"));
	struct outcome skipped = RUN("check", SURFACELESS, "--test", "clip.near", "--expect",
		"driver-fails.txt", "--expect", "driver-skips.txt");
	assert_int_equal(skipped.status, 0);
	assert_non_null(strstr(skipped.out, "Skip            1\n"));
	outcome_finish(&passes);
	outcome_finish(&skipped);
}

static void test_tap(void **state)
{
	static const char *const lines[] = {"TAP version 13\n1..1\n", "ok 1 - clip.near"};
	(void)state;
	struct outcome outcome = RUN("check", SURFACELESS, "--test", "clip.near", "--tap");
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

static void test_timeouts_are_told(void **state)
{
	(void)state;
	struct outcome outcome = RUN("check", SURFACELESS, "--test", "context.create-destroy",
		"--timeout", "0.01", "--output", "out");
	assert_failure(&outcome, 1, "1 of 1 cases did not end as expected");
	assert_non_null(strstr(outcome.out, "Timeout context.create-destroy"));
	char *failures = read_text("out/failures.csv");
	assert_string_equal(failures, "context.create-destroy,Timeout\n");
	free(failures);
	outcome_finish(&outcome);
}

static void test_folders_that_cannot_be_written(void **state)
{
	(void)state;
	write_text("file", "");
	struct outcome missing =
		RUN("check", SURFACELESS, "--test", "clip.near", "--output", "missing/out");
	assert_failure(&missing, 1, "missing/out");
	struct outcome file = RUN("check", SURFACELESS, "--test", "clip.near", "--output", "file");
	assert_failure(&file, 1, "file");
	outcome_finish(&missing);
	outcome_finish(&file);
}

static bool is_page(const char *path)
{
	char *text = read_text(path);
	bool whole = strstr(text, "The run ended before all cases had.") != NULL &&
		     strstr(text, "</html>\n") != NULL;
	free(text);
	return whole;
}

/* The report has 16 KB at the start and 21 KB at the end. The first file that does not fit ends the
 * run; it stays as it was, and those before it are as the run left them. */
static void test_a_full_disk(void **state)
{
	const struct run run = {
		.arguments = {"check", SURFACELESS, "--test", "clip.*", "--output", "out"},
		.file_limit = 18500,
	};
	(void)state;
	struct outcome outcome = run_program(&run);
	assert_failure(&outcome, 1, "cannot write out/report.html");
	char *results = read_text("out/results.csv");
	assert_int_equal(count_lines(results), 14);
	free(results);
	assert_true(is_page("out/report.html"));
	assert_int_equal(chdir("out"), 0);
	assert_int_equal(count_entries(".smoothie-"), 0);
	assert_int_equal(chdir(".."), 0);
	outcome_finish(&outcome);
}

static bool tells_of(const char *path, const char *name)
{
	char *text = read_text(path);
	bool told = strstr(text, name) != NULL;
	free(text);
	return told;
}

/* Killed as soon as it has begun, a run leaves nothing of the one before it. */
static void test_files_are_of_this_run(void **state)
{
	static const struct timespec pause = {.tv_nsec = 10000000};
	const struct run run = {
		.arguments = {"check", SURFACELESS, "--test", "repeat.*", "--output", "out"}};
	(void)state;
	struct outcome before = RUN("check", SURFACELESS, "--test", "clip.near", "--output", "out");
	assert_true(tells_of("out/junit.xml", "clip.near"));
	pid_t pid = start_program(&run);
	for (int i = 0; i < 500 && tells_of("out/report.html", "clip.near"); i++)
		nanosleep(&pause, NULL);
	kill(pid, SIGKILL);
	assert_int_equal(await_program(pid), 128 + SIGKILL);
	assert_false(tells_of("out/junit.xml", "clip.near"));
	assert_true(is_page("out/report.html"));
	outcome_finish(&before);
}

static void test_an_interrupted_run_leaves_what_it_has(void **state)
{
	static const struct timespec pause = {.tv_nsec = 10000000}, while_it_runs = {.tv_sec = 1};
	const struct run run = {
		.arguments = {"check", SURFACELESS, "--test", "clip.*", "--test",
			"context.create-destroy", "--output", "out", "--jobs", "1"}};
	(void)state;
	pid_t pid = start_program(&run);
	/* A busy machine may take seconds until it has begun. */
	for (int i = 0; i < 2000 && !exists("out/report.html"); i++)
		nanosleep(&pause, NULL);
	nanosleep(&while_it_runs, NULL);
	kill(pid, SIGINT);
	assert_int_equal(await_program(pid), 128 + SIGINT);
	assert_true(exists("out/results.csv"));
	assert_true(exists("out/report.html"));
}

/* With the folder that a run has made. */
static int leave_check_scratch(void **state)
{
	static const char *const files[] = {
		"out/results.csv", "out/failures.csv", "out/junit.xml", "out/report.html", "out"};
	for (size_t i = 0; i < sizeof(files) / sizeof(files[0]); i++)
		remove(files[i]);
	return leave_scratch(state);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_check_scratch)

int main(void)
{
	const struct CMUnitTest tests[] = {
		IN_SCRATCH(test_bad_command_lines),
		cmocka_unit_test(test_lists_are_shared_out),
		IN_SCRATCH(test_a_run_leaves_reports),
		IN_SCRATCH(test_baselines),
		IN_SCRATCH(test_tap),
		IN_SCRATCH(test_timeouts_are_told),
		IN_SCRATCH(test_folders_that_cannot_be_written),
		IN_SCRATCH(test_a_full_disk),
		IN_SCRATCH(test_files_are_of_this_run),
		IN_SCRATCH(test_an_interrupted_run_leaves_what_it_has),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
