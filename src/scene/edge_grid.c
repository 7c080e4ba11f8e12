/* SPDX-License-Identifier: MIT */
#include "scene/edge_grid.h"
#include "base/array.h"
#include "scene/edge_winding.h"
#include <assert.h>
#include <stdlib.h>

/* Fewer tiles than these would save no memory that counts. */
#define TILES_MIN 32

#define WINDING_BIAS 128

/* Of farthest, beyond a tile: texels of the map that a receiver in the tile may be looked up in. */
#define CASTER_MARGIN_TEXELS 1.5f

static uint32_t edge_bits(const struct edge_grid_options *options)
{
	return options->subpixel_bits + options->finer_bits;
}

static struct edge_raster raster_of(const struct edge_grid_options *options)
{
	return (struct edge_raster){
		.tiles = options->tiles,
		.screen = options->map_size << edge_bits(options),
		.step = 1u << options->finer_bits,
		.margin = CASTER_MARGIN_TEXELS * (float)options->tiles / (float)options->map_size,
	};
}

/* With as many tiles as leave the lists short enough. */
static bool make_lists(struct edge_grid *grid, const struct light_frame *frame,
	const struct edge_grid_options *options, uint32_t screen)
{
	enum edge_lists_result result = EDGE_LISTS_FULL;
	while (result == EDGE_LISTS_FULL) {
		bool fewest = grid->depths.tiles <= TILES_MIN;
		if (!edge_cover_init(&grid->cover, &grid->depths, frame, options->map_size,
			    edge_bits(options)))
			return false;
		result = edge_lists_make(
			&grid->lists, &grid->chains, &grid->cover, screen, options->room, fewest);
		if (result == EDGE_LISTS_FULL && !tile_depths_halve(&grid->depths))
			return false;
	}
	return result == EDGE_LISTS_MADE;
}

/* Fills the tiles; returns how many have a list. */
static size_t fill_tiles(struct edge_grid *grid)
{
	const struct edge_lists *lists = &grid->lists;
	size_t filled = 0;
	for (size_t t = 0; t < (size_t)grid->tiles * grid->tiles; t++) {
		struct edge_list list = edge_lists_of(lists, t);
		int32_t winding = grid->winding[t] + WINDING_BIAS;
		winding = winding < 0 ? 0 : winding > 255 ? 255 : winding;
		grid->of[t] = (struct edge_tile){
			.first = list.first,
			.count_winding = list.count | (uint32_t)winding << 24,
			.nearest = list.count == 0 ? 2.0f : list.nearest,
			.farthest = grid->depths.farthest[t],
		};
		filled += list.count != 0;
	}
	return filled;
}

static void show_runs(struct edge_grid *grid)
{
	grid->runs = grid->lists.runs;
	grid->run_count = grid->lists.run_count;
	grid->vertices = grid->lists.vertices;
	grid->vertex_count = grid->lists.vertex_count;
}

static void show_lists(struct edge_grid *grid)
{
	const struct edge_lists *lists = &grid->lists;
	grid->whole = lists->whole;
	grid->texels = lists->whole ? lists->copies : lists->texels;
	grid->texel_count = lists->whole ? lists->copy_count : lists->vertex_count;
	grid->runs = NULL;
	grid->vertices = NULL;
	grid->run_count = grid->vertex_count = 0;
	if (!lists->whole)
		show_runs(grid);
}

/* Puts the triangles over hollows behind what lists are of, as far as there is room. */
static bool list_hollows(struct edge_grid *grid, uint32_t screen, struct edge_room room)
{
	struct edge_lists *lists = &grid->lists;
	size_t *capacity = grid->whole ? &lists->copy_capacity : &lists->texel_capacity;
	struct edge_texel **texels = grid->whole ? &lists->copies : &lists->texels;
	size_t left = (grid->whole ? room.copies : room.vertices) - grid->texel_count;
	size_t most =
		left / HOLLOW_TEXELS < EDGE_HOLLOWS_MAX ? left / HOLLOW_TEXELS : EDGE_HOLLOWS_MAX;
	struct edge_hollows *hollows = &grid->hollows;
	if (!edge_hollows_list(hollows, &grid->chains, screen, grid->tiles, most))
		return false;
	size_t count = grid->texel_count + HOLLOW_TEXELS * hollows->count;
	if (!array_reserve((void **)texels, capacity, count, sizeof(**texels)))
		return false;
	grid->texels = *texels;
	grid->hollow_base = grid->texel_count;
	grid->dropped += hollows->dropped;
	if (hollows->count == 0)
		return true;
	edge_hollows_write(hollows, &grid->chains, screen, *texels + grid->texel_count);
	grid->texel_count = count;
	for (size_t first = 0; first < hollows->count;) {
		struct edge_tile *tile = &grid->of[hollows->of[first].tile];
		size_t of_tile = edge_hollows_of_tile(hollows, first);
		tile->first |= (uint32_t)first << 17;
		tile->count_winding |= (uint32_t)of_tile << 17;
		first += of_tile;
	}
	return true;
}

bool edge_grid_look(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_grid_options *options)
{
	struct edge_raster raster = raster_of(options);
	return edge_keep_look(&grid->keep, scene, frame, &raster);
}

static bool find(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_grid_options *options)
{
	uint32_t screen = raster_of(options).screen;
	if ((!grid->keep.looked && !edge_grid_look(grid, scene, frame, options)) ||
		!edge_keep_find(&grid->keep, &grid->chains, &grid->depths, scene, frame) ||
		!make_lists(grid, frame, options, screen))
		return false;
	grid->tiles = grid->depths.tiles;
	size_t tiles = (size_t)grid->tiles * grid->tiles;
	if (!array_reserve((void **)&grid->of, &grid->tile_capacity, tiles, sizeof(*grid->of)) ||
		!array_reserve((void **)&grid->winding, &grid->winding_capacity, tiles,
			sizeof(*grid->winding)))
		return false;
	edge_winding_find(&grid->chains, screen, grid->tiles, grid->winding);
	size_t filled = fill_tiles(grid);
	show_lists(grid);
	grid->edge_count = grid->chains.edge_count;
	grid->dropped = grid->lists.dropped;
	grid->mean_list = filled == 0 ? 0.0f : (float)grid->lists.edge_count / (float)filled;
	return list_hollows(grid, screen, options->room);
}

bool edge_grid_find(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_grid_options *options)
{
	assert(options->tiles >= TILES_MIN && options->tiles <= EDGE_GRID_TILES_MAX &&
		(options->tiles & (options->tiles - 1)) == 0 && options->room.runs < 1 << 17 &&
		options->room.vertices < 1 << 17 && options->room.copies < 1 << 17);
	bool found = find(grid, scene, frame, options);
	if (!found)
		edge_grid_forget(grid);
	return found;
}

bool edge_grid_find_stretches(struct edge_grid *grid)
{
	if (grid->runs == NULL && !edge_lists_make_runs(&grid->lists, &grid->chains))
		return false;
	show_runs(grid);
	return true;
}

void edge_grid_forget(struct edge_grid *grid)
{
	edge_keep_forget(&grid->keep);
}

void edge_grid_finish(struct edge_grid *grid)
{
	edge_keep_finish(&grid->keep);
	edge_chains_finish(&grid->chains);
	tile_depths_finish(&grid->depths);
	edge_cover_finish(&grid->cover);
	edge_lists_finish(&grid->lists);
	edge_hollows_finish(&grid->hollows);
	free(grid->of);
	free(grid->winding);
	*grid = (struct edge_grid){0};
}

size_t edge_grid_bytes(const struct edge_grid *grid)
{
	return edge_keep_bytes(&grid->keep) + edge_chains_bytes(&grid->chains) +
	       tile_depths_bytes(&grid->depths) + edge_cover_bytes(&grid->cover) +
	       edge_lists_bytes(&grid->lists) + edge_hollows_bytes(&grid->hollows) +
	       grid->tile_capacity * sizeof(*grid->of) +
	       grid->winding_capacity * sizeof(*grid->winding);
}
