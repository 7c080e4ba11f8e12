/* SPDX-License-Identifier: MIT */
#ifndef APP_BENCH_STRESS_H
#define APP_BENCH_STRESS_H

#include "app/bench_options.h"

/** Runs the numerical stress that the options ask for, in a child process, with its lines on
 *  standard output. Scenes that break a rule are written to the folder of the options. Fails
 *  (INPUT) on options that do not fit, (MACHINE) when a rule is broken. */
bool bench_stress(const struct bench_options *options, struct sm_error *error);

#endif
