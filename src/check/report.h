/* SPDX-License-Identifier: MIT */
#ifndef CHECK_REPORT_H
#define CHECK_REPORT_H

#include "check/result.h"
#include "page/file.h"

/* What a run leaves in its folder:
 *
 * results.csv   NAME,STATUS,SECONDS of each case, in deqp-runner's form
 * failures.csv  NAME,STATUS of what does not pass, expected or not: a baseline to be
 * junit.xml     for CI servers, with pictures attached
 * report.html   for people, with pictures in it
 * pictures/     NAME-result.png, -reference.png and -difference.png
 */

struct check_report {
	const char *folder;          /* that is there; not owned */
	const struct check_run *run; /* not owned */
	file_writer write;
};

/** Writes results.csv alone: what a run keeps while it goes on. Fails as `write` does, (INPUT)
 *  where the folder's path is too long, (MACHINE) when out of memory. */
bool check_report_results(const struct check_report *report, struct sm_error *error);

/** Writes results.csv, failures.csv, junit.xml and report.html, in that order. Fails as
 *  check_report_results() does; what was written before stays. */
bool check_report_write(const struct check_report *report, struct sm_error *error);

/** Writes the path of what is called so below a folder: PATH_MAX bytes. Fails (INPUT) where it is
 *  too long. */
bool check_report_path(const char *folder, const char *name, char *path, struct sm_error *error);

/** What a case drew and what it must have drawn: [height][width] shares of a light in steps of
 *  1/65535, rows from the top. */
struct check_pair {
	const uint16_t *result, *reference; /* not owned */
	uint32_t width, height;
};

/**
 * Writes the pictures of a pair below the folder, which is there, and tells the result, by whose
 * name they are called, where they are: greys of 16 bits as sm_view.visibility_of draws them, and a
 * map of the differences, in which check_difference_full() of the largest has the full colour. The
 * result's difference.max must be that largest. Fails as check_report_results() does; the result
 * then has no pictures.
 */
bool check_pictures_write(const char *folder, const struct check_pair *pair, file_writer write,
	struct check_result *result, struct sm_error *error);

/** The next of 1, 2 and 5 times a power of ten from `max` on, within 1e-4 and 1: the end of a scale
 *  that shows differences up to max. */
double check_difference_full(double max);

/* TAP version 13, which is printed while cases end. A flake and an expected failure are no failures
 * there, an unexpected pass is one. */

/** The version, and how many cases there will be. */
void check_tap_begin(FILE *file, size_t count);
/** The line of a case, counted from 1, with a YAML block where it did not just pass. */
void check_tap_result(FILE *file, size_t number, const struct check_result *result);
/** Says that the run ends early, and why. */
void check_tap_bail_out(FILE *file, const char *reason);

/** The parts of a report, each printed to a file; data is the check_report. */
void check_print_results(FILE *file, const void *data);
void check_print_failures(FILE *file, const void *data);
void check_print_junit(FILE *file, const void *data);
void check_print_page(FILE *file, const void *data);

#endif
