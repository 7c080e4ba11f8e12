/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SILHOUETTE_TRACK_H
#define GEOM_SILHOUETTE_TRACK_H

#include "geom/silhouette.h"

/**
 * A caster's silhouette as a light moves: what is found for one place of the light is kept, and for
 * the next only those blocks are searched of which a triangle has turned, or one they lead to.
 * 32 bytes a block and 16 an edge of the silhouette. Zero is empty, and of no caster.
 * Where the light goes so far that most blocks have to be tested, as it jumps, nothing is kept.
 */
struct silhouette_track {
	const struct silhouette_edge *edges; /* as silhouette_find() finds them */
	size_t edge_count;
	size_t searched; /* blocks, the last time */
	struct facing_track facing;
	/* Owned, but for edges */
	uint64_t version; /* the caster's; 0: none */
	bool plain;       /* nothing but edges and facing is known of the last time */
	double far;       /* steps of at least this are as well searched plainly; 0: none known */
	unsigned many;    /* steps in a row that had most blocks tested */
	size_t block_count;
	size_t *starts; /* [block_count + 1]: where the edges of each block begin */
	struct silhouette_edge *kept, *next;
	size_t kept_capacity, next_capacity;
};

/** Makes the track that of a light, and a caster: any other than the last time, too. light: as
 *  facing_find() takes it. False: out of memory; the track is empty then. */
bool silhouette_track(
	struct silhouette_track *track, const struct caster *caster, const float light[4]);
void silhouette_track_finish(struct silhouette_track *track);

/** Of memory. */
size_t silhouette_track_bytes(const struct silhouette_track *track);

#endif
