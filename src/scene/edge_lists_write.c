/* SPDX-License-Identifier: MIT */
#include "scene/edge_lists_write.h"
#include "base/array.h"
#include <stdlib.h>

/* Turns the tiles' counts of runs into where their lists begin. */
static void place_runs(struct edge_lists *lists, size_t tiles)
{
	uint32_t sum = 0;
	for (size_t t = 0; t < tiles; t++) {
		struct list_end *end = &lists->ends[t];
		uint32_t count = end->runs;
		lists->first[t] = sum;
		end->last_edge = 0;
		end->runs = sum;
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
		.start = edge_nearest(edge),
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

/* Writes runs of the collected edges, each tile's in the chains' order. */
static void write_runs(
	struct edge_lists *lists, const struct edge_chains *chains, size_t tiles, uint32_t screen)
{
	place_runs(lists, tiles);
	size_t entry = 0;
	uint32_t vertex = 0; /* the next one */
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		uint32_t added = edge_added_vertices(lists, i);
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
			if (list_continues(end, i))
				extend(&lists->runs[end->runs - 1], &alone);
			else
				lists->runs[end->runs++] = alone;
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

static void sort_runs(struct edge_lists *lists, size_t tiles)
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

/* Turns the tiles' counts of edges into where their lists begin. */
static void place_edges(struct edge_lists *lists, size_t tiles)
{
	uint32_t sum = 0;
	for (size_t t = 0; t < tiles; t++) {
		uint32_t count = lists->ends[t].edges;
		lists->ends[t].edges = sum;
		sum += count;
	}
}

/* The edges that are listed, and their texels beside them, in the chains' order. */
static size_t find_keys(struct edge_lists *lists, const struct edge_chains *chains, uint32_t screen)
{
	size_t count = 0;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		if (!edge_is_listed(lists, i))
			continue;
		struct edge_texel *texel = &lists->texels[count];
		*texel = edge_texel_of(&chains->points[i], screen);
		lists->keys[count] = (struct keyed_edge){
			edge_texel_nearest(texel), (uint32_t)i, (uint32_t)count};
		count++;
	}
	return count;
}

#define DIGIT_BITS EDGE_DEPTH_BITS
#define DIGITS (1 << DIGIT_BITS)

/* Sorts by a digit of the keys; what has the same stays in order. */
static void sort_by_digit(
	const struct keyed_edge *from, struct keyed_edge *to, size_t count, uint32_t shift)
{
	uint32_t places[DIGITS] = {0}, sum = 0;
	for (size_t i = 0; i < count; i++)
		places[from[i].nearest >> shift & (DIGITS - 1)]++;
	for (size_t digit = 0; digit < DIGITS; digit++) {
		uint32_t here = places[digit];
		places[digit] = sum;
		sum += here;
	}
	for (size_t i = 0; i < count; i++)
		to[places[from[i].nearest >> shift & (DIGITS - 1)]++] = from[i];
}

/* Gives each list its own edges: one after the other to all of its tiles, the nearest first. */
static void write_whole(
	struct edge_lists *lists, const struct edge_chains *chains, size_t tiles, uint32_t screen)
{
	place_edges(lists, tiles);
	size_t count = find_keys(lists, chains, screen);
	struct keyed_edge *keys = lists->keys;
	sort_by_digit(keys, keys + count, count, 0);
	sort_by_digit(keys + count, keys, count, DIGIT_BITS);
	for (size_t i = 0; i < count; i++) {
		uint32_t edge = keys[i].edge, entry = edge > 0 ? lists->entry_ends[edge - 1] : 0;
		struct edge_texel texel = lists->texels[keys[i].texel];
		for (; entry < lists->entry_ends[edge]; entry++)
			lists->copies[lists->ends[lists->entries[entry]].edges++] = texel;
	}
}

bool edge_lists_make_runs(struct edge_lists *lists, const struct edge_chains *chains)
{
	size_t tiles = (size_t)lists->tiles * lists->tiles;
	/* One more, so that an empty array is somewhere. */
	if (!array_reserve((void **)&lists->vertices, &lists->vertex_capacity,
		    lists->vertex_count + 1, sizeof(*lists->vertices)) ||
		!array_reserve((void **)&lists->texels, &lists->texel_capacity,
			lists->vertex_count + 1, sizeof(*lists->texels)) ||
		!array_reserve((void **)&lists->runs, &lists->run_capacity, lists->run_count + 1,
			sizeof(*lists->runs)) ||
		!array_reserve((void **)&lists->first, &lists->first_capacity, tiles + 1,
			sizeof(*lists->first)))
		return false;
	write_runs(lists, chains, tiles, lists->screen);
	sort_runs(lists, tiles);
	return true;
}

bool edge_lists_make_whole(struct edge_lists *lists, const struct edge_chains *chains)
{
	size_t tiles = (size_t)lists->tiles * lists->tiles;
	lists->copy_count = lists->entry_count;
	if (!array_reserve((void **)&lists->texels, &lists->texel_capacity, lists->vertex_count + 1,
		    sizeof(*lists->texels)) ||
		!array_reserve((void **)&lists->keys, &lists->key_capacity,
			2 * lists->vertex_count + 1, sizeof(*lists->keys)) ||
		!array_reserve((void **)&lists->copies, &lists->copy_capacity,
			lists->copy_count + 1, sizeof(*lists->copies)))
		return false;
	write_whole(lists, chains, tiles, lists->screen);
	return true;
}
