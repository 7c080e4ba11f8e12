/* SPDX-License-Identifier: MIT */
#ifndef APP_CHECK_OPTIONS_H
#define APP_CHECK_OPTIONS_H

#include "app/check_preset.h"
#include "app/driver_options.h"

/** What a command line, and presets that it names, say of a conformance run. Its texts are not
 * owned or a preset's; its arrays are owned. */
struct check_options {
	struct common_options common;
	struct driver_options driver;
	const char **globs, **baselines; /**< owned arrays */
	size_t glob_count, glob_capacity, baseline_count, baseline_capacity;
	struct check_preset preset;
	uint32_t jobs;
	uint32_t fraction, fraction_start; /**< 1 and 1: all */
	uint32_t width, height;            /**< of pictures; 0: as the driver's class has them */
	double timeout;                    /**< seconds */
	const char *output;                /**< folder; NULL: none */
	bool list, tap;
};

/** The run of the command (check.c). */
bool check_command_run(int argc, char **argv, struct sm_error *error);

/** Reads it. Fails (INPUT). */
bool check_options_init(
	struct check_options *options, int argc, char **argv, struct sm_error *error);
/** Fine on a half-made one. */
void check_options_finish(struct check_options *options);

#endif
