/* SPDX-License-Identifier: MIT */
#ifndef GEOM_FIN_H
#define GEOM_FIN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** In NDC. Far beyond the screen, [-1, 1], and any fin that reaches it; near enough that floats
 *  there still step by less than a texel of the largest shadow map. */
#define FIN_NDC_LIMIT 1024.0f

/**
 * How wide fins are at NDC depth z of the silhouette, in NDC: straight lines in 1 - z, at most
 * FIN_NDC_LIMIT. A width that goes with 1 / w is one too, since z of a perspective is.
 *
 *	width = width_far + slope (1 - z)        what alpha is a share of
 *	drawn = drawn_far + slope (1 - z)        what is drawn of it, or beyond it
 */
struct fin_law {
	float width_far, drawn_far, slope; /* finite, >= 0 */
};

/* What is no width, below 0 or NaN, is 0. */

/** The same width everywhere. */
struct fin_law fin_law_constant(float width);
/** scale / w of a perspective, whose w is the distance, between near and far. Drawn only as far out
 *  as 1 - b/r of a receiver at the far plane, since beyond it alpha' is 1 (Chan & Durand 2003,
 *  section 4). */
struct fin_law fin_law_perspective(float scale, float near, float far);
/** scale (1 - d) at window depth d. */
struct fin_law fin_law_parallel(float scale);
/** Draws fins this much wider than they are. */
void fin_law_add_apron(struct fin_law *law, float apron);

float fin_law_drawn(const struct fin_law *law, float z);

/** The sides of the silhouette that the fin around a corner is on. */
enum fin_side { FIN_OUTSIDE = 1, FIN_INSIDE = 2, FIN_BOTH = 3 };

/** What no float in [-1, 1] has set: in the z of a fin's ends it tells a corner's sides. */
#define FIN_SIDE_BIT 0x40000000u

/**
 * A fin along a silhouette edge, and one around the corner at its start, as uploaded: two groups of
 * four words, of which smoothie_fin.vert makes what fin_expand() does. Ends are NDC, w = 1; x and y
 * may lie beyond the screen, z is in [-1, 1]. Outside is on the right of start -> end; where both
 * are at the same place, there is a corner alone.
 */
struct fin {
	float start[2];
	uint32_t start_z; /* of a float; FIN_SIDE_BIT: there is a corner, outside */
	uint32_t from;    /* unit normal, x and y in 16 bits: as unpackSnorm2x16() takes them */
	float end[2];
	uint32_t end_z; /* likewise; FIN_SIDE_BIT: there is a corner, inside */
	uint32_t to;
};

/** Without a corner. */
struct fin fin_along(const float start[3], const float end[3]);

/** Adds the sector between two unit normals, up to half a disc, to a fin without a corner. Halfway
 *  between is on the right of the way from the first to the second, outside. */
void fin_add_corner(struct fin *fin, const float from[2], const float to[2], enum fin_side side);

bool fin_has_edge(const struct fin *fin);

#define FIN_QUADS_MAX 4

/** How many it is drawn as, at least one. both_sides: a fin along an edge is on both. */
size_t fin_quads(const struct fin *fin, bool both_sides);

/** alpha of a fragment = length(offset) / |width|, both interpolated. */
struct fin_vertex {
	float position[3];
	float offset[2]; /* from the silhouette, NDC */
	float width;     /* NDC; below 0: inside. Not 0 at one vertex of a quad at least, but for
			    the apron */
};

#define FIN_VERTICES_MAX (4 * FIN_QUADS_MAX)

/** fin_quads() of four vertices in order around, of either orientation: along the edge, then around
 *  the corner, each outside first. Returns the number of vertices. */
size_t fin_expand(const struct fin *fin, const struct fin_law *law, bool both_sides,
	struct fin_vertex out[FIN_VERTICES_MAX]);

#endif
