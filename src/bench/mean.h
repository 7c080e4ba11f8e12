/* SPDX-License-Identifier: MIT */
#ifndef BENCH_MEAN_H
#define BENCH_MEAN_H

#include "bench/distinct.h"

/** A technique over scenes. Means are arithmetic, but those of times geometric. NAN: not measured
 *  in one of them. */
struct mean {
	size_t scenes;
	double rmse, bias, p99; /* of penumbra pixels */
	double flicker;
	double ratio, ms;
};

/** Of a technique in a setting, in one scene or with NULL in all that have penumbra pixels. */
struct mean mean_of(const struct result_list *list, const struct result *setting,
	const struct result *technique, const struct result *scene);

/** Whether time and error are both above 0, as logarithmic axes want them. */
bool mean_is_complete(const struct mean *mean);

#endif
