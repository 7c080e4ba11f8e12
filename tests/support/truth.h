/* SPDX-License-Identifier: MIT */
#ifndef SUPPORT_TRUTH_H
#define SUPPORT_TRUTH_H

#include "visibility.h"

/** Ground truth: visible share of the light, or NAN where it is not judged. */
struct truth {
	uint32_t width, height;
	float *values; /* owned, rows from the top */
};

/** Reads a gzipped 16-bit PGM of the study scenes; false if it is not there or not one. */
bool truth_read(struct truth *truth, const char *path);
void truth_finish(struct truth *truth);

/** How far a picture is from the truth of the same size. */
struct difference {
	double penumbra_rmse; /* pixels where 0 < truth < 1 */
	uint32_t penumbra_pixels;
	uint32_t outside_wrong; /* judged, not penumbra, off by more than .1 */
};

struct difference truth_compare(const struct truth *truth, const struct visibility *visibility);

#endif
