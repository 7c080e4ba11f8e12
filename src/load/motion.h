/* SPDX-License-Identifier: MIT */
#ifndef LOAD_MOTION_H
#define LOAD_MOTION_H

#include <smoothie.h>

/*
 * Each pose is computed from the one at rest, so that no rounding adds up and equal times give
 * equal bits; time 0 gives those of the rest.
 */

/** How something moves: there and back in a line, and with that about a vertical axis. */
struct motion_path {
	double orbit;      /**< seconds a turn, counter-clockwise as seen from above; negative:
				clockwise; 0: it does not turn */
	float travel[3];   /**< as far as it goes */
	float travel_time; /**< seconds for the way there and back, > 0; slowest at its ends */
};

bool motion_moves(const struct motion_path *path);

/** Where a point is at a time, which is finite, that turns about the axis through center. */
void motion_point(const struct motion_path *path, double seconds, const float center[3],
	const float rest[3], float point[3]);

/** Moves the eye, and turns the up direction along, while it looks at its target. */
void motion_camera(const struct motion_path *path, double seconds, const struct sm_camera *rest,
	struct sm_camera *camera);
/** Moves the position of a light that stays aimed at its target. */
void motion_light(const struct motion_path *path, double seconds, const struct sm_light_desc *rest,
	struct sm_light_desc *light);

/** Seconds at which frame `frame`, from 1, is shown, at numerator / denominator frames a second;
 *  neither may be 0. */
double motion_time(uint64_t frame, uint32_t numerator, uint32_t denominator);

/** The part of a turn at a time, which is finite: in (-1, 1), positive counter-clockwise as seen
 *  from above. period: seconds a turn; negative turns clockwise, 0 stands still. */
double motion_phase(double seconds, double period);

#endif
