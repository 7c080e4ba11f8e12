/* SPDX-License-Identifier: MIT */
#ifndef TESTS_BENCH_PAPER_RESULTS_H
#define TESTS_BENCH_PAPER_RESULTS_H

#include "bench/paper_result.h"

/** Nothing was measured. */
struct paper_result paper_nothing(void);

/** Numbers with which every claim holds that can be judged. */
struct paper_result paper_ideal(void);

#endif
