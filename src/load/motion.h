/* SPDX-License-Identifier: MIT */
#ifndef LOAD_MOTION_H
#define LOAD_MOTION_H

#include <smoothie.h>

/*
 * Turning about the vertical axis through a target. Each pose is computed from the one at rest, so
 * that no rounding adds up and equal times give equal bits.
 */

/** Seconds at which frame `frame`, from 1, is shown, at numerator / denominator frames a second;
 *  neither may be 0. */
double motion_time(uint64_t frame, uint32_t numerator, uint32_t denominator);

/** The part of a turn at a time, which is finite: in (-1, 1), positive counter-clockwise as seen
 *  from above. period: seconds a turn; negative turns clockwise, 0 stands still. */
double motion_phase(double seconds, double period);

/** Turns the eye and the up direction about the target; phase 0 gives the bits of `rest`. */
void motion_turn_camera(double phase, const struct sm_camera *rest, struct sm_camera *camera);
/** The same for a light's position. */
void motion_turn_light(double phase, const struct sm_light_desc *rest, struct sm_light_desc *light);

#endif
