/* SPDX-License-Identifier: MIT */
#ifndef BENCH_MARKDOWN_H
#define BENCH_MARKDOWN_H

#include "bench/contents.h"
#include <stdio.h>

/** Writes results.md: what a commit keeps of a run, with charts that are beside it in plots/. The
 *  caller checks the file for errors. */
void markdown_write(const struct contents *contents, FILE *file);

#endif
