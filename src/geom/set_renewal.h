/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SET_RENEWAL_H
#define GEOM_SET_RENEWAL_H

#include "geom/set_search.h"

/** From the edges kept of a set of blocks to its next ones. */
struct set_renewal {
	const struct silhouette_edge *kept; /* [size], with more behind them: [kept_room] */
	size_t size, kept_room;
	/* [next_room]: at least what will be there. Behind that, others of it may be written. */
	struct silhouette_edge *next;
	size_t next_room;
	uint16_t *starts; /* [count]: where each block's begin among kept; then, among next */
	size_t count;     /* of blocks */
	size_t written;   /* set: next edges */
};

/** Writes the set's next edges: of the blocks of `renew`, a bit each, those listed, of others those
 *  kept. listed: where each block of `renew` ends, then the corners; returns what is behind. */
const uint16_t *set_renewal_write(struct set_renewal *renewal, const struct set_search *blocks,
	uint64_t renew, const uint16_t *listed);

#endif
