/* SPDX-License-Identifier: MIT */
#ifndef BENCH_PAPER_REPORT_H
#define BENCH_PAPER_REPORT_H

#include "bench/paper_result.h"
#include <stdio.h>

/* The caller checks the files for errors. */

/** Writes paper.csv, one number a line: table, name, technique, map (texels a side), t, quantity,
 *  value, unit. What was not measured has no line. */
void paper_csv_write(const struct paper_result *result, FILE *file);

/** Writes paper.md: each table, and each claim with its verdict. It shows the plots, as files
 *  paper_plot_name() in its folder. */
void paper_markdown_write(const struct paper_result *result, FILE *file);

enum paper_plot { PAPER_PLOT_MESHES, PAPER_PLOT_SIZES, PAPER_PLOTS };

/** Without extension. */
const char *paper_plot_name(enum paper_plot plot);

/** Writes a script with which gnuplot 5 sends the plot to standard output, as SVG or PNG. */
void paper_plot_write(
	const struct paper_result *result, enum paper_plot plot, bool svg, FILE *file);

#endif
