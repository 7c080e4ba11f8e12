/* SPDX-License-Identifier: MIT */
#include "geom/silhouette_track.h"
#include "base/array.h"
#include "geom/set_search.h"
#include <stdlib.h>
#include <string.h>

void silhouette_track_finish(struct silhouette_track *track)
{
	free(track->facing.facing);
	free(track->facing.safe);
	free(track->facing.turned);
	free(track->starts);
	free(track->kept);
	free(track->next);
	*track = (struct silhouette_track){0};
}

size_t silhouette_track_bytes(const struct silhouette_track *track)
{
	size_t block = sizeof(*track->facing.facing) + sizeof(*track->facing.safe) +
		       sizeof(*track->facing.turned) + sizeof(*track->starts);
	size_t end = track->starts != NULL ? sizeof(*track->starts) : 0;
	return track->block_count * block + end +
	       (track->kept_capacity + track->next_capacity) * sizeof(*track->kept);
}

static bool reserve(struct silhouette_track *track, const struct caster *caster)
{
	size_t blocks = facing_words(caster);
	if (track->starts != NULL && track->block_count == blocks)
		return true;
	silhouette_track_finish(track);
	track->block_count = blocks;
	track->facing.facing = array_alloc(blocks, sizeof(*track->facing.facing));
	track->facing.safe = array_alloc(blocks, sizeof(*track->facing.safe));
	track->facing.turned = array_alloc(blocks, sizeof(*track->facing.turned));
	track->starts = array_alloc(blocks + 1, sizeof(*track->starts));
	return track->facing.facing != NULL && track->facing.safe != NULL &&
	       track->facing.turned != NULL && track->starts != NULL;
}

/* The blocks of a set of which, or of the triangles they lead to, some have turned. */
static uint64_t blocks_to_renew(
	const struct edge_table *table, const uint64_t *turned, size_t first, size_t end)
{
	const struct edge_block *last = &table->blocks[end - 1];
	uint64_t renew = 0;
	for (size_t b = first; b < end; b++)
		renew |= (uint64_t)(turned[b] != 0) << (b - first);
	for (size_t i = table->blocks[first].link; i < last->link + last->link_count; i++) {
		uint64_t across = turned[table->links[i]] & edge_link_faces(table, i);
		renew |= (uint64_t)(across != 0) << table->link_owners[i];
	}
	return renew;
}

/* Goes through the sets of blocks, from the kept edges to the next. */
struct renewal {
	struct silhouette_track *track;
	size_t count;              /* of next edges */
	size_t begin;              /* of a block's kept edges */
	struct corner_list listed; /* of one set */
};

/* Takes over the kept edges of blocks: from first up to end. */
static void keep_blocks(struct renewal *renewal, size_t first, size_t end)
{
	struct silhouette_track *track = renewal->track;
	size_t kept = track->starts[end] - renewal->begin;
	size_t shift = renewal->count - renewal->begin;
	if (kept > 0)
		memcpy(&track->next[renewal->count], &track->kept[renewal->begin],
			kept * sizeof(*track->kept));
	for (size_t b = first; b < end; b++)
		track->starts[b] += shift;
	renewal->count += kept;
	renewal->begin += kept;
}

/* Moves the kept edges of a set to where they go, with room between them; shifts: from places in
 * the list to places among the next edges, of each block that is renewed. */
static void make_room(struct renewal *renewal, size_t first, size_t end, uint64_t renew,
	size_t shifts[EDGE_BLOCK_SET])
{
	struct silhouette_track *track = renewal->track;
	size_t b = first, listed = 0;
	for (; renew != 0; renew &= renew - 1) {
		unsigned place = (unsigned)__builtin_ctzll(renew);
		size_t after = renewal->listed.ends[place];
		keep_blocks(renewal, b, first + place);
		b = first + place;
		renewal->begin = track->starts[b + 1];
		track->starts[b] = renewal->count;
		shifts[place] = renewal->count - listed;
		renewal->count += after - listed;
		listed = after;
		b++;
	}
	keep_blocks(renewal, b, end);
}

static bool renew_set(
	struct renewal *renewal, const struct set_search *search, size_t end, uint64_t renew)
{
	struct silhouette_track *track = renewal->track;
	struct corner_list *listed = &renewal->listed;
	size_t shifts[EDGE_BLOCK_SET];
	set_search_list(search, renew, true, listed);
	size_t most = renewal->count + track->starts[end] - renewal->begin + listed->count;
	if (!array_reserve(
		    (void **)&track->next, &track->next_capacity, most, sizeof(*track->next)))
		return false;
	make_room(renewal, search->first, end, renew, shifts);
	for (size_t i = 0; i < listed->count; i++) {
		uint16_t corner = listed->corners[i];
		track->next[i + shifts[corner / 256]] = set_search_edge(search, corner);
	}
	track->searched += (size_t)__builtin_popcountll(renew);
	return true;
}

static bool renew_edges(struct silhouette_track *track, const struct caster *caster)
{
	const struct edge_table *table = &caster->edges;
	struct renewal renewal;
	renewal.track = track;
	renewal.count = renewal.begin = 0;
	for (size_t set = 0; set < edge_table_sets(table); set++) {
		struct set_search search = {caster, track->facing.facing, set * EDGE_BLOCK_SET};
		size_t end = search.first + EDGE_BLOCK_SET;
		if (end > track->block_count)
			end = track->block_count;
		uint64_t renew = blocks_to_renew(table, track->facing.turned, search.first, end);
		if (!renew_set(&renewal, &search, end, renew))
			return false;
	}
	track->starts[track->block_count] = renewal.count;
	track->edge_count = renewal.count;
	return true;
}

static void swap_edges(struct silhouette_track *track)
{
	struct silhouette_edge *edges = track->kept;
	size_t capacity = track->kept_capacity;
	track->kept = track->next;
	track->kept_capacity = track->next_capacity;
	track->next = edges;
	track->next_capacity = capacity;
	track->edges = track->kept;
}

/* With more than this share of blocks tested, keeping what was found takes more time than it saves.
 */
#define TESTED_MAX 0.75

/* So many steps in a row tell: of few blocks, most are tested now and then. */
#define MANY_STEPS 4

static bool track_step(struct silhouette_track *track, const struct caster *caster,
	const float light[4], double way)
{
	if (track->plain) {
		memset(track->facing.facing, 0, track->block_count * sizeof(uint64_t));
		memset(track->facing.safe, 0, track->block_count * sizeof(double));
		memset(track->starts, 0, (track->block_count + 1) * sizeof(size_t));
	}
	facing_renew(caster, light, &track->facing);
	bool many = (double)track->facing.tested > TESTED_MAX * (double)track->block_count;
	if (!track->plain)
		track->many = many ? track->many + 1 : 0;
	if (track->many >= MANY_STEPS && (track->far == 0.0 || way < track->far))
		track->far = way;
	track->plain = false;
	track->searched = 0;
	return renew_edges(track, caster);
}

static bool find_plainly(
	struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	facing_find(caster, light, track->facing.facing);
	memcpy(track->facing.light, light, sizeof(track->facing.light));
	track->plain = true;
	track->facing.tested = track->searched = track->block_count;
	size_t count =
		silhouette_find(caster, track->facing.facing, track->next, track->next_capacity);
	track->edge_count = count;
	if (count <= track->next_capacity)
		return true;
	if (!array_reserve(
		    (void **)&track->next, &track->next_capacity, count, sizeof(*track->next)))
		return false;
	silhouette_find(caster, track->facing.facing, track->next, count);
	return true;
}

/* Nothing has changed since the last time. */
static bool is_same(
	const struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	return track->version == caster->version &&
	       memcmp(track->facing.light, light, sizeof(track->facing.light)) == 0;
}

static bool track_light(
	struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	if (!reserve(track, caster))
		return false;
	if (track->version != caster->version) {
		/* One that moves is another each time. */
		track->version = caster->version;
		track->far = 0.0;
		track->many = 0;
		return find_plainly(track, caster, light);
	}
	double way = facing_way(&track->facing, light);
	bool far = track->far > 0.0 && way >= track->far;
	return far ? find_plainly(track, caster, light) : track_step(track, caster, light, way);
}

bool silhouette_track(
	struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	if (is_same(track, caster, light)) {
		track->facing.tested = track->searched = 0;
		return true;
	}
	if (!track_light(track, caster, light)) {
		silhouette_track_finish(track);
		return false;
	}
	swap_edges(track);
	return true;
}
