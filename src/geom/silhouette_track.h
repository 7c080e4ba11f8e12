/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SILHOUETTE_TRACK_H
#define GEOM_SILHOUETTE_TRACK_H

#include "base/workers.h"
#include "geom/silhouette.h"

/** Meshes of fewer triangles are searched faster than threads wake up. */
#define TRACK_SHARED_MIN 200000

/** Parts that work is split into, for each thread that shares it: more than one, as silhouettes are
 *  not everywhere. */
#define TRACK_PARTS 4

/** Some sets of blocks, which one thread searches. */
struct track_part {
	size_t first, end;                /* sets */
	size_t kept_begin, kept_end, out; /* among kept and next edges */
	size_t tested, searched;          /* blocks */
	/* Of each set that is searched, where each block that is ends, and then the corners. */
	uint16_t *listed;
	size_t listed_count, listed_capacity;
	size_t edge_count;
	bool failed;
};

/**
 * A caster's silhouette as a light moves: what is found for one place of the light is kept, and for
 * the next only those blocks are searched of which a triangle has turned, or one they lead to.
 * 23 bytes a block and 16 an edge of the silhouette. Zero is empty, and of no caster.
 * Where the light goes so far that half the blocks have to be searched, as it jumps, nothing is
 * kept.
 */
struct silhouette_track {
	const struct silhouette_edge *edges; /* as silhouette_find() finds them */
	size_t edge_count;
	size_t tested, searched; /* blocks, the last time: for triangles that face, and for edges */
	struct facing_track facing;
	/* Owned, but for edges */
	uint64_t version; /* the caster's; 0: none */
	bool plain;       /* nothing but edges and facing is known of the last time */
	double far;       /* steps of at least this are as well searched plainly; 0: none known */
	double busy;      /* share of blocks that is searched each step, on average */
	size_t block_count;
	uint8_t *marks; /* [facing_padded() + 1]: 1 for a block that leads to one that turned, where
			   links are known that way around; the last is for those that do not */
	uint64_t *renew;    /* a bit for each block, a word for each set: to be searched */
	size_t *set_starts; /* where the edges of each set begin */
	uint16_t *starts;   /* [block_count]: the same of blocks, from there */
	struct silhouette_edge *kept, *next;
	size_t kept_count, kept_capacity, next_capacity;
	struct track_part *parts; /* of as many as ever were */
	size_t part_count;
};

/** Makes the track that of a light, and a caster: any other than the last time, too. light: as
 *  facing_find() takes it. workers: share the work on meshes of TRACK_SHARED_MIN triangles; NULL:
 *  there are none. Whoever works, the edges and their order are the same. False: out of memory;
 *  the track is empty then. */
bool silhouette_track(struct silhouette_track *track, const struct caster *caster,
	const float light[4], struct workers *workers);

/** The same with nothing passed over: each triangle is tested, and each edge looked at. */
bool silhouette_track_all(
	struct silhouette_track *track, const struct caster *caster, const float light[4]);

void silhouette_track_finish(struct silhouette_track *track);

/** Of memory. */
size_t silhouette_track_bytes(const struct silhouette_track *track);

#endif
