/* SPDX-License-Identifier: MIT */
#ifndef TEST_REF_EDGE_H
#define TEST_REF_EDGE_H

#include "ref/reference.h"

/** A plate that ends in a straight edge above the ground, and what its penumbra is. */
struct edge {
	struct sm_scene *scene;
	struct sm_light_desc light;
	struct reference_request request; /* 96 x 64 pixels */
	uint32_t plate;                   /* object */
	double scale, shift;              /* from the plate's own units */
};

enum { EDGE_WIDTH = 96, EDGE_HEIGHT = 64 };

/** Everything scaled, then moved along x. radius: of the light, before it is scaled. */
void edge_init(
	struct edge *edge, enum sm_light_type type, float radius, double scale, double shift);
void edge_finish(struct edge *edge);

/** Fails the test on an error. */
void edge_trace(struct reference *reference, const struct edge *edge);

/** What is seen of the light from the ground that a pixel shows, in closed form. */
double edge_visibility(const struct edge *edge, uint32_t x, uint32_t y);

/** Root mean square of the difference over pixels where closed form is within (0, 1); `count`
 *  of them. */
double edge_error(const struct edge *edge, const struct reference *reference, uint32_t *count);

#endif
