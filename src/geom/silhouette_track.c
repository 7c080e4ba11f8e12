/* SPDX-License-Identifier: MIT */
#include "geom/silhouette_track.h"
#include "base/array.h"
#include "geom/set_renewal.h"
#include "geom/word.h"
#include <stdlib.h>
#include <string.h>

void silhouette_track_finish(struct silhouette_track *track)
{
	free(track->facing.facing);
	free(track->facing.safe);
	free(track->facing.turned);
	free(track->facing.changed);
	free(track->marks);
	free(track->renew);
	free(track->set_starts);
	free(track->starts);
	free(track->kept);
	free(track->next);
	for (size_t i = 0; i < track->part_count; i++)
		free(track->parts[i].listed);
	free(track->parts);
	*track = (struct silhouette_track){0};
}

size_t silhouette_track_bytes(const struct silhouette_track *track)
{
	size_t sets = (track->block_count + EDGE_BLOCK_SET - 1) / EDGE_BLOCK_SET;
	size_t padded = sets * EDGE_BLOCK_SET;
	size_t listed = 0;
	for (size_t i = 0; i < track->part_count; i++)
		listed += track->parts[i].listed_capacity;
	return track->block_count * (sizeof(*track->facing.facing) + sizeof(*track->facing.turned) +
					    sizeof(*track->starts)) +
	       padded * (sizeof(*track->facing.safe) + sizeof(*track->marks)) +
	       sets * (sizeof(*track->facing.changed) + sizeof(*track->renew) +
			      sizeof(*track->set_starts)) +
	       (track->marks != NULL ? sizeof(*track->marks) : 0) +
	       track->part_count * sizeof(*track->parts) + listed * sizeof(*track->parts->listed) +
	       (track->kept_capacity + track->next_capacity) * sizeof(*track->kept);
}

static bool reserve(struct silhouette_track *track, const struct caster *caster)
{
	size_t blocks = facing_words(caster), sets = edge_table_sets(&caster->edges);
	struct facing_track *facing = &track->facing;
	if (track->set_starts != NULL && track->block_count == blocks)
		return true;
	silhouette_track_finish(track);
	track->block_count = blocks;
	facing->facing = array_zalloc(blocks, sizeof(*facing->facing));
	facing->turned = array_alloc(blocks, sizeof(*facing->turned));
	facing->safe = array_alloc(facing_padded(caster), sizeof(*facing->safe));
	facing->changed = array_alloc(sets, sizeof(*facing->changed));
	track->marks = array_alloc(facing_padded(caster) + 1, sizeof(*track->marks));
	track->renew = array_alloc(sets, sizeof(*track->renew));
	track->starts = array_zalloc(blocks, sizeof(*track->starts));
	track->set_starts = array_zalloc(sets, sizeof(*track->set_starts));
	return facing->facing != NULL && facing->turned != NULL && facing->safe != NULL &&
	       facing->changed != NULL && track->marks != NULL && track->renew != NULL &&
	       track->starts != NULL && track->set_starts != NULL;
}

static bool reserve_parts(struct silhouette_track *track, size_t count)
{
	size_t had = track->part_count;
	if (!array_reserve(
		    (void **)&track->parts, &track->part_count, count, sizeof(*track->parts)))
		return false;
	if (track->part_count > had)
		memset(&track->parts[had], 0, (track->part_count - had) * sizeof(*track->parts));
	return true;
}

/* One search. */
struct search {
	struct silhouette_track *track;
	const struct facing_test *test;
	struct workers *workers; /* or NULL */
	unsigned parts;
	float way; /* that the light has gone */
	bool all;  /* nothing is kept */
};

/* Memory that a changed block's links are read from, which is anywhere. */
static inline void fetch_leading(const struct edge_table *table, size_t b)
{
	size_t i = table->blocks[b].leading;
	__builtin_prefetch(&table->leading[i]);
	__builtin_prefetch(&table->leading_faces[i]);
}

/* Marks the blocks that lead to triangles of a set that have turned, where links are known that way
 * around. Each link writes somewhere: there is no branch, which no processor could predict. Several
 * threads may write a mark, all of them the same. */
static void mark_leading(const struct search *search, size_t set)
{
	const struct edge_table *table = &search->test->caster->edges;
	const struct facing_track *facing = &search->track->facing;
	size_t first = set * EDGE_BLOCK_SET, nowhere = facing_padded(search->test->caster);
	for (uint64_t changed = facing->changed[set]; changed != 0; changed &= changed - 1)
		fetch_leading(table, first + (size_t)__builtin_ctzll(changed));
	for (uint64_t changed = facing->changed[set]; changed != 0; changed &= changed - 1) {
		size_t b = first + (size_t)__builtin_ctzll(changed);
		size_t end = edge_leading_end(table, b);
		for (size_t i = table->blocks[b].leading; i < end; i++) {
			bool leads = (facing->turned[b] & table->leading_faces[i]) != 0;
			size_t marked = leads ? table->leading[i] : nowhere;
			__atomic_store_n(&search->track->marks[marked], 1, __ATOMIC_RELAXED);
		}
	}
}

/* A bit for each block of a set that leads to triangles that have turned. */
static uint64_t blocks_that_lead(
	const struct edge_table *table, const struct facing_track *facing, size_t set, size_t last)
{
	const struct edge_block *end = &table->blocks[last];
	uint64_t found = 0;
	for (size_t i = table->blocks[set * EDGE_BLOCK_SET].link; i < end->link + end->link_count;
		i++) {
		uint32_t b = table->links[i];
		bool changed = facing->changed[b / EDGE_BLOCK_SET] >> b % EDGE_BLOCK_SET & 1;
		uint64_t turned = changed ? facing->turned[b] : 0;
		found |= (uint64_t)((turned & edge_link_faces(table, i)) != 0)
			 << table->link_owners[i];
	}
	return found;
}

static void renew_facing(void *data, unsigned index)
{
	const struct search *search = data;
	struct silhouette_track *track = search->track;
	struct track_part *part = &track->parts[index];
	part->tested = facing_renew_sets(
		search->test, search->way, part->first, part->end, &track->facing);
	if (search->test->caster->edges.leading == NULL)
		return;
	for (size_t set = part->first; set < part->end; set++)
		mark_leading(search, set);
}

static void find_facing(void *data, unsigned index)
{
	const struct search *search = data;
	struct track_part *part = &search->track->parts[index];
	part->tested = facing_find_sets(
		search->test, part->first, part->end, search->track->facing.facing);
}

/* Appends what is listed of a set's blocks. */
static bool append_list(struct track_part *part, uint64_t blocks, const struct corner_list *list)
{
	size_t ends = (size_t)__builtin_popcountll(blocks);
	if (!array_reserve((void **)&part->listed, &part->listed_capacity,
		    part->listed_count + ends + list->count, sizeof(*part->listed)))
		return false;
	uint16_t *listed = &part->listed[part->listed_count];
	for (; blocks != 0; blocks &= blocks - 1)
		*listed++ = list->ends[__builtin_ctzll(blocks)];
	memcpy(listed, list->corners, list->count * sizeof(*listed));
	part->listed_count += ends + list->count;
	return true;
}

static size_t set_size(const struct silhouette_track *track, size_t set)
{
	size_t left = track->block_count - set * EDGE_BLOCK_SET;
	return left < EDGE_BLOCK_SET ? left : EDGE_BLOCK_SET;
}

/* Where a set's kept edges end. */
static size_t set_end(
	const struct silhouette_track *track, const struct track_part *part, size_t set)
{
	return set + 1 < part->end ? track->set_starts[set + 1] : part->kept_end;
}

/* How many of a set's kept edges, `size`, are of some of its blocks. */
static size_t count_kept(
	const struct silhouette_track *track, size_t set, size_t size, uint64_t blocks)
{
	size_t count = 0, last = set_size(track, set) - 1;
	const uint16_t *starts = &track->starts[set * EDGE_BLOCK_SET];
	for (; blocks != 0; blocks &= blocks - 1) {
		size_t b = (size_t)__builtin_ctzll(blocks);
		count += (b < last ? starts[b + 1] : size) - starts[b];
	}
	return count;
}

/* A bit for each block of a set that is to be searched. */
static uint64_t blocks_to_list(const struct search *search, size_t set)
{
	const struct silhouette_track *track = search->track;
	const struct edge_table *table = &search->test->caster->edges;
	size_t first = set * EDGE_BLOCK_SET, last = first + set_size(track, set) - 1;
	if (search->all)
		return set_search_blocks(table, track->facing.facing, set);
	if (table->leading != NULL)
		return track->facing.changed[set] | word_of_bytes(&track->marks[first]);
	return track->facing.changed[set] | blocks_that_lead(table, &track->facing, set, last);
}

/* Lists the edges of the blocks that are to be searched, and counts how many there are with those
 * that are kept. */
static void list_part(void *data, unsigned index)
{
	const struct search *search = data;
	struct silhouette_track *track = search->track;
	struct track_part *part = &track->parts[index];
	const struct caster *caster = search->test->caster;
	struct corner_list list;
	part->listed_count = part->searched = 0;
	part->edge_count = part->kept_end - part->kept_begin;
	for (size_t set = part->first; set < part->end && !part->failed; set++) {
		struct set_search blocks = {caster, track->facing.facing, set * EDGE_BLOCK_SET};
		uint64_t renew = blocks_to_list(search, set);
		track->renew[set] = renew;
		if (renew == 0)
			continue;
		size_t size = set_end(track, part, set) - track->set_starts[set];
		set_search_list(&blocks, renew, true, &list);
		part->edge_count += list.count - count_kept(track, set, size, renew);
		part->searched += (size_t)__builtin_popcountll(renew);
		part->failed = !append_list(part, renew, &list);
	}
}

static void write_part(void *data, unsigned index)
{
	const struct search *search = data;
	struct silhouette_track *track = search->track;
	struct track_part *part = &track->parts[index];
	const uint16_t *listed = part->listed;
	size_t begin = part->kept_begin, out = part->out;
	for (size_t set = part->first; set < part->end; set++) {
		const struct set_search blocks = {
			search->test->caster, track->facing.facing, set * EDGE_BLOCK_SET};
		size_t end = set_end(track, part, set);
		struct set_renewal renewal = {.kept = &track->kept[begin],
			.size = end - begin,
			.kept_room = track->kept_count - begin,
			.next = &track->next[out],
			.next_room = part->out + part->edge_count - out,
			.starts = &track->starts[set * EDGE_BLOCK_SET],
			.count = set_size(track, set)};
		listed = set_renewal_write(&renewal, &blocks, track->renew[set], listed);
		track->set_starts[set] = out;
		out += renewal.written;
		begin = end;
	}
}

static void split(const struct search *search)
{
	struct silhouette_track *track = search->track;
	size_t sets = edge_table_sets(&search->test->caster->edges), end = 0;
	for (unsigned i = 0; i < search->parts; i++) {
		struct track_part *part = &track->parts[i];
		part->first = end;
		part->end = end = sets * (i + 1) / search->parts;
		part->kept_begin = part->first < sets ? track->set_starts[part->first] : 0;
		part->kept_end = end < sets ? track->set_starts[end] : track->kept_count;
		part->failed = false;
	}
}

static void run(const struct search *search, void (*work)(void *data, unsigned part))
{
	if (search->parts > 1)
		workers_run(search->workers, search->parts, work, (void *)search);
	else
		work((void *)search, 0);
}

/* Gives each part its place among the next edges. */
static bool place_parts(const struct search *search)
{
	struct silhouette_track *track = search->track;
	track->edge_count = track->tested = track->searched = 0;
	for (unsigned i = 0; i < search->parts; i++) {
		struct track_part *part = &track->parts[i];
		if (part->failed)
			return false;
		part->out = track->edge_count;
		track->edge_count += part->edge_count;
		track->tested += part->tested;
		track->searched += part->searched;
	}
	return array_reserve((void **)&track->next, &track->next_capacity, track->edge_count,
		sizeof(*track->next));
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
	track->kept_count = track->edge_count;
}

static bool find_edges(const struct search *search)
{
	run(search, list_part);
	if (!place_parts(search))
		return false;
	run(search, write_part);
	swap_edges(search->track);
	return true;
}

/* With more than this share of blocks searched, keeping what was found takes more time than it
 * saves: of models for which it is .46 it saves a tenth, of others for which it is .48 it costs as
 * much. */
#define BUSY_MAX 0.475

/* What a step counts in the average: of few blocks, most are searched now and then. */
#define BUSY_RATE 0.0625

/* Has all searched. */
static void keep_nothing(struct search *search)
{
	struct silhouette_track *track = search->track;
	size_t sets = edge_table_sets(&search->test->caster->edges);
	search->all = true;
	track->kept_count = 0;
	memset(track->set_starts, 0, sets * sizeof(*track->set_starts));
	memset(track->starts, 0, track->block_count * sizeof(*track->starts));
}

static bool track_step(struct search *search, double way)
{
	struct silhouette_track *track = search->track;
	const struct caster *caster = search->test->caster;
	bool knew = !track->plain;
	if (!knew) {
		memset(track->facing.safe, 0, facing_padded(caster) * sizeof(*track->facing.safe));
		keep_nothing(search);
	}
	track->plain = false;
	split(search);
	memset(track->marks, 0, facing_padded(caster) * sizeof(*track->marks));
	run(search, renew_facing);
	if (!find_edges(search))
		return false;
	double share = (double)track->searched / (double)track->block_count;
	if (knew)
		track->busy += (share - track->busy) * BUSY_RATE;
	if (track->busy > BUSY_MAX && (track->far == 0.0 || way < track->far))
		track->far = way;
	return true;
}

/* silhouette_find(), or the same. */
typedef size_t find_fn(const struct caster *caster, const uint64_t *facing,
	struct silhouette_edge *edges, size_t capacity);

/* Takes what is found for the facing that there is. */
static bool take_edges(struct silhouette_track *track, const struct caster *caster, find_fn *find)
{
	const uint64_t *facing = track->facing.facing;
	size_t count = find(caster, facing, track->kept, track->kept_capacity);
	if (count > track->kept_capacity) {
		if (!array_reserve((void **)&track->kept, &track->kept_capacity, count,
			    sizeof(*track->kept)))
			return false;
		find(caster, facing, track->kept, count);
	}
	track->edges = track->kept;
	track->edge_count = track->kept_count = count;
	track->searched = track->block_count;
	return true;
}

/* Alone, where nothing is kept, edges need not be listed first. */
static bool find_alone(const struct search *search)
{
	struct silhouette_track *track = search->track;
	const struct caster *caster = search->test->caster;
	track->tested = facing_find_sets(
		search->test, 0, edge_table_sets(&caster->edges), track->facing.facing);
	return take_edges(track, caster, silhouette_find);
}

static bool find_shared(struct search *search)
{
	keep_nothing(search);
	split(search);
	run(search, find_facing);
	return find_edges(search);
}

static bool find_plainly(struct search *search)
{
	struct silhouette_track *track = search->track;
	track->plain = true;
	return search->parts > 1 ? find_shared(search) : find_alone(search);
}

/* Nothing has changed since the last time. */
static bool is_same(
	const struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	return track->version == caster->version &&
	       memcmp(track->facing.light, light, sizeof(track->facing.light)) == 0;
}

static bool track_light(struct silhouette_track *track, const struct caster *caster,
	const float light[4], struct workers *workers)
{
	struct facing_test test;
	struct search search = {.track = track, .test = &test, .workers = workers, .parts = 1};
	if (!reserve(track, caster))
		return false;
	if (caster->triangle_count >= TRACK_SHARED_MIN)
		search.parts = workers_share(workers);
	if (search.parts > 1)
		search.parts *= TRACK_PARTS;
	if (!reserve_parts(track, search.parts))
		return false;
	facing_test_init(&test, caster, light);
	double way = facing_way(&track->facing, light);
	search.way = facing_track_move(&track->facing, caster, light);
	if (track->version != caster->version) {
		/* One that moves is another each time. */
		track->version = caster->version;
		track->far = 0.0;
		track->busy = 0.0;
		return find_plainly(&search);
	}
	bool far = track->far > 0.0 && way >= track->far;
	return far ? find_plainly(&search) : track_step(&search, way);
}

bool silhouette_track(struct silhouette_track *track, const struct caster *caster,
	const float light[4], struct workers *workers)
{
	if (is_same(track, caster, light)) {
		track->tested = track->searched = 0;
		return true;
	}
	if (track_light(track, caster, light, workers))
		return true;
	silhouette_track_finish(track);
	return false;
}

bool silhouette_track_all(
	struct silhouette_track *track, const struct caster *caster, const float light[4])
{
	/* What is known of the caster is of another place. */
	track->version = 0;
	if (reserve(track, caster)) {
		track->tested = facing_find_all(caster, light, track->facing.facing);
		if (take_edges(track, caster, silhouette_find_all))
			return true;
	}
	silhouette_track_finish(track);
	return false;
}
