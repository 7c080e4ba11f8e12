/* SPDX-License-Identifier: MIT */
#include "scene/edge_lists.h"
#include "base/array.h"
#include "base/float_range.h"
#include <stdlib.h>
#include <string.h>

/* Steps of depth in which edges are let go of. */
#define DEPTH_STEPS 1024

/* A list that is being made. */
struct list_end {
	uint32_t last_edge; /* 1 + the one that was listed last */
	uint32_t place;     /* of the next vertex; while they are counted, from 0 */
	uint32_t run;       /* place of the last chain's start */
};

/* A chain within a tile's list. */
struct chain_run {
	float start;
	uint32_t first, count; /* vertices */
};

/* Which edges are listed: those before a step of depth, and of those in it the first ones. */
struct depth_limit {
	float nearest, steps_per_depth;
	int step;    /* DEPTH_STEPS: all */
	size_t room; /* vertices that edges in this step may take */
};

static const struct depth_limit no_limit = {.step = DEPTH_STEPS};

static float nearest_of(const struct chain_point *edge)
{
	return smaller(edge[0].depth, edge[1].depth);
}

static int step_of(const struct depth_limit *limit, const struct chain_point *edge)
{
	float steps = (nearest_of(edge) - limit->nearest) * limit->steps_per_depth;
	return (int)smaller(steps, DEPTH_STEPS - 1);
}

/* Whether an edge of so many entries is listed. */
static bool admit(struct depth_limit *limit, const struct chain_point *edge, size_t entries)
{
	int step = step_of(limit, edge);
	if (step != limit->step)
		return step < limit->step;
	if (2 * entries > limit->room)
		return false;
	limit->room -= 2 * entries;
	return true;
}

/* What a search needs whatever it finds. */
static bool reserve(struct edge_lists *lists, size_t tiles, size_t points)
{
	return array_reserve((void **)&lists->first, &lists->first_capacity, tiles + 1,
		       sizeof(*lists->first)) &&
	       array_reserve(
		       (void **)&lists->ends, &lists->end_capacity, tiles, sizeof(*lists->ends)) &&
	       array_reserve((void **)&lists->entries, &lists->entry_capacity, tiles,
		       sizeof(*lists->entries)) &&
	       array_reserve((void **)&lists->entry_ends, &lists->entry_end_capacity, points,
		       sizeof(*lists->entry_ends));
}

/* Notes that an edge is listed; returns whether its chain goes on there. */
static bool continues(struct list_end *end, size_t edge)
{
	bool goes_on = edge > 0 && end->last_edge == edge;
	end->last_edge = (uint32_t)edge + 1;
	return goes_on;
}

/* Finds each edge's tiles, and counts their vertices. Stops where there are too many. */
static enum edge_lists_result collect(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, size_t vertices_max, struct depth_limit limit)
{
	size_t tiles = (size_t)cover->tiles * cover->tiles;
	memset(lists->ends, 0, tiles * sizeof(*lists->ends));
	lists->entry_count = 0;
	lists->vertex_count = 0;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (!edge->ends) {
			if (!array_reserve((void **)&lists->entries, &lists->entry_capacity,
				    lists->entry_count + tiles, sizeof(*lists->entries)))
				return EDGE_LISTS_NO_MEMORY;
			uint16_t *found = &lists->entries[lists->entry_count];
			size_t count = edge_cover_find(cover, edge, edge + 1, found);
			if (limit.step < DEPTH_STEPS && !admit(&limit, edge, count))
				count = 0;
			for (size_t k = 0; k < count; k++) {
				struct list_end *end = &lists->ends[found[k]];
				uint32_t added = continues(end, i) ? 1 : 2;
				end->place += added;
				lists->vertex_count += added;
			}
			lists->entry_count += count;
		}
		lists->entry_ends[i] = (uint32_t)lists->entry_count;
		if (lists->vertex_count > vertices_max)
			return EDGE_LISTS_FULL;
	}
	return EDGE_LISTS_MADE;
}

/* Of so many edges one is tried first. */
#define SAMPLED 16

/* Whether an even sample of the edges says that there will be too many vertices: each has
 * one in each of its tiles, and more where a chain begins. */
static bool looks_full(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, size_t vertices_max)
{
	size_t sum = 0;
	for (size_t i = 0; i + 1 < chains->count; i += SAMPLED) {
		const struct chain_point *edge = &chains->points[i];
		if (!edge->ends)
			sum += edge_cover_find(cover, edge, edge + 1, lists->entries);
	}
	return sum * SAMPLED > vertices_max;
}

/* Finds how many vertices each step of depth adds to those before it; counts all entries. */
static void count_by_depth(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, const struct depth_limit *limit, int64_t added[DEPTH_STEPS],
	size_t *entries)
{
	size_t tiles = (size_t)cover->tiles * cover->tiles;
	memset(lists->ends, 0, tiles * sizeof(*lists->ends));
	memset(added, 0, DEPTH_STEPS * sizeof(*added));
	*entries = 0;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (edge->ends)
			continue;
		size_t count = edge_cover_find(cover, edge, edge + 1, lists->entries);
		int step = step_of(limit, edge), before = i > 0 ? step_of(limit, edge - 1) : 0;
		int both = step > before ? step : before;
		added[step] += 2 * (int64_t)count;
		*entries += count;
		/* Two edges that follow each other share a vertex once both are listed. */
		for (size_t k = 0; k < count; k++)
			added[both] -= continues(&lists->ends[lists->entries[k]], i);
	}
}

static void find_depth_range(const struct edge_chains *chains, struct depth_limit *limit)
{
	float nearest = CHAIN_DEPTH_MAX, farthest = 0.0f;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		if (chains->points[i].ends)
			continue;
		float depth = nearest_of(&chains->points[i]);
		nearest = smaller(nearest, depth);
		farthest = larger(farthest, depth);
	}
	limit->nearest = nearest;
	limit->steps_per_depth =
		farthest > nearest ? DEPTH_STEPS / larger(farthest - nearest, 1e-30f) : 0.0f;
}

/* Collects the nearest edges of all, as many as there is room for. */
static enum edge_lists_result collect_nearest(struct edge_lists *lists,
	const struct edge_chains *chains, struct edge_cover *cover, size_t vertices_max)
{
	struct depth_limit limit;
	int64_t added[DEPTH_STEPS], sum = 0;
	size_t entries;
	find_depth_range(chains, &limit);
	count_by_depth(lists, chains, cover, &limit, added, &entries);
	limit.step = 0;
	while (limit.step < DEPTH_STEPS - 1 && sum + added[limit.step] <= (int64_t)vertices_max)
		sum += added[limit.step++];
	limit.room = vertices_max - (size_t)sum;
	enum edge_lists_result result = collect(lists, chains, cover, vertices_max, limit);
	lists->dropped = entries - lists->entry_count;
	return result;
}

static float start_at(float depth)
{
	float start = 1.0f + depth;
	return start - 1.0f > depth ? nextafterf(start, 0.0f) : start;
}

/* Turns the tiles' counts of vertices into where their lists begin. */
static void place_lists(struct edge_lists *lists, size_t tiles)
{
	uint32_t sum = 0;
	for (size_t t = 0; t < tiles; t++) {
		uint32_t count = lists->ends[t].place;
		lists->first[t] = sum;
		lists->ends[t] = (struct list_end){.place = sum};
		sum += count;
	}
	lists->first[tiles] = sum;
}

/* An edge of the chains as it is listed. */
struct listed_edge {
	struct chain_vertex from, to;
};

static struct listed_edge listed_edge_of(const struct chain_point *edge, float step)
{
	return (struct listed_edge){
		{(float)edge[0].x * step, (float)edge[0].y * step, edge[0].depth,
			start_at(nearest_of(edge))},
		{(float)edge[1].x * step, (float)edge[1].y * step, edge[1].depth, 0.0f},
	};
}

static void write_edge(struct chain_vertex *vertices, struct list_end *end,
	const struct listed_edge *edge, bool goes_on)
{
	if (!goes_on) {
		end->run = end->place;
		vertices[end->place++] = edge->from;
	}
	float *run_start = &vertices[end->run].start;
	*run_start = smaller(*run_start, edge->from.start);
	vertices[end->place++] = edge->to;
}

/* Writes the collected edges, each tile's in the chains' order. */
static void write_lists(
	struct edge_lists *lists, const struct edge_chains *chains, size_t tiles, float step)
{
	place_lists(lists, tiles);
	size_t entry = 0;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		if (entry == lists->entry_ends[i])
			continue;
		struct listed_edge edge = listed_edge_of(&chains->points[i], step);
		for (; entry < lists->entry_ends[i]; entry++) {
			struct list_end *end = &lists->ends[lists->entries[entry]];
			write_edge(lists->vertices, end, &edge, continues(end, i));
		}
	}
}

static int compare_runs(const void *p, const void *q)
{
	const struct chain_run *a = p, *b = q;
	if (a->start != b->start)
		return a->start < b->start ? -1 : 1;
	return a->first < b->first ? -1 : a->first > b->first;
}

static void insert_runs(struct chain_run *runs, size_t count)
{
	for (size_t i = 1; i < count; i++) {
		struct chain_run run = runs[i];
		size_t place = i;
		for (; place > 0 && compare_runs(&runs[place - 1], &run) > 0; place--)
			runs[place] = runs[place - 1];
		runs[place] = run;
	}
}

/* Insertion is quicker than qsort() up to about so many. */
#define INSERTED_MAX 24

/* Sorts a list's chains. There is room in sorted and order. */
static void sort_list(struct edge_lists *lists, uint32_t first, uint32_t end)
{
	struct chain_run *order = lists->order;
	size_t runs = 0;
	bool is_sorted = true;
	for (uint32_t i = first; i < end; i++) {
		float start = lists->vertices[i].start;
		if (start == 0.0f) {
			order[runs - 1].count++;
			continue;
		}
		is_sorted &= runs == 0 || order[runs - 1].start <= start;
		order[runs++] = (struct chain_run){start, i, 1};
	}
	if (is_sorted)
		return;
	if (runs <= INSERTED_MAX)
		insert_runs(order, runs);
	else
		qsort(order, runs, sizeof(*order), compare_runs);
	struct chain_vertex *to = lists->sorted;
	for (size_t i = 0; i < runs; to += order[i++].count)
		memcpy(to, &lists->vertices[order[i].first], order[i].count * sizeof(*to));
	memcpy(&lists->vertices[first], lists->sorted, (end - first) * sizeof(*to));
}

static bool sort_lists(struct edge_lists *lists, size_t tiles)
{
	uint32_t longest = 0;
	for (size_t t = 0; t < tiles; t++) {
		uint32_t count = lists->first[t + 1] - lists->first[t];
		longest = count > longest ? count : longest;
	}
	if (!array_reserve((void **)&lists->sorted, &lists->sorted_capacity, longest,
		    sizeof(*lists->sorted)) ||
		!array_reserve((void **)&lists->order, &lists->order_capacity, longest / 2,
			sizeof(*lists->order)))
		return false;
	for (size_t t = 0; t < tiles; t++)
		sort_list(lists, lists->first[t], lists->first[t + 1]);
	return true;
}

enum edge_lists_result edge_lists_make(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, float step, size_t vertices_max, bool drop)
{
	size_t tiles = (size_t)cover->tiles * cover->tiles;
	lists->dropped = 0;
	if (!reserve(lists, tiles, chains->count))
		return EDGE_LISTS_NO_MEMORY;
	if (!drop && looks_full(lists, chains, cover, vertices_max))
		return EDGE_LISTS_FULL;
	enum edge_lists_result result = collect(lists, chains, cover, vertices_max, no_limit);
	if (result == EDGE_LISTS_FULL && drop)
		result = collect_nearest(lists, chains, cover, vertices_max);
	if (result != EDGE_LISTS_MADE)
		return result;
	lists->edge_count = lists->entry_count;
	if (!array_reserve((void **)&lists->vertices, &lists->vertex_capacity, lists->vertex_count,
		    sizeof(*lists->vertices)))
		return EDGE_LISTS_NO_MEMORY;
	write_lists(lists, chains, tiles, step);
	return sort_lists(lists, tiles) ? EDGE_LISTS_MADE : EDGE_LISTS_NO_MEMORY;
}

void edge_lists_finish(struct edge_lists *lists)
{
	free(lists->vertices);
	free(lists->first);
	free(lists->entries);
	free(lists->entry_ends);
	free(lists->ends);
	free(lists->sorted);
	free(lists->order);
	*lists = (struct edge_lists){0};
}

size_t edge_lists_bytes(const struct edge_lists *lists)
{
	return (lists->vertex_capacity + lists->sorted_capacity) * sizeof(*lists->vertices) +
	       (lists->first_capacity + lists->entry_end_capacity) * sizeof(uint32_t) +
	       lists->end_capacity * sizeof(*lists->ends) +
	       lists->entry_capacity * sizeof(*lists->entries) +
	       lists->order_capacity * sizeof(*lists->order);
}
