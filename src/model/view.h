/* SPDX-License-Identifier: MIT */
#ifndef MODEL_VIEW_H
#define MODEL_VIEW_H

#include "model/light.h"
#include "model/raster.h"

/** The part of a triangle that a pixel of the picture sees. */
struct view_pixel {
	const struct object *object; /* of the scene; NULL: nothing is there */
	size_t triangle;             /* of the object's mesh */
	double weights[3];           /* of its corners */
	bool front;                  /* its front is seen, as GL sees it */
	float depth;
};

/** What a camera sees, rows from the lower one. */
struct view {
	const struct model_light *light;
	bool weights_stay; /* as in struct raster_area */
	int width, height;
	struct view_pixel *pixels; /* owned */
};

/** Draws the view of one that is zeroed but for weights_stay. */
bool view_init(struct view *view, const struct model_light *light, mat4 world_to_clip, int width,
	int height, struct sm_error *error);
/** Fine on a zeroed one. */
void view_finish(struct view *view);

/** A surface in light space. */
struct surface {
	double position[3];
	double normal[3],
		offset;   /* of its plane: normal . p = offset; of any length, either side */
	bool faces_light; /* with the side that is seen */
};

struct surface view_surface(const struct view *view, const struct view_pixel *pixel);

#endif
