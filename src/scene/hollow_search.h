/* SPDX-License-Identifier: MIT */
#ifndef SCENE_HOLLOW_SEARCH_H
#define SCENE_HOLLOW_SEARCH_H

#include "scene/edge_chains.h"

/** Places of the disc that are looked at; what hides none of them is left out. */
#define HOLLOW_SAMPLES 16

/**
 * Goes through the hollows of a caster in which both triangles face the light's centre, and the
 * one shows a part of the disc its back and hides it from the other, near the edge that they have
 * in common.
 */
struct hollow_search {
	const struct caster_view *view; /* not owned */
	size_t next;                    /* of the caster's hollows */
	mat4 to_object;                 /* from light space */
	vec4 light;                     /* the view's, as rounded planes have it */
	float off_max;                  /* of these planes, if they cut the disc */
	float samples[2][HOLLOW_SAMPLES];
	size_t block;          /* that planes are known of */
	float off[EDGE_BLOCK]; /* the light from each, in steps of rounded planes,
				  either side */
	uint32_t triangle;     /* that was looked at last; UINT32_MAX: none */
	bool grazing;          /* whether its plane cuts the disc */
	vec3 corners[3];       /* if it does, light space */
	vec3 normal;           /* of the corners, as long as their area is large twice */
	float light_off;       /* the light's centre from the plane, times that length, and */
	float beyond;          /* how much of the disc is beyond it */
};

void hollow_search_begin(struct hollow_search *search, const struct caster_view *view);

/** The next one; NULL: there is none. */
const struct hollow *hollow_search_next(struct hollow_search *search);

#endif
