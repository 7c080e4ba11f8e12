/* SPDX-License-Identifier: MIT */
#ifndef BENCH_LABEL_H
#define BENCH_LABEL_H

#include <stddef.h>

/** Pixels. */
struct box {
	double center[2], half[2]; /* half its size */
};

/** The name of a point in a chart. */
struct label {
	double point[2];
	struct box text; /* its center is found by labels_place() */
};

/** Puts each text near its point within an area, clear of other texts and of obstacles as far as
 *  possible. The points themselves are to be among the obstacles. */
void labels_place(struct label *labels, size_t count, const struct box *obstacles,
	size_t obstacle_count, const struct box *area);

#endif
