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
	const struct screen_grid *wanted;  /* cells of the picture; NULL: all */
	uint32_t lead;                     /* of the frame's lights, the one that is drawn first */
	bool first;
	uint64_t flags; /* for all surfaces: VISIBILITY, ENCODE_SRGB, POINTS, RECEIVERS */
	const struct program *program; /* in use; of the pass itself */
};

/** Puts the program of these flags in use, for an object of the pass. */
bool surface_pass_begin_object(struct surface_pass *pass, const struct object *object,
	uint64_t flags, struct sm_error *error);

/** Marks the cells of the picture in which surfaces need the technique: beside them they ask for
 *  nothing that has been found before. */
bool surface_pass_mark(
	struct surface_pass *pass, struct screen_grid *cells, struct sm_error *error);

/** Draws every object, in the renderer's order, into the framebuffer that is bound: at least where
 *  the pass is wanted. */
bool surface_pass_draw(struct surface_pass *pass, struct sm_error *error);

#endif
