/* SPDX-License-Identifier: MIT */
#ifndef GEOM_ORIENTATION_H
#define GEOM_ORIENTATION_H

#include "geom/sides.h"

/** What a mesh was like before it was repaired, and what that did. */
struct orientation {
	struct edge_counts edges;    /* as they came */
	size_t repeated;             /* triangles that were dropped */
	size_t closed_parts;         /* without a boundary */
	size_t open_parts;           /* with one */
	size_t non_orientable_parts; /* of the open ones */
	size_t turned;               /* triangles */
	size_t closed_count;         /* triangles of closed parts: the first, now */
};

/**
 * Winds triangles consistently and moves those of open parts behind those of closed ones; else the
 * order stays. Before that, triangles that repeat an earlier one are dropped (repeats.h): they cast
 * no shadow of their own, and hide what continues what.
 *
 * A part is what hangs together over edges with exactly two triangles; where more meet, which of
 * them continue each other cannot be told, and parts end. In a part both triangles of an edge are
 * made to run through it in opposite ways, with a search breadth-first. One where that leads to a
 * contradiction cannot be oriented (a Moebius strip, a Klein bottle) and stays as it is.
 *
 * A part is closed when at each edge as many of its triangles run one way as the other, also where
 * more than two meet: two boxes that touch along an edge are both closed. A closed part is seen
 * counter-clockwise from outside: it is turned so that its signed volume is positive. An open one,
 * or one without volume, is turned so that most of its triangles stay as they were.
 *
 * positions: [vertex_count][3]; indices: [3 * *triangle_count], each < vertex_count;
 * *triangle_count < 2^31. These two are changed. Takes linear time. False: out of memory.
 */
bool orientation_repair(struct orientation *found, const float (*positions)[3], size_t vertex_count,
	uint32_t *indices, size_t *triangle_count);

#endif
