/* SPDX-License-Identifier: MIT */
#ifndef MODEL_LIKENESS_H
#define MODEL_LIKENESS_H

#include "load/stage.h"
#include "rig.h"

/** Pixels of the pictures, a side. */
#define LIKENESS_SIZE 256

/** How far a driver's picture of visibility and its model are apart. */
struct likeness {
	double mean;    /* of the absolute differences */
	double by_001;  /* share of the pixels that differ by more than .001 */
	double by_02;   /* by more than .02 */
	double by_1;    /* by more than .1 */
	double seconds; /* of the processor, that the model took */
};

/** Draws light 0 with the rig's renderer, and compares with the model that is nearer: with corners
 * on a grid of 4 bits, or as they are. */
struct likeness likeness_of(struct rig *rig, const struct sm_scene *scene,
	const struct sm_camera *camera, const struct sm_shadow_options *options);

/** Loads builtin:SCENE, with a light of R / d = .03 where the study has ground truth of it. Fails
 * the test on an error. */
void likeness_load(struct stage *stage, const char *scene);

#endif
