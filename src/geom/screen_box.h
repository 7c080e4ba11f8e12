/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SCREEN_BOX_H
#define GEOM_SCREEN_BOX_H

#include <stdbool.h>

/** A rectangle of a screen, NDC, which may go beyond it. */
struct screen_box {
	float min[2], max[2];
};

/** What nothing touches, and all that there is. */
struct screen_box screen_box_none(void);
struct screen_box screen_box_all(void);

bool screen_box_is_none(const struct screen_box *box);
bool screen_box_is_all(const struct screen_box *box);

/** Widens a box to what is in another, or to a point: to all, where that is not finite. */
void screen_box_add(struct screen_box *box, const struct screen_box *other);
void screen_box_add_point(struct screen_box *box, float x, float y);

/** Narrows a box to what is in another, too. */
void screen_box_cut(struct screen_box *box, const struct screen_box *other);

/** A box that is wider by so much on all sides. */
struct screen_box screen_box_widened(const struct screen_box *box, float by);

/** Whether boxes have a point in common. */
bool screen_box_touches(const struct screen_box *a, const struct screen_box *b);

#endif
