/* SPDX-License-Identifier: MIT */
#ifndef CHECK_BASELINE_H
#define CHECK_BASELINE_H

#include "base/error.h"
#include "check/case.h"
#include "check/result.h"
#include <regex.h>

/** A case that is known not to pass. */
struct check_known {
	char *name;  /* owned */
	char *place; /* owned: the file and line it is from */
	enum check_status status;
};

/** A pattern of names. */
struct check_pattern {
	regex_t regex;
	char *place; /* owned: the file and line it is from */
};

/** Patterns of one kind. */
struct check_patterns {
	struct check_pattern *items; /* owned */
	size_t count, capacity;
};

/** What is known of a driver. Zero: nothing. */
struct check_baseline {
	struct check_known *known; /* owned */
	size_t known_count, known_capacity;
	struct check_patterns skips, flakes;
};

/**
 * Adds what a file says, in the forms of deqp-runner. Blank lines and those that start with "#" are
 * left out. By the end of its name without extension, the file holds
 * - "skips": patterns of cases to leave out, a line each, POSIX extended regular expressions that
 *   match anywhere in a name;
 * - "flakes": likewise, of cases that may fail;
 * - anything else: lines NAME,Status of cases that do not pass. Pass and Skip say nothing;
 *   ExpectedFail is a Fail, as in results of a run with a baseline.
 * Fails (INPUT) with file and line where it is not that, or cannot be read.
 */
bool check_baseline_read(struct check_baseline *baseline, const char *path, struct sm_error *error);
void check_baseline_finish(struct check_baseline *baseline);

/** Whether the list, which is of all cases, has each that is known not to pass: a line that is of
 *  none is a mistake, or is left from a case that is no more. Fails (INPUT) with file and line. */
bool check_baseline_match(const struct check_baseline *baseline, const struct check_list *list,
	struct sm_error *error);

/** The place of the pattern that leaves a case out, or NULL. */
const char *check_baseline_skips(const struct check_baseline *baseline, const char *name);

/** What an outcome is against the baseline: as expected, unexpectedly a pass, a known flake, or
 *  what it was. */
enum check_status check_baseline_judge(
	const struct check_baseline *baseline, const char *name, enum check_status status);

/** What two attempts make: the first alone where it is not unexpected; a flake where the second is
 *  not; else the first. Both are judged already. */
enum check_status check_attempts_judge(enum check_status first, enum check_status second);

#endif
