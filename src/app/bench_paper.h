/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_PAPER_H
#define APP_BENCH_PAPER_H

#include <smoothie.h>

struct paper_options {
	const char *out;    /**< folder, made where it is missing */
	const char *models; /**< folder of models, some of which stand for the paper's; NULL: each
				 is generated */
	const char *device; /**< as platform_create() */
	struct sm_driver_options driver;
	bool debug;
	bool tiny; /**< for tests: a few seconds, and numbers that mean little */
	int argc;  /**< the command line, to be told */
	char *const *argv;
	/** Hears of what is done, on the calling thread; may be NULL. */
	void (*progress)(void *data, uint32_t done, uint32_t total);
	void *progress_data;
};

/**
 * Measures what Chan & Durand 2003 and Volokh report (bench/paper_result.h), and writes paper.csv,
 * paper.md and, where gnuplot is there, its plots as SVG and PNG into the folder; when a part
 * fails, of what was measured before, if that is one scene or more.
 *
 * Work is done in child processes: call it while there are no other threads and no GL. Fails as
 * what it measures does, (INPUT) where the folder cannot be written to.
 */
bool paper_run(const struct paper_options *options, struct sm_error *error);

#endif
