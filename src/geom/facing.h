/* SPDX-License-Identifier: MIT */
#ifndef GEOM_FACING_H
#define GEOM_FACING_H

#include "geom/caster.h"

/** Words in a set of one bit a triangle: t is bit t % 64 of word t / 64. */
size_t facing_words(const struct caster *caster);

/**
 * Which triangles face the light: those where
 *	((p1 - p0) x (p2 - p0)) . (light.xyz - light.w * p0) > 0
 * evaluated in double from the caster's float positions. None when the light is not finite, and
 * never one without area.
 *
 * light: object space, homogeneous: w = 1 a point, w = 0 the direction towards the light.
 * facing: [facing_words()], overwritten; bits past the last triangle are zero.
 */
void facing_find(const struct caster *caster, const float light[4], uint64_t *facing);

/** The same bits, with each triangle tested by itself: what facing_find() is measured against. */
void facing_find_all(const struct caster *caster, const float light[4], uint64_t *facing);

/** What is known of the facing of a caster's blocks, as a light moves. Start with zeros, for each
 *  caster: facing, safe and turned are [facing_words()], and the owner's. */
struct facing_track {
	float light[4];
	double travel;    /* how far it has gone since all was zero, w apart */
	uint64_t *facing; /* for where it is */
	double *safe;     /* of each block: no triangle of it turns before it has gone so far */
	uint64_t *turned; /* a bit for each triangle that turned the last time; no need of zeros */
	size_t tested;    /* blocks, the last time */
};

/** How far it is from the track's light to another; infinite where w is another, or not finite. */
double facing_way(const struct facing_track *track, const float light[4]);

/** Makes the facing that of another light, as facing_find() finds it. Blocks of which no triangle
 *  can have turned are not tested. */
void facing_renew(const struct caster *caster, const float light[4], struct facing_track *track);

#endif
