/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SHEETS_H
#define GEOM_SHEETS_H

#include "geom/silhouette.h"

/** Which of a caster's triangles count as sheets between a light and what it lights. */
struct sheet_rule {
	/** So many triangles, from the first, count where they face the light; the others whichever
	 *  side they show. At most caster.found.closed_count: along any ray that meets a closed
	 * surface, one that begins outside, as many triangles face as do not. */
	size_t one_sided;
	bool mirrored; /* the object's transform turns left and right around */
	bool all;      /* nothing is passed over: silhouette_find_all() */
};

/**
 * The boundary of all sheets that count: edges with a sheet on their left as seen from the light,
 * each as often as it bounds one. They are closed loops, and how often they wind around a point is
 * how many sheets lie over it. Where a sheet that counts on both sides folds away from the light,
 * its edge is there twice: for the part that faces and for that which does not.
 *
 * facing: as facing_find() leaves it for the light. back: [facing_words()], set to the two-sided
 * triangles that show their backs; not looked at when all triangles count on one side. Returns the
 * number found, at most 2 * edge_table_records(), and writes no more than capacity.
 */
size_t sheets_find(const struct caster *caster, const struct sheet_rule *rule, const float light[4],
	const uint64_t *facing, uint64_t *back, struct silhouette_edge *edges, size_t capacity);

#endif
