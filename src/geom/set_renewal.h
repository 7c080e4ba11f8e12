/* SPDX-License-Identifier: MIT */
#ifndef GEOM_SET_RENEWAL_H
#define GEOM_SET_RENEWAL_H

#include "geom/set_search.h"

/** Goes through a set of blocks, from the edges kept of it to its next ones. */
struct set_renewal {
	const struct silhouette_edge *kept; /* [size] */
	size_t size;
	struct silhouette_edge *next;
	uint16_t *starts; /* [count]: where each block's begin among kept; then, among next */
	size_t count;     /* of blocks */
	size_t from, to;  /* places among these; 0, then the ends */
};

/** Writes the set's next edges: of the blocks of `renew`, a bit each, those listed, of others those
 *  kept. listed: where each block of `renew` ends, then the corners; returns what is behind. */
const uint16_t *set_renewal_write(struct set_renewal *renewal, const struct set_search *blocks,
	uint64_t renew, const uint16_t *listed);

#endif
