/* SPDX-License-Identifier: MIT */
#ifndef TESTS_APP_PROGRAM_H
#define TESTS_APP_PROGRAM_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/** Runs the program that was built, and looks at what it leaves. */

#define MAX_ARGUMENTS 16

/** How to run it; zero in a field: nothing special. */
struct run {
	const char *arguments[MAX_ARGUMENTS]; /**< without the program's name, up to NULL */
	const char *environment;              /**< one NAME=VALUE to set */
	size_t file_limit;                    /**< bytes that a file may reach */
};

struct outcome {
	int status; /**< exit status, 128 + the number of the signal that ended it, or -1: over time
		     */
	char *out;  /**< owned, 0-terminated, out_size bytes without the 0 */
	size_t out_size;
	char *error; /**< owned, 0-terminated */
};

/** Runs it to its end, a minute at most; finish with outcome_finish(). */
struct outcome run_program(const struct run *run);
/** run_program() with these arguments. */
#define RUN(...) run_program(&(struct run){.arguments = {__VA_ARGS__}})
void outcome_finish(struct outcome *outcome);

/** Starts it with stdout and stderr closed to the world, and returns at once. */
pid_t start_program(const struct run *run);
/** Waits a minute at most, then kills; as outcome.status. */
int await_program(pid_t pid);

/** Asserts a failure as users see it: this status, and one line on stderr that holds `text`. */
void assert_failure(const struct outcome *outcome, int status, const char *text);

/** Asserts success without a word on stderr, and that stdout holds each of the texts. */
void assert_output(const struct outcome *outcome, const char *const *texts, size_t count);
/** assert_output() with an array. */
#define ASSERT_LINES(outcome, lines) \
	assert_output(outcome, lines, sizeof(lines) / sizeof((lines)[0]))

/** cmocka set-up and tear-down: a fresh folder, which is the working folder meanwhile. */
int enter_scratch(void **state);
int leave_scratch(void **state);

/** Entries of the working folder whose names start with prefix. */
size_t count_entries(const char *prefix);

void write_text(const char *path, const char *text);

/** Whether two files, which are there, hold the same bytes. */
bool program_same_files(const char *a, const char *b);

#endif
