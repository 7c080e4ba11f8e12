/* SPDX-License-Identifier: MIT */
#ifndef SUPPORT_STRIP_H
#define SUPPORT_STRIP_H

#include <smoothie.h>

/** Across a strip, narrower than a texel of the layers of `gather`: its edge is at (1, 0). */
struct strip_profile {
	float at[3][2]; /* x, y */
	uint32_t count;
};

extern const struct strip_profile strip_level;
/** The edge is before what is seen of the strip, on its rise, and behind the plane of that. */
extern const struct strip_profile strip_bent;
/** The edge is deeper than the strip, on its plane. */
extern const struct strip_profile strip_falling;

/** A strip under the sun, which stands above, and a slope that comes down over it by 45 degrees and
 *  through its plane beyond. At a texel that misses the strip the slope may lie where the strip
 *  would: what tells that it is another sheet is the strip's edge on the way. */
void strip_add(struct sm_scene *scene, const struct strip_profile *profile);

/** Looks at the place z, in [-.72, -.64], of the strip. All that is seen, the slope from below and
 *  the strip in its shadow, is dark. Where the slope is nearer than this, by z, and its own depth
 *  at such a texel is behind the strip, nothing tells. */
struct sm_camera strip_camera(float z);

#endif
