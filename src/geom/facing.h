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
 * facing: [facing_words()], overwritten; bits past the last triangle are zero. Returns of how many
 * blocks the triangles were tested: of the others, all face the light or none does.
 */
size_t facing_find(const struct caster *caster, const float light[4], uint64_t *facing);

/** The same bits, with each triangle tested by itself: what facing_find() is measured against. */
size_t facing_find_all(const struct caster *caster, const float light[4], uint64_t *facing);

/** A light as the quantised planes see it. Once for each triangle of a block: what is the same in
 *  each round of a loop, Clang widens before it, and then finds no instruction for the upper half
 *  of a product. */
struct plane_light {
	int16_t x[EDGE_BLOCK], y[EDGE_BLOCK], z[EDGE_BLOCK], d[EDGE_BLOCK];
};

/** A test of a caster's blocks for one light, neither of them owned. */
struct facing_test {
	const struct caster *caster;
	const float *light;
	bool finite; /* else nothing faces it, and no more is known */
	bool cones;  /* tell about it */
	float scale; /* of the light, rounded down; a share of the planes' radius */
	struct cone_light seen;
	struct plane_light planes;
};

void facing_test_init(struct facing_test *test, const struct caster *caster, const float light[4]);

/** facing_find() for the sets of EDGE_BLOCK_SET blocks from first up to end. */
size_t facing_find_sets(const struct facing_test *test, size_t first, size_t end, uint64_t *facing);

/** Elements of one a block, in whole sets. */
size_t facing_padded(const struct caster *caster);

/** What is known of the facing of a caster's blocks, as a light moves. Start with zeros, for each
 *  caster: the arrays are the owner's. */
struct facing_track {
	float light[4];
	uint64_t *facing; /* [facing_words()], for where it is */
	uint64_t *turned; /* [facing_words()]: a bit for each triangle that turned the last time, of
			     blocks that have one; of others, anything */
	float *safe;      /* [facing_padded()]: while the light goes no farther than this, no
			     triangle of a block turns; shares of the planes' radius */
	uint64_t *changed; /* [edge_table_sets()]: a bit for each block with one that turned */
};

/** How far it is from the track's light to another; infinite where w is another, or not finite. */
double facing_way(const struct facing_track *track, const float light[4]);

/** Moves the track on to another light, and returns the way as facing_renew_sets() takes it. */
float facing_track_move(
	struct facing_track *track, const struct caster *caster, const float light[4]);

/** Makes the facing of some sets that of the light that the track has moved on to, as facing_find()
 *  finds it. Blocks of which no triangle can have turned are not looked at. Returns of how many the
 *  triangles were tested. */
size_t facing_renew_sets(const struct facing_test *test, float way, size_t first, size_t end,
	struct facing_track *track);

#endif
