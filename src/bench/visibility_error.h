/* SPDX-License-Identifier: MIT */
#ifndef BENCH_VISIBILITY_ERROR_H
#define BENCH_VISIBILITY_ERROR_H

#include "bench/result.h"

/** Sums up how far what is seen is off the truth, apart for each region, over pixels whose truth is
 *  not NaN. Fails (MACHINE) for lack of memory. */
bool visibility_error(const float *seen, const float *truth, size_t count,
	struct error_summary error[REGIONS], struct sm_error *failure);

/** How many pixels whose truth is 0 or 1 are off it by more than ERROR_WRONG; NAN where no truth is
 *  known. */
double visibility_outside_wrong(const float *seen, const float *truth, size_t count);

/** Two pictures of one frame. */
struct visibility_pair {
	const float *seen, *truth; /* [count], not owned */
};

/** Mean |change of what is seen - change of the truth| from one frame to the next, over pixels that
 *  both have truth of; NAN without any. */
double visibility_flicker(
	struct visibility_pair before, struct visibility_pair after, size_t count);

#endif
