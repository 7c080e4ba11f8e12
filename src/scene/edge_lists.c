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
	uint32_t place;     /* of the next run; while they are counted, from 0 */
};

/* Which edges are listed: those before a step of depth, and of those in it the first ones. */
struct depth_limit {
	float nearest, steps_per_depth;
	int step;              /* DEPTH_STEPS: all */
	struct edge_room room; /* for edges in this step */
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
	if (entries > limit->room.runs || limit->room.vertices < 2)
		return false;
	limit->room.runs -= entries;
	limit->room.vertices -= 2;
	return true;
}

/* What a search needs whatever it finds. */
static bool reserve(struct edge_lists *lists, size_t tiles, size_t points)
{
	return array_reserve((void **)&lists->first, &lists->first_capacity, tiles + 1,
		       sizeof(*lists->first)) &&
	       array_reserve((void **)&lists->first_copy, &lists->first_copy_capacity, tiles + 1,
		       sizeof(*lists->first_copy)) &&
	       array_reserve(
		       (void **)&lists->ends, &lists->end_capacity, tiles, sizeof(*lists->ends)) &&
	       array_reserve((void **)&lists->entries, &lists->entry_capacity, tiles,
		       sizeof(*lists->entries)) &&
	       array_reserve((void **)&lists->entry_ends, &lists->entry_end_capacity, points,
		       sizeof(*lists->entry_ends));
}

/* Notes that an edge is listed; returns whether its run goes on there. Runs end at the same edges
 * in all tiles, whatever else is listed. */
static bool continues(struct list_end *end, size_t edge)
{
	bool goes_on = edge % EDGE_RUN_MAX != 0 && end->last_edge == edge;
	end->last_edge = (uint32_t)edge + 1;
	return goes_on;
}

/* Counts the runs that an edge begins in the tiles found. */
static size_t count_runs(struct edge_lists *lists, size_t edge, const uint16_t *found, size_t count)
{
	size_t begun = 0;
	for (size_t k = 0; k < count; k++) {
		struct list_end *end = &lists->ends[found[k]];
		uint32_t added = continues(end, edge) ? 0 : 1;
		end->place += added;
		begun += added;
	}
	return begun;
}

static bool is_listed(const struct edge_lists *lists, size_t edge)
{
	return lists->entry_ends[edge] > (edge > 0 ? lists->entry_ends[edge - 1] : 0);
}

/* Vertices that an edge adds to those of the edges before it. */
static uint32_t added_vertices(const struct edge_lists *lists, size_t edge)
{
	if (!is_listed(lists, edge))
		return 0;
	return edge > 0 && is_listed(lists, edge - 1) ? 1 : 2;
}

/* Finds each edge's tiles, and counts their runs. Stops where there are too many. */
static enum edge_lists_result collect(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, struct edge_room room, struct depth_limit limit)
{
	size_t tiles = (size_t)cover->tiles * cover->tiles;
	memset(lists->ends, 0, tiles * sizeof(*lists->ends));
	lists->entry_count = lists->run_count = lists->vertex_count = 0;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (edge->sheets > 0) {
			if (!array_reserve((void **)&lists->entries, &lists->entry_capacity,
				    lists->entry_count + tiles, sizeof(*lists->entries)))
				return EDGE_LISTS_NO_MEMORY;
			uint16_t *found = &lists->entries[lists->entry_count];
			size_t count = edge_cover_find(cover, edge, edge + 1, found);
			if (limit.step < DEPTH_STEPS && !admit(&limit, edge, count))
				count = 0;
			lists->run_count += count_runs(lists, i, found, count);
			lists->entry_count += count;
		}
		lists->entry_ends[i] = (uint32_t)lists->entry_count;
		lists->vertex_count += added_vertices(lists, i);
		if (lists->run_count > room.runs || lists->vertex_count > room.vertices)
			return EDGE_LISTS_FULL;
	}
	return EDGE_LISTS_MADE;
}

/* Of so many stretches of edges one is tried first. */
#define SAMPLED 8

/* Whether an even sample of the edges says that there will be too many runs. */
static bool looks_full(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, size_t runs_max)
{
	size_t sum = 0, sampled = 0;
	memset(lists->ends, 0, (size_t)cover->tiles * cover->tiles * sizeof(*lists->ends));
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (i / EDGE_RUN_MAX % SAMPLED != 0)
			continue;
		sampled++;
		if (edge->sheets > 0)
			sum += count_runs(lists, i, lists->entries,
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
	size_t tiles = (size_t)cover->tiles * cover->tiles, entries = 0, last = 0;
	memset(lists->ends, 0, tiles * sizeof(*lists->ends));
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
			added[both].runs -= continues(&lists->ends[lists->entries[k]], i);
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
	const struct edge_chains *chains, struct edge_cover *cover, struct edge_room room)
{
	struct depth_limit limit;
	struct step_sums added[DEPTH_STEPS], sum = {0};
	find_depth_range(chains, &limit);
	size_t entries = count_by_depth(lists, chains, cover, &limit, added);
	for (limit.step = 0; limit.step < DEPTH_STEPS - 1; limit.step++) {
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

/* Turns the tiles' counts of runs into where their lists begin. */
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

/* A coordinate in steps of the raster grid, as boxes have it: never more. */
static uint16_t box_step(int32_t at, uint32_t screen)
{
	int64_t clamped = at < 0 ? 0 : at < (int64_t)screen ? at : (int64_t)screen - 1;
	return (uint16_t)(clamped * EDGE_BOX_STEPS / screen);
}

static uint16_t lesser(uint16_t a, uint16_t b)
{
	return a < b ? a : b;
}

static uint16_t greater(uint16_t a, uint16_t b)
{
	return a > b ? a : b;
}

/* An edge as a run of its own. */
static struct edge_run run_of(const struct chain_point *edge, uint32_t first, uint32_t screen)
{
	uint16_t x[2] = {box_step(edge[0].x, screen), box_step(edge[1].x, screen)};
	uint16_t y[2] = {box_step(edge[0].y, screen), box_step(edge[1].y, screen)};
	return (struct edge_run){
		.first_count = first | 1u << 24,
		.start = nearest_of(edge),
		.min = {lesser(x[0], x[1]), lesser(y[0], y[1])},
		.max = {greater(x[0], x[1]), greater(y[0], y[1])},
	};
}

static void extend(struct edge_run *run, const struct edge_run *by)
{
	run->first_count += 1u << 24;
	run->start = smaller(run->start, by->start);
	for (int axis = 0; axis < 2; axis++) {
		run->min[axis] = lesser(run->min[axis], by->min[axis]);
		run->max[axis] = greater(run->max[axis], by->max[axis]);
	}
}

/* sheets: of the edge that leads there. */
static struct edge_vertex vertex_of(
	const struct chain_point *point, uint32_t screen, uint32_t sheets)
{
	float step = 1.0f / (float)screen;
	return (struct edge_vertex){
		(float)point->x * step, (float)point->y * step, point->depth, (float)sheets};
}

/* Writes the collected edges, each tile's in the chains' order. */
static void write_lists(
	struct edge_lists *lists, const struct edge_chains *chains, size_t tiles, uint32_t screen)
{
	place_lists(lists, tiles);
	size_t entry = 0;
	uint32_t vertex = 0; /* the next one */
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		uint32_t added = added_vertices(lists, i);
		for (uint32_t k = 2 - added; k < 2 && added > 0; k++)
			lists->vertices[vertex++] = vertex_of(
				&edge[k], screen, chain_is_grazing(edge) ? 0 : edge->sheets);
		if (added == 0)
			continue;
		lists->texels[vertex - 2] = edge_texel_of(edge, screen);
		lists->texels[vertex - 1] = (struct edge_texel){{0}}; /* none, as yet */
		struct edge_run alone = run_of(edge, vertex - 2, screen);
		for (; entry < lists->entry_ends[i]; entry++) {
			struct list_end *end = &lists->ends[lists->entries[entry]];
			if (continues(end, i))
				extend(&lists->runs[end->place - 1], &alone);
			else
				lists->runs[end->place++] = alone;
		}
	}
}

static int compare_runs(const void *p, const void *q)
{
	const struct edge_run *a = p, *b = q;
	if (a->start != b->start)
		return a->start < b->start ? -1 : 1;
	return edge_run_first(a) < edge_run_first(b) ? -1 : edge_run_first(a) > edge_run_first(b);
}

static void insert_runs(struct edge_run *runs, size_t count)
{
	for (size_t i = 1; i < count; i++) {
		struct edge_run run = runs[i];
		size_t place = i;
		for (; place > 0 && compare_runs(&runs[place - 1], &run) > 0; place--)
			runs[place] = runs[place - 1];
		runs[place] = run;
	}
}

/* Insertion is quicker than qsort() up to about so many. */
#define INSERTED_MAX 24

static void sort_lists(struct edge_lists *lists, size_t tiles)
{
	for (size_t t = 0; t < tiles; t++) {
		struct edge_run *runs = &lists->runs[lists->first[t]];
		size_t count = lists->first[t + 1] - lists->first[t];
		if (count <= INSERTED_MAX)
			insert_runs(runs, count);
		else
			qsort(runs, count, sizeof(*runs), compare_runs);
	}
}

/* Puts an edge behind those of a list of `count` that are no farther. */
static void insert_edge(
	struct edge_texel *list, uint32_t *nearest, size_t count, const struct edge_texel *edge)
{
	uint32_t depth = edge_texel_nearest(edge);
	size_t place = count;
	for (; place > 0 && nearest[place - 1] > depth; place--) {
		list[place] = list[place - 1];
		nearest[place] = nearest[place - 1];
	}
	list[place] = *edge;
	nearest[place] = depth;
}

/* Gives each list its own edges, those of its runs. There is room for them. */
static void copy_lists(struct edge_lists *lists, size_t tiles)
{
	size_t first = 0;
	const struct edge_run *run = lists->runs;
	for (size_t t = 0; t < tiles; t++) {
		size_t count = 0;
		lists->first_copy[t] = (uint32_t)first;
		for (; run < &lists->runs[lists->first[t + 1]]; run++)
			for (uint32_t i = 0; i < edge_run_count(run); i++)
				insert_edge(&lists->copies[first], &lists->nearest[first], count++,
					&lists->texels[edge_run_first(run) + i]);
		first += count;
	}
	lists->first_copy[tiles] = (uint32_t)first;
}

/* Edges of a list, in the mean, up to which a look at each is less than one at the boxes of runs,
 * most of which have a part in what is seen there. */
#define SHORT_LIST 24

/* Whether most lists that were collected are short. */
static bool are_short(const struct edge_lists *lists, size_t tiles)
{
	size_t filled = 0;
	for (size_t t = 0; t < tiles; t++)
		filled += lists->ends[t].place > 0;
	return lists->entry_count <= SHORT_LIST * filled;
}

/* Writes what has been collected. */
static enum edge_lists_result make(
	struct edge_lists *lists, const struct edge_chains *chains, size_t tiles, uint32_t screen)
{
	lists->copy_count = lists->whole ? lists->entry_count : 0;
	/* One more, so that an empty array is somewhere. */
	if (!array_reserve((void **)&lists->vertices, &lists->vertex_capacity,
		    lists->vertex_count + 1, sizeof(*lists->vertices)) ||
		!array_reserve((void **)&lists->texels, &lists->texel_capacity,
			lists->vertex_count + 1, sizeof(*lists->texels)) ||
		!array_reserve((void **)&lists->runs, &lists->run_capacity, lists->run_count + 1,
			sizeof(*lists->runs)) ||
		!array_reserve((void **)&lists->copies, &lists->copy_capacity,
			lists->copy_count + 1, sizeof(*lists->copies)) ||
		!array_reserve((void **)&lists->nearest, &lists->nearest_capacity,
			lists->copy_count + 1, sizeof(*lists->nearest)))
		return EDGE_LISTS_NO_MEMORY;
	write_lists(lists, chains, tiles, screen);
	sort_lists(lists, tiles);
	if (lists->whole)
		copy_lists(lists, tiles);
	return EDGE_LISTS_MADE;
}

enum edge_lists_result edge_lists_make(struct edge_lists *lists, const struct edge_chains *chains,
	struct edge_cover *cover, uint32_t screen, struct edge_room room, bool drop)
{
	size_t tiles = (size_t)cover->tiles * cover->tiles;
	lists->dropped = 0;
	if (!reserve(lists, tiles, chains->count))
		return EDGE_LISTS_NO_MEMORY;
	if (!drop && looks_full(lists, chains, cover, room.runs))
		return EDGE_LISTS_FULL;
	enum edge_lists_result result = collect(lists, chains, cover, room, no_limit);
	if (result == EDGE_LISTS_FULL && drop)
		result = collect_nearest(lists, chains, cover, room);
	if (result != EDGE_LISTS_MADE)
		return result;
	lists->edge_count = lists->entry_count;
	bool short_lists = are_short(lists, tiles);
	lists->whole = short_lists && lists->entry_count <= room.copies;
	if (short_lists && !lists->whole && !drop)
		return EDGE_LISTS_FULL;
	return make(lists, chains, tiles, screen);
}

void edge_lists_finish(struct edge_lists *lists)
{
	free(lists->vertices);
	free(lists->texels);
	free(lists->copies);
	free(lists->nearest);
	free(lists->runs);
	free(lists->first);
	free(lists->first_copy);
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
	       (lists->first_capacity + lists->first_copy_capacity + lists->entry_end_capacity +
		       lists->nearest_capacity) *
		       sizeof(uint32_t) +
	       lists->end_capacity * sizeof(*lists->ends) +
	       lists->entry_capacity * sizeof(*lists->entries);
}
