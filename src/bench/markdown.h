/* SPDX-License-Identifier: MIT */
#ifndef BENCH_MARKDOWN_H
#define BENCH_MARKDOWN_H

#include "bench/contents.h"
#include <stdio.h>

/** Writes results.md: what a commit keeps of a run, with charts that are beside it in plots/. The
 *  caller checks the file for errors. */
void markdown_write(const struct contents *contents, FILE *file);

/** Text in which nothing is markup. */
void markdown_text(const char *text, FILE *file);
/** The line below the heading of a table: the first column to the left, others to the right. */
void markdown_rule(size_t columns, FILE *file);

/** What was measured in float and in other precisions too, side by side (markdown_precision.c);
 *  nothing where there is no such thing. */
void markdown_precisions(const struct result_list *results, FILE *file);

#endif
