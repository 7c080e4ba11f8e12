/* SPDX-License-Identifier: MIT */
#ifndef SUPPORT_VISIBILITY_H
#define SUPPORT_VISIBILITY_H

#include "rig.h"

/** A picture of a light's visibility, steps of 1/65535, rows from the top. */
struct visibility {
	uint32_t width, height;
	uint16_t *values; /* owned */
};

/** Draws what of light 0 reaches each pixel. Fails the test on an error, or on a pixel that is no
 *  visibility. */
void visibility_draw(struct visibility *visibility, struct rig *rig, const struct sm_scene *scene,
	const struct sm_camera *camera, uint32_t width, uint32_t height);
void visibility_finish(struct visibility *visibility);

/** In [0, 1]; x from the left, y from the top. */
double visibility_at(const struct visibility *visibility, uint32_t x, uint32_t y);

/** How far two pictures of one size are apart. */
struct visibility_change {
	double mean;        /* of the absolute differences */
	double off;         /* share of the pixels that differ by more than .02 */
	uint32_t differing; /* pixels that differ at all */
};

struct visibility_change visibility_compare(const struct visibility *a, const struct visibility *b);

#endif
