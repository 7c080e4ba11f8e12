/* SPDX-License-Identifier: MIT */
#ifndef APP_CHECK_OUTPUT_H
#define APP_CHECK_OUTPUT_H

#include "app/check_options.h"
#include "app/progress.h"
#include "check/result.h"

/** What a run tells while it goes on, and leaves. */
struct check_output {
	const struct check_options *options; /**< not owned */
	const struct check_run *run;         /**< not owned */
	struct progress progress;
	size_t told;    /**< results printed */
	double written; /**< ms of the monotonic clock: when files were */
};

/** Makes the folder, if there is to be one, and writes what it can of the run that begins; says
 *  what is run. count: of cases. Fails (MACHINE). */
bool check_output_begin(struct check_output *output, const struct check_options *options,
	const struct check_run *run, size_t count, struct sm_error *error);

/** Tells a result, and keeps files up to date. Fails as output_write(). */
bool check_output_result(
	struct check_output *output, const struct check_result *result, struct sm_error *error);

/** Writes all files and prints a summary. Fails as output_write(). */
bool check_output_end(struct check_output *output, struct sm_error *error);

/** Fails (MACHINE) where something in the run was unexpected, or it was ended early. */
bool check_output_verdict(const struct check_run *run, struct sm_error *error);

#endif
