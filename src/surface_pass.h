/* SPDX-License-Identifier: MIT */
#ifndef SURFACE_PASS_H
#define SURFACE_PASS_H

#include "renderer.h"

/** One pass over the surfaces: the ambient light and the first light, or a further light. */
struct surface_pass {
	struct sm_renderer *renderer;
	const struct sm_scene *scene;
	vec4 *world_to_clip;
	uint32_t width, height;            /* of the picture */
	bool multisampled;                 /* the framebuffer */
	bool alone;                        /* as in struct sm_view */
	const struct sm_light_desc *light; /* NULL: ambient light alone */
	const struct light_frame *frame;   /* of the light */
	struct light_shadow *shadow;       /* of the light, in the shadow set */
	struct picture *cells;             /* of the sparse picture; NULL: there is none */
	struct picture *found;             /* visibility of each pixel; NULL: it is not known */
	uint32_t lead;                     /* of the frame's lights, the one that is drawn first */
	bool first;
	uint64_t flags; /* for all surfaces: VISIBILITY, ENCODE_SRGB, POINTS, RECEIVERS */
	const struct program *program; /* in use; of the pass itself */
};

/** Finds out by drawing, which is to be done before state is set for surfaces, what these ask the
 *  driver for. */
void surface_pass_find_ways(const struct surface_pass *pass);

/** Draws every object, in the renderer's order, into the framebuffer that is bound. */
bool surface_pass_draw(struct surface_pass *pass, struct sm_error *error);

#endif
