/* SPDX-License-Identifier: MIT */
#ifndef TECHNIQUE_DISC_H
#define TECHNIQUE_DISC_H

#include "gles/gpu.h"
#include "scene/light.h"

/** As many as the shaders have room for. */
#define DISC_POINTS_MAX 64

/** Points spread evenly over the unit disc: the light, seen from a receiver. */
struct disc {
	float points[DISC_POINTS_MAX][2];
	GLsizei count;
};

/** count: 1 to DISC_POINTS_MAX */
void disc_init(struct disc *disc, uint32_t count);

/** The frame of a point of the light, on the unit disc. Its screen's rectangle on the far plane is
 *  that of the light's middle, and its near and far planes are: a shear of clip space. */
struct light_frame disc_frame(const struct light_frame *frame, const float point[2]);

/** Sets disc_points, disc_count and disc_scale of a program that is in use. */
void disc_bind(const struct disc *disc, struct gpu *gpu, const struct light_frame *frame,
	const struct program *program);

#endif
