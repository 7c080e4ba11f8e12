/* SPDX-License-Identifier: MIT */
#ifndef SCENE_LIGHT_H
#define SCENE_LIGHT_H

#include "scene/scene.h"

/**
 * A light as the shadow map sees the scene. Window depth d in [0, 1] is GL's own: hyperbolic for a
 * spot, linear for a directional light. With z the distance along the light's axis and
 * l = (z - near) / (far - near):
 *
 *	l = d k / (1 - d (1 - k))        k = near_to_far (1 for a directional light)
 *	1 - b/r = (d_r - d_b) / (K - d_b)   K = pole
 *
 * for a blocker at b and a receiver at r. The second is exact and loses nothing to cancellation.
 * For a directional light the same expression, with K = 1, is (r - b) / (far - b): what the width
 * of the penumbra is of its width on a receiver at the far plane, as 1 - b/r is of that on a
 * receiver at infinity.
 */
struct light_frame {
	mat4 world_to_light; /* x right, y up on the screen, z along the axis; from the light, or
				for a directional one from the middle of the near plane */
	mat4 world_to_clip;
	bool parallel;
	float near, far;   /* along the axis, scene units; near is 0 for a directional light */
	float near_to_far; /* k */
	float pole;        /* K */
	float half_extent; /* of the screen: at distance 1 for a spot, in scene units else */
	float disc;        /* radius of the light: scene units for a spot; for a directional
			      light the tangent of the angle it shows */
	vec4 origin;       /* homogeneous: position, or the direction towards the light */
};

/** Bit for bit. */
bool light_frame_is_same(const struct light_frame *a, const struct light_frame *b);

/** Fits the light's screen and depth range around the scene's objects. */
void light_frame_init(
	struct light_frame *frame, const struct sm_light_desc *light, const struct sm_scene *scene);

/** The same for one to which nothing beside its screen is in shadow: that of a spot with a radius
 * is narrowed, about its axis, to its casters and what their penumbrae reach. Screen and depth
 * range are widened by up to a fifth so that they are mostly the same, bit for bit, where objects
 * have moved a little; they depend on nothing but the scene as it is. */
void light_frame_fit(
	struct light_frame *frame, const struct sm_light_desc *light, const struct sm_scene *scene);

/** How far from a surface, in texels, the nearest texel of a map lies, and the four nearest: half a
 *  texel and one; a twentieth more for vertices that the rasteriser snapped to its grid. */
#define LOOKUP_REACH_NEAREST 0.55f
#define LOOKUP_REACH_LINEAR 1.05f

/** The most that a receiver may be biased by for each texel that it is looked up around, in a map
 * of `size` texels a side: limit[0] + limit[1] d at window depth d. */
void light_frame_bias_limit(const struct light_frame *frame, float size, float limit[2]);

/** How far apart, window x or y, the ends of a ray from the middle of the light and of one from its
 *  rim are on the light's screen, for each unit of window depth between them. Finite. */
float disc_scale(const struct light_frame *frame);

#endif
