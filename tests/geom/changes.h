/* SPDX-License-Identifier: MIT */
#ifndef TESTS_GEOM_CHANGES_H
#define TESTS_GEOM_CHANGES_H

#include "models.h"

/** A torus of radii 1 and .4, closed and seen counter-clockwise from outside. */
struct model model_torus(void);

/* Those below take a model and give it back changed; they abort when out of memory. */

/** Each triangle wound the other way. */
struct model model_inverted(struct model model);
/** Without its first triangle. */
struct model model_opened(struct model model);
struct model model_scaled(struct model model, float scale);
/** By that much along (1, -.7, .3). */
struct model model_moved(struct model model, float by);
/** Both as one model. */
struct model model_joined(struct model a, struct model b);

#endif
