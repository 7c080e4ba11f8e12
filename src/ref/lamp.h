/* SPDX-License-Identifier: MIT */
#ifndef REF_LAMP_H
#define REF_LAMP_H

#include "ref/tracer.h"

/** A light in the tracer's space. */
struct lamp {
	bool parallel;
	double origin[3]; /* position; for a directional light the unit vector towards it */
	double radius; /* of the disc; for a directional light the tangent of the angle it shows */
	double axis[3], right[3], up[3]; /* of a spot's screen */
	double half_extent;              /* of a spot's screen at distance 1 */
};

void lamp_init(struct lamp *lamp, const struct sm_light_desc *light, const struct tracer *tracer);

/** The fan of rays from a surface to the light; false where its visibility is not judged: part of
 *  the disc is below the surface or nearly so, or the surface is beside a spot's screen. */
bool lamp_fan(const struct lamp *lamp, const struct surface *surface, struct fan *fan);

#endif
