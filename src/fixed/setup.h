/* SPDX-License-Identifier: MIT */
#ifndef FIXED_SETUP_H
#define FIXED_SETUP_H

#include "fixed/cover.h"

/** Vertex work, once, in double: what it gives is the same wherever plain IEEE arithmetic is. Each
 *  function appends the primitives of one polygon, none where nothing of it is on the screen or a
 *  coordinate is not finite. False: out of memory. */

/** Which triangles are drawn, by how their corners are seen. */
enum fixed_side { FIXED_BOTH_SIDES, FIXED_COUNTER_CLOCKWISE, FIXED_CLOCKWISE };

/** clip: of the corners, in the light's clip space. screen: the map. */
bool fixed_add_blocker(struct fixed_blockers *blockers, const struct fixed_screen *screen,
	const double clip[3][4], enum fixed_side side);

struct fixed_fin_corner {
	float position[3]; /* NDC, within [-1024, 1024] */
	float offset[2];   /* from the silhouette, NDC */
	float width;       /* NDC */
};

/** corners: in order around, of either orientation. Offset and width are affine over the quad. */
bool fixed_add_fin(struct fixed_fins *fins, const struct fixed_screen *screen,
	const struct fixed_fin_corner corners[4]);

struct fixed_surface {
	double clip[3][4];  /* the camera's clip space */
	double light[3][4]; /* the light's */
	bool receives;      /* shadows, where it faces the light */
	enum fixed_side side;
};

/** How far a receiver's own plane may rise around the place that is looked up: over `reach` of the
 *  light's screen, [0, 1], by no more than limit[0] + limit[1] d times the screen at depth d. */
struct fixed_bias {
	double reach, limit[2];
};

bool fixed_add_receiver(struct fixed_receivers *receivers, const struct fixed_screen *screen,
	const struct fixed_surface *surface, const struct fixed_bias *bias);

#endif
