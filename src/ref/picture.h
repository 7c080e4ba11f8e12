/* SPDX-License-Identifier: MIT */
#ifndef REF_PICTURE_H
#define REF_PICTURE_H

#include "ref/disc.h"
#include "ref/lamp.h"
#include "ref/pinhole.h"
#include "ref/reference.h"

/** How much of the light a pixel was found to see by the coarse samples. */
enum seen { SEEN_UNJUDGED, SEEN_DARK, SEEN_PART, SEEN_LIT };

/** A reference in the making. */
struct ref_picture {
	const struct reference_request *request; /* not owned */
	struct tracer tracer;
	struct pinhole pinhole;
	struct lamp lamp;
	struct disc coarse, fine;
	double lift; /* of points above their surface, in the tracer's space: 0, but to be compared
			with tracers that need one */
	uint8_t *seen;     /* enum seen of each pixel */
	float *visibility; /* of each pixel, as in a struct reference; owned */
};

/** Fails as reference_trace(), which has checked size, light and samples. */
bool ref_picture_init(struct ref_picture *picture, const struct reference_request *request,
	struct sm_error *error);
/** Fills visibility. */
void ref_picture_trace(struct ref_picture *picture);
void ref_picture_finish(struct ref_picture *picture);

#endif
