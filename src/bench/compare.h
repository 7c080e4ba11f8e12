/* SPDX-License-Identifier: MIT */
#ifndef BENCH_COMPARE_H
#define BENCH_COMPARE_H

#include "bench/result.h"
#include <stdio.h>

struct comparison {
	size_t better, worse, alike; /* results in both lists */
	size_t gone, added;          /* results in the old or new one only */
};

/**
 * Prints what changed from one run to another, a line each, and sums it up. Results belong together
 * by scene, technique, precision, radius and map; one that is worse in anything is worse.
 *
 * Errors are the same each time on one driver, so a change counts above 1e-4 and 1 %. Lists do not
 * tell how many samples the reference took: errors are compared all the same. Times are compared as
 * ratios to "hard", on the same machine and at the same size only: a change counts above 5 % and
 * above half of what lies between p10 and p90 of the technique's own times in either run, whatever
 * those of "hard" do. Memory counts above 1 %, its peak above 5 %.
 */
struct comparison compare_print(
	const struct result_list *old_results, const struct result_list *new_results, FILE *file);

#endif
