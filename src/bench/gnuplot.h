/* SPDX-License-Identifier: MIT */
#ifndef BENCH_GNUPLOT_H
#define BENCH_GNUPLOT_H

#include "base/error.h"
#include <stdio.h>

/** Runs gnuplot, found in PATH, on a script from its start; what it prints is in *output, a
 *  temporary file, at its start. fclose() it. Fails (MACHINE) when there is no gnuplot or it fails;
 *  *output is then NULL. */
bool gnuplot_run(FILE *script, FILE **output, struct sm_error *error);

#endif
