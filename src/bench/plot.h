/* SPDX-License-Identifier: MIT */
#ifndef BENCH_PLOT_H
#define BENCH_PLOT_H

#include "bench/contents.h"
#include <stdio.h>

/** A technique in a chart of error against time. */
struct plot_point {
	const char *label;  /* not owned */
	double time, error; /* above 0 */
	size_t style;       /* colour and marker: the number of the technique's family */
};

struct plot {
	char title[160], subtitle[160];
	const char *time_label;    /* not owned */
	struct plot_point *points; /* owned */
	size_t count;
};

/** A chart of one scene, or with NULL of the means over all: geometric ones of times,
 *  arithmetic ones of errors, of techniques that were drawn in as many scenes as any. Times are
 *  ratios to "hard" where all have one, or milliseconds. What has no time or no error is left out.
 *  Fails (MACHINE) when out of memory. */
bool plot_init(struct plot *plot, const struct contents *contents, const struct result *setting,
	const struct result *scene, struct sm_error *error);
void plot_finish(struct plot *plot);

enum plot_format { PLOT_SVG, PLOT_PNG, PLOT_FORMATS };

/** Writes a script for gnuplot 5 that sends the chart, 900 x 600, to standard output. Fails
 *  (MACHINE) when out of memory; the caller checks the file for errors. */
bool plot_write_script(
	const struct plot *plot, enum plot_format format, FILE *file, struct sm_error *error);

#endif
