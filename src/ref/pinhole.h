/* SPDX-License-Identifier: MIT */
#ifndef REF_PINHOLE_H
#define REF_PINHOLE_H

#include "ref/tracer.h"

/** A camera in the tracer's space. */
struct pinhole {
	double eye[3];
	double axis[3], right[3], up[3]; /* unit */
	double half_width, half_height;  /* of the picture at distance 1 */
	uint32_t width, height;          /* pixels */
	double near, far;                /* along the axis */
};

/** Fails (INPUT) where the camera looks nowhere. */
bool pinhole_init(struct pinhole *pinhole, const struct sm_camera *camera, uint32_t width,
	uint32_t height, const struct tracer *tracer, struct sm_error *error);

/** Through the centre of a pixel; x from the left, y from the top. */
void pinhole_sight(const struct pinhole *pinhole, uint32_t x, uint32_t y, struct sight *sight);

#endif
