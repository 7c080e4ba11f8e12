/* SPDX-License-Identifier: MIT */
#include "geom/set_renewal.h"
#include <string.h>

/* Edges copied at a time: few runs are longer than a dozen, which take as long as a call. */
#define RUN_EDGES 4

/* room: edges that may be read and written, `count` or more. What is written past the count is
 * overwritten later, as edges are written in order. */
static inline void copy_run(
	struct silhouette_edge *to, const struct silhouette_edge *from, size_t count, size_t room)
{
	if (count + RUN_EDGES <= room)
		for (size_t i = 0; i < count; i += RUN_EDGES)
			memcpy(&to[i], &from[i], RUN_EDGES * sizeof(*to));
	else if (count > 0)
		memcpy(to, from, count * sizeof(*to));
}

/* Keeps `count` edges. from, to: places among kept and next ones. */
static inline void keep_run(const struct set_renewal *renewal, size_t from, size_t to, size_t count)
{
	size_t kept_room = renewal->kept_room - from, next_room = renewal->next_room - to;
	copy_run(&renewal->next[to], &renewal->kept[from], count,
		kept_room < next_room ? kept_room : next_room);
}

/* Makes each block begin as much later as the blocks before it have grown, modulo 2^16. */
static void move_starts(uint16_t *starts, size_t count, const uint16_t grown[EDGE_BLOCK_SET])
{
	uint16_t shift = 0;
	for (size_t b = 0; b < count; b++) {
		starts[b] = (uint16_t)(starts[b] + shift);
		shift = (uint16_t)(shift + grown[b]);
	}
}

/* Moves the kept edges to where they go, with room between them; shifts: from places in the list to
 * places among the next edges, of each block that is renewed. */
static void make_room(struct set_renewal *renewal, uint64_t renew, const uint16_t *ends,
	size_t shifts[EDGE_BLOCK_SET])
{
	const uint16_t *starts = renewal->starts;
	uint16_t grown[EDGE_BLOCK_SET] = {0};
	size_t from = 0, to = 0, listed = 0;
	for (; renew != 0; renew &= renew - 1) {
		size_t b = (size_t)__builtin_ctzll(renew), end = *ends++, count = end - listed;
		size_t behind = b + 1 < renewal->count ? starts[b + 1] : renewal->size;
		size_t kept = starts[b] - from;
		keep_run(renewal, from, to, kept);
		grown[b] = (uint16_t)(count - (behind - starts[b]));
		shifts[b] = to + kept - listed;
		from = behind;
		to += kept + count;
		listed = end;
	}
	keep_run(renewal, from, to, renewal->size - from);
	renewal->written = to + renewal->size - from;
	move_starts(renewal->starts, renewal->count, grown);
}

const uint16_t *set_renewal_write(struct set_renewal *renewal, const struct set_search *blocks,
	uint64_t renew, const uint16_t *listed)
{
	if (renew == 0) {
		keep_run(renewal, 0, 0, renewal->size);
		renewal->written = renewal->size;
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
