/* SPDX-License-Identifier: MIT */
#ifndef GEOM_DISC_BOX_H
#define GEOM_DISC_BOX_H

#include "geom/screen_box.h"

/** What is in a rectangle of a light's screen, and where other points of the light's disc see it:
 *  beside that, by the point's place on the unit disc times what is between two numbers. */
struct disc_box {
	struct screen_box box; /* seen from the middle */
	float shear[2];        /* NDC, least and most; finite, but for what nothing is in */
};

struct disc_box disc_box_none(void);
struct disc_box disc_box_all(void);

/** Widens a box to what is in another. */
void disc_box_add(struct disc_box *box, const struct disc_box *other);

/** Where it is seen from a point of the unit disc. */
struct screen_box disc_box_from(const struct disc_box *box, const float point[2]);

#endif
