/* SPDX-License-Identifier: MIT */
#include "scene/edge_lists.h"
#include "base/array.h"
#include "scene/edge_lists_write.h"
#include <stdlib.h>
#include <string.h>

/* Steps of depth in which edges are let go of. */
#define DEPTH_STEPS 1024

/* Which edges are listed: those before a step of depth, and of those in it the first ones. */
struct depth_limit {
	float nearest, steps_per_depth;
	int step;              /* DEPTH_STEPS: all */
	struct edge_room room; /* for edges in this step */
};

static const struct depth_limit no_limit = {.step = DEPTH_STEPS};

static int step_of(const struct depth_limit *limit, const struct chain_point *edge)
{
	float steps = (edge_nearest(edge) - limit->nearest) * limit->steps_per_depth;
	return (int)smaller(steps, DEPTH_STEPS - 1);
}

/* Whether an edge of so many entries is listed. */
static bool admit(struct depth_limit *limit, const struct chain_point *edge, size_t entries)
{
	int step = step_of(limit, edge);
	if (step != limit->step)
		return step < limit->step;
	if (entries > limit->room.runs || limit->room.vertices < 2)
		return false;
	limit->room.runs -= entries;
	limit->room.vertices -= 2;
	return true;
}

/* What a search needs whatever it finds. */
static bool reserve(struct edge_lists *lists, size_t tiles, size_t points)
{
	return array_reserve(
		       (void **)&lists->ends, &lists->end_capacity, tiles, sizeof(*lists->ends)) &&
	       array_reserve((void **)&lists->entries, &lists->entry_capacity, tiles,
		       sizeof(*lists->entries)) &&
	       array_reserve((void **)&lists->entry_ends, &lists->entry_end_capacity, points,
		       sizeof(*lists->entry_ends));
}

static void clear_ends(struct edge_lists *lists)
{
	for (size_t t = 0; t < (size_t)lists->tiles * lists->tiles; t++)
		lists->ends[t] = (struct list_end){.nearest = CHAIN_DEPTH_MAX};
}

/* Counts an edge in the tiles found; returns how many runs it begins. */
static size_t count_runs(struct edge_lists *lists, const struct edge_chains *chains, size_t edge,
	const uint16_t *found, size_t count)
{
	float nearest = edge_nearest(&chains->points[edge]);
	size_t begun = 0;
	for (size_t k = 0; k < count; k++) {
		struct list_end *end = &lists->ends[found[k]];
		uint32_t added = list_continues(end, edge) ? 0 : 1;
		end->runs += added;
		end->edges++;
		end->nearest = smaller(nearest, end->nearest);
		begun += added;
	}
	return begun;
}

/* Finds the tiles of an edge if it is listed; returns how many. */
static size_t list_edge(struct edge_cover *cover, struct depth_limit *limit,
	const struct chain_point *edge, uint16_t *found)
{
	bool all = limit->step == DEPTH_STEPS;
	if (!all && step_of(limit, edge) > limit->step)
		return 0;
	size_t count = edge_cover_find(cover, edge, edge + 1, found);
	return all || admit(limit, edge, count) ? count : 0;
}

/* Finds each edge's tiles, and counts their runs. Stops where there are too many. */
static enum edge_lists_result collect(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, struct edge_room room, struct depth_limit limit)
{
	size_t tiles = (size_t)cover->tiles * cover->tiles;
	clear_ends(lists);
	lists->entry_count = lists->run_count = lists->vertex_count = 0;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (edge->sheets > 0) {
			if (!array_reserve((void **)&lists->entries, &lists->entry_capacity,
				    lists->entry_count + tiles, sizeof(*lists->entries)))
				return EDGE_LISTS_NO_MEMORY;
			uint16_t *found = &lists->entries[lists->entry_count];
			size_t count = list_edge(cover, &limit, edge, found);
			lists->run_count += count_runs(lists, chains, i, found, count);
			lists->entry_count += count;
		}
		lists->entry_ends[i] = (uint32_t)lists->entry_count;
		lists->vertex_count += edge_added_vertices(lists, i);
		if (lists->run_count > room.runs || lists->vertex_count > room.vertices)
			return EDGE_LISTS_FULL;
	}
	return EDGE_LISTS_MADE;
}

/* Of so many stretches of edges at least, one is tried first; and about so many edges of more. */
#define SAMPLED 8
#define SAMPLED_EDGES 4096
/* Fewer are quickly listed. */
#define SAMPLED_MIN 512

/* Whether an even sample of the edges says that there will be too many runs. */
static bool looks_full(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, size_t runs_max)
{
	size_t sum = 0, sampled = 0, apart = chains->count / SAMPLED_EDGES;
	apart = apart > SAMPLED ? apart : SAMPLED;
	if (chains->count < SAMPLED_MIN)
		return false;
	clear_ends(lists);
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (i / EDGE_RUN_MAX % apart != 0)
			continue;
		sampled++;
		if (edge->sheets > 0)
			sum += count_runs(lists, chains, i, lists->entries,
				edge_cover_find(cover, edge, edge + 1, lists->entries));
	}
	return sampled > 0 &&
	       (double)sum * (double)chains->count > (double)runs_max * (double)sampled;
}

/* What the edges of a step of depth add to those before it. */
struct step_sums {
	int64_t runs, vertices;
};

/* Finds what each step adds; returns how many entries there are. */
static size_t count_by_depth(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, const struct depth_limit *limit,
	struct step_sums added[DEPTH_STEPS])
{
	size_t entries = 0, last = 0;
	clear_ends(lists);
	memset(added, 0, DEPTH_STEPS * sizeof(*added));
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (edge->sheets == 0)
			continue;
		size_t count = edge_cover_find(cover, edge, edge + 1, lists->entries);
		int step = step_of(limit, edge), before = i > 0 ? step_of(limit, edge - 1) : 0;
		/* Two edges that follow each other share a vertex, and runs, once both are
		 * listed. */
		int both = step > before ? step : before;
		added[step].runs += (int64_t)count;
		for (size_t k = 0; k < count; k++)
			added[both].runs -= list_continues(&lists->ends[lists->entries[k]], i);
		added[step].vertices += count > 0 ? 2 : 0;
		added[both].vertices -= count > 0 && last > 0 && last == i;
		last = count > 0 ? i + 1 : 0;
		entries += count;
	}
	return entries;
}

static void find_depth_range(const struct edge_chains *chains, struct depth_limit *limit)
{
	float nearest = CHAIN_DEPTH_MAX, farthest = 0.0f;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		if (chains->points[i].sheets == 0)
			continue;
		float depth = edge_nearest(&chains->points[i]);
		nearest = smaller(nearest, depth);
		farthest = larger(farthest, depth);
	}
	limit->nearest = nearest;
	limit->steps_per_depth =
		farthest > nearest ? DEPTH_STEPS / larger(farthest - nearest, 1e-30f) : 0.0f;
}

/* Collects the nearest edges of all, as many as there is room for. */
static enum edge_lists_result collect_nearest(struct edge_lists *lists,
	const struct edge_chains *chains, struct edge_cover *cover, struct edge_room room)
{
	struct depth_limit limit;
	struct step_sums added[DEPTH_STEPS], sum = {0};
	find_depth_range(chains, &limit);
	size_t entries = count_by_depth(lists, chains, cover, &limit, added);
	for (limit.step = 0; limit.step < DEPTH_STEPS; limit.step++) {
		const struct step_sums *step = &added[limit.step];
		if (sum.runs + step->runs > (int64_t)room.runs ||
			sum.vertices + step->vertices > (int64_t)room.vertices)
			break;
		sum.runs += step->runs;
		sum.vertices += step->vertices;
	}
	limit.room.runs = room.runs - (size_t)sum.runs;
	limit.room.vertices = room.vertices - (size_t)sum.vertices;
	enum edge_lists_result result = collect(lists, chains, cover, room, limit);
	lists->dropped = entries - lists->entry_count;
	return result;
}

/* Edges of a list, in the mean, up to which a look at each is less than one at the boxes of runs,
 * most of which have a part in what is seen there. */
#define SHORT_LIST 24

/* Whether most lists that were collected are short. */
static bool are_short(const struct edge_lists *lists, size_t tiles)
{
	size_t filled = 0;
	for (size_t t = 0; t < tiles; t++)
		filled += lists->ends[t].edges > 0;
	return lists->entry_count <= SHORT_LIST * filled;
}

enum edge_lists_result edge_lists_make(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, uint32_t screen, struct edge_room room, bool drop)
{
	size_t tiles = (size_t)cover->tiles * cover->tiles;
	lists->tiles = cover->tiles;
	lists->screen = screen;
	lists->dropped = 0;
	if (!reserve(lists, tiles, chains->count))
		return EDGE_LISTS_NO_MEMORY;
	enum edge_lists_result result = EDGE_LISTS_FULL;
	if (!looks_full(lists, chains, cover, room.runs))
		result = collect(lists, chains, cover, room, no_limit);
	if (result == EDGE_LISTS_FULL && drop)
		result = collect_nearest(lists, chains, cover, room);
	if (result != EDGE_LISTS_MADE)
		return result;
	lists->edge_count = lists->entry_count;
	bool short_lists = are_short(lists, tiles);
	lists->whole = short_lists && lists->entry_count <= room.copies;
	if (short_lists && !lists->whole && !drop)
		return EDGE_LISTS_FULL;
	bool made = lists->whole ? edge_lists_make_whole(lists, chains)
				 : edge_lists_make_runs(lists, chains);
	return made ? EDGE_LISTS_MADE : EDGE_LISTS_NO_MEMORY;
}

void edge_lists_finish(struct edge_lists *lists)
{
	free(lists->vertices);
	free(lists->texels);
	free(lists->copies);
	free(lists->keys);
	free(lists->runs);
	free(lists->first);
	free(lists->entries);
	free(lists->entry_ends);
	free(lists->ends);
	*lists = (struct edge_lists){0};
}

size_t edge_lists_bytes(const struct edge_lists *lists)
{
	return lists->vertex_capacity * sizeof(*lists->vertices) +
	       (lists->texel_capacity + lists->copy_capacity) * sizeof(*lists->texels) +
	       lists->run_capacity * sizeof(*lists->runs) +
	       (lists->first_capacity + lists->entry_end_capacity) * sizeof(uint32_t) +
	       lists->key_capacity * sizeof(*lists->keys) +
	       lists->end_capacity * sizeof(*lists->ends) +
	       lists->entry_capacity * sizeof(*lists->entries);
}
