/* SPDX-License-Identifier: MIT */
#ifndef CHECK_RESULT_H
#define CHECK_RESULT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** What became of a case. The last two are against a baseline alone. */
enum check_status {
	CHECK_PASS,
	CHECK_FAIL,          /**< it drew something else than it must */
	CHECK_SKIP,          /**< the driver lacks what it takes, or a baseline leaves it out */
	CHECK_CRASH,         /**< its process ended early */
	CHECK_TIMEOUT,       /**< its process was ended */
	CHECK_FLAKE,         /**< it failed, and passed the second time or may fail by a baseline */
	CHECK_EXPECTED_FAIL, /**< it did not pass, in the way that a baseline says */
	CHECK_UNEXPECTED_PASS, /**< it passed, and a baseline says that it does not */
	CHECK_STATUS_COUNT,
};

/** How a result differs from its reference; all zero for a case without pictures. */
struct check_difference {
	uint64_t pixels;  /**< that were compared; 0: none were */
	uint64_t failing; /**< that differ by more than the tolerance */
	uint64_t budget;  /**< as many may fail */
	double tolerance; /**< of a pixel, in the unit of `mean` */
	double mean;      /**< |difference|, a share of the light if the message says no more */
	double max;
};

/** Paths relative to the run's output folder, "" where there is no such picture. */
struct check_pictures {
	char result[256], reference[256], difference[256];
};

#define CHECK_NAME_SIZE 160
#define CHECK_MESSAGE_SIZE 400

/** Of one case; plain data, so that processes may share it. */
struct check_result {
	char name[CHECK_NAME_SIZE];       /**< dotted: letters, digits and "._=-" alone */
	enum check_status status;         /**< after the second attempt and the baselines */
	enum check_status first_status;   /**< of the first attempt alone */
	uint32_t attempts;                /**< 0: left out; 2: it did not pass at first */
	double seconds;                   /**< of all attempts */
	char message[CHECK_MESSAGE_SIZE]; /**< one line, UTF-8: why it did not pass, what it
					       measured; may be "" */
	struct check_difference difference;
	struct check_pictures pictures;
};

/** A line about driver, program or run, as "smoothie info" and what the run was asked for. */
struct check_fact {
	char *key, *value; /**< owned by the run */
};

struct check_run {
	struct check_result *results; /**< [count], in the order of the list of cases; those that
					   have ended alone */
	size_t count;
	struct check_fact *facts; /**< [fact_count] */
	size_t fact_count;
	uint32_t fraction, fraction_start; /**< every fraction-th case from the fraction_start-th,
						counted from 1; 1 and 1: all */
	uint32_t jobs;
	int64_t started; /**< seconds since 1970, UTC */
	double seconds;  /**< that the run took */
	bool complete;   /**< false: it was ended before all cases had */
};

/** "Pass", "Fail", "Skip", "Crash", "Timeout", "Flake", "ExpectedFail", "UnexpectedPass". */
const char *check_status_name(enum check_status status);
/** Whether deqp-runner's words name a status so: exactly as above. */
bool check_status_find(const char *name, enum check_status *status);

/** Whether the run fails for it: Fail, Crash, Timeout or UnexpectedPass. */
bool check_status_is_unexpected(enum check_status status);

/** Frees facts and results, and makes it zero. */
void check_run_finish(struct check_run *run);
/** Adds a copy; false without memory. */
bool check_run_add_fact(struct check_run *run, const char *key, const char *value);
/** The first value with this key, or "" without one; it is the run's. */
const char *check_run_fact(const struct check_run *run, const char *key);

/** Results of a status, and those that the run fails for. */
size_t check_run_count(const struct check_run *run, enum check_status status);
size_t check_run_count_unexpected(const struct check_run *run);

#endif
