/* SPDX-License-Identifier: MIT */
#ifndef BENCH_REPORT_H
#define BENCH_REPORT_H

#include "bench/result.h"
#include "bench/run_facts.h"
#include "page/file.h"

struct report {
	const char *folder; /* is made where it is missing; "differences" in it may hold pictures
			       named by difference_file_name() */
	const struct result_list *results;
	const struct run_facts *facts;
	file_writer write;
};

/**
 * Writes results.csv, results.json, report.html, results.md, and plots/NAME.svg and .png. The data
 * are written before what can be made of them later. Without gnuplot, a warning says so and pages
 * have no charts. results.md and plots/ can be copied elsewhere together.
 * Fails as `write` does, (INPUT) where a folder cannot be made, (MACHINE) when out of memory.
 */
bool report_write(const struct report *report, struct sm_error *error);

/** Writes results.csv and results.json alone, as report_write() does, into a folder that is there:
 *  what a run keeps while it goes on. */
bool report_write_data(const struct report *report, struct sm_error *error);

/** Makes a folder where it is missing; not those above it. Fails (INPUT). */
bool report_make_folder(const char *path, struct sm_error *error);

#endif
