/* SPDX-License-Identifier: MIT */
#include "geom/set_renewal.h"
#include <string.h>

static void copy_edges(struct silhouette_edge *to, const struct silhouette_edge *from, size_t count)
{
	if (count > 0)
		memcpy(to, from, count * sizeof(*to));
}

/* Takes over the kept edges of blocks from first up to end, which are those up to `behind`. */
static void keep_blocks(struct set_renewal *renewal, size_t first, size_t end, size_t behind)
{
	size_t count = behind - renewal->from, shift = renewal->to - renewal->from;
	copy_edges(&renewal->next[renewal->to], &renewal->kept[renewal->from], count);
	for (size_t b = first; b < end; b++)
		renewal->starts[b] = (uint16_t)(renewal->starts[b] + shift);
	renewal->from += count;
	renewal->to += count;
}

/* Moves the kept edges to where they go, with room between them; shifts: from places in the list to
 * places among the next edges, of each block that is renewed. */
static void make_room(struct set_renewal *renewal, uint64_t renew, const uint16_t *ends,
	size_t shifts[EDGE_BLOCK_SET])
{
	uint16_t *starts = renewal->starts;
	size_t b = 0, listed = 0;
	for (; renew != 0; renew &= renew - 1) {
		size_t place = (size_t)__builtin_ctzll(renew);
		keep_blocks(renewal, b, place, starts[place]);
		b = place + 1;
		renewal->from = b < renewal->count ? starts[b] : renewal->size;
		starts[place] = (uint16_t)renewal->to;
		shifts[place] = renewal->to - listed;
		renewal->to += *ends - listed;
		listed = *ends++;
	}
	keep_blocks(renewal, b, renewal->count, renewal->size);
}

static void keep_all(struct set_renewal *renewal)
{
	copy_edges(renewal->next, renewal->kept, renewal->size);
	renewal->from = renewal->to = renewal->size;
}

const uint16_t *set_renewal_write(struct set_renewal *renewal, const struct set_search *blocks,
	uint64_t renew, const uint16_t *listed)
{
	if (renew == 0) {
		keep_all(renewal);
		return listed;
	}
	size_t shifts[EDGE_BLOCK_SET], ends = (size_t)__builtin_popcountll(renew);
	size_t count = listed[ends - 1];
	const uint16_t *corners = &listed[ends];
	for (size_t i = 0; i < count; i++)
		set_search_fetch(blocks, corners[i]);
	make_room(renewal, renew, listed, shifts);
	for (size_t i = 0; i < count; i++)
		renewal->next[i + shifts[corners[i] / 256]] = set_search_edge(blocks, corners[i]);
	return &corners[count];
}
