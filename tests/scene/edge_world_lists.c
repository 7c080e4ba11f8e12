/* SPDX-License-Identifier: MIT */
#include "edge_world.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The vertices of a run are within its box where they are on the screen. */
static void assert_box_holds(const struct edge_run *run, const struct edge_stretch *stretch)
{
	assert_in_range(stretch->edges, 1, EDGE_RUN_MAX);
	for (uint32_t i = 0; i <= stretch->edges; i++) {
		const float at[2] = {stretch->vertices[i].x, stretch->vertices[i].y};
		for (int axis = 0; axis < 2; axis++) {
			float steps = fminf(fmaxf(at[axis], 0.0f), 1.0f) * EDGE_BOX_STEPS;
			assert_true(steps >= (float)run->min[axis] &&
				    steps <= (float)run->max[axis] + 1.0f);
		}
	}
}

/* No vertex is nearer than the list says. */
static void assert_start_holds(
	const struct edge_stretch *stretch, float start, const char *what, uint32_t t)
{
	for (uint32_t i = 0; i <= stretch->edges; i++) {
		const struct edge_vertex *at = &stretch->vertices[i];
		assert_true(isfinite(at->x) && isfinite(at->y) && isfinite(at->depth));
		if (!(at->depth >= start))
			fail_msg("%s: tile %u: depth %g, start %g", what, t, (double)at->depth,
				(double)start);
	}
}

static struct edge_texel texel_of(const struct edge_vertex *edge)
{
	uint32_t sheets = edge[1].sheets > 0.0f ? (uint32_t)edge[1].sheets : CHAIN_GRAZING;
	const struct chain_point points[2] = {
		{(int32_t)(edge[0].x * SCREEN), (int32_t)(edge[0].y * SCREEN), edge[0].depth,
			sheets},
		{(int32_t)(edge[1].x * SCREEN), (int32_t)(edge[1].y * SCREEN), edge[1].depth, 0},
	};
	return edge_texel_of(points, SCREEN);
}

static bool same_texel(const struct edge_texel *a, const struct edge_texel *b)
{
	return memcmp(a, b, sizeof(*a)) == 0;
}

/* A whole list has the edges of the tile's runs, the nearest first. */
static void assert_whole_list(const struct edge_grid *grid, const struct edge_tile *tile)
{
	const struct edge_texel *list = &grid->texels[edge_tile_first(tile)];
	uint32_t count = edge_tile_count(tile), edges = 0;
	for (uint32_t k = 1; k < count; k++)
		assert_true(edge_texel_nearest(&list[k - 1]) <= edge_texel_nearest(&list[k]));
	for (uint32_t i = 0; i < edge_tile_stretches(grid, tile); i++) {
		struct edge_stretch stretch = edge_tile_stretch(grid, tile, i);
		for (uint32_t k = 0; k < stretch.edges; k++, edges++) {
			struct edge_texel wanted = texel_of(&stretch.vertices[k]);
			uint32_t place = 0;
			while (place < count && !same_texel(&list[place], &wanted))
				place++;
			assert_true(place < count);
		}
	}
	assert_int_equal(edges, count);
}

/* Runs are of the edges between their vertices. */
static void assert_run_texels(const struct edge_grid *grid, const struct edge_run *run)
{
	uint32_t first = edge_run_first(run);
	assert_true(first + edge_run_count(run) < grid->texel_count);
	for (uint32_t k = 0; k < edge_run_count(run); k++) {
		struct edge_texel wanted = texel_of(&grid->vertices[first + k]);
		assert_true(same_texel(&grid->texels[first + k], &wanted));
	}
}

void assert_lists_are_in_order(const struct world *world, const char *what)
{
	const struct edge_grid *grid = &world->grid;
	size_t sum = 0;
	for (uint32_t t = 0; t < grid->tiles * grid->tiles; t++) {
		const struct edge_tile *tile = &grid->of[t];
		float nearest = tile->nearest;
		assert_int_equal(edge_tile_count(tile) == 0, nearest == 2.0f);
		assert_true(edge_tile_count(tile) == 0 || edge_tile_first(tile) == sum);
		sum += edge_tile_count(tile);
		assert_true(sum <= (grid->whole ? grid->texel_count : grid->run_count));
		for (uint32_t i = 0; i < edge_tile_stretches(grid, tile); i++) {
			struct edge_stretch stretch = edge_tile_stretch(grid, tile, i);
			const struct edge_run *run = &grid->runs[grid->lists.first[t] + i];
			assert_true(stretch.vertices + stretch.edges <
				    grid->vertices + grid->vertex_count);
			assert_true(run->start >= nearest);
			nearest = run->start;
			assert_box_holds(run, &stretch);
			assert_start_holds(&stretch, nearest, what, t);
			if (!grid->whole)
				assert_run_texels(grid, run);
		}
		if (grid->whole)
			assert_whole_list(grid, tile);
	}
	assert_int_equal(sum, grid->whole ? grid->hollow_base : grid->run_count);
}

static struct edge_vertex vertex_of(const struct chain_point *point)
{
	return (struct edge_vertex){
		(float)point->x / SCREEN, (float)point->y / SCREEN, point->depth, 0.0f};
}

static bool same_place(const struct edge_vertex *a, const struct edge_vertex *b)
{
	return a->x == b->x && a->y == b->y && a->depth == b->depth;
}

/* How often a tile lists an edge. */
static int times_listed(const struct edge_grid *grid, uint32_t t, const struct chain_point *edge)
{
	struct edge_vertex a = vertex_of(&edge[0]), b = vertex_of(&edge[1]);
	int times = 0;
	for (uint32_t i = 0; i < edge_tile_stretches(grid, &grid->of[t]); i++) {
		struct edge_stretch stretch = edge_tile_stretch(grid, &grid->of[t], i);
		for (uint32_t k = 0; k < stretch.edges; k++) {
			const struct edge_vertex *at = &stretch.vertices[k];
			times += same_place(&at[0], &a) && same_place(&at[1], &b);
		}
	}
	return times;
}

/* A point that is lit or not. */
struct receiver {
	double x, y, depth;
	uint32_t tile;
};

static double scale_of(const struct world *world)
{
	return (double)disc_scale(&world->frame);
}

/* Whether what is at x, y, depth stands before the light's disc, which faces the receiver. */
static bool is_before_disc(const struct world *world, const struct receiver *receiver, double x,
	double y, double depth)
{
	const struct light_frame *frame = &world->frame;
	double vx = x - receiver->x, vy = y - receiver->y, before = receiver->depth - depth;
	if (!frame->parallel) {
		double half = (double)frame->half_extent;
		double ex = (2.0 * receiver->x - 1.0) * half, ey = (2.0 * receiver->y - 1.0) * half;
		double e2 = ex * ex + ey * ey, along = ex * vx + ey * vy;
		double k = 1.0 / (1.0 + e2 + sqrt(1.0 + e2));
		before -= 2.0 * half * ((double)frame->pole - receiver->depth) / (1.0 + e2) * along;
		vx -= ex * along * k;
		vy -= ey * along * k;
	}
	return before > 0.0 && hypot(vx, vy) <= scale_of(world) * before;
}

/* Whether x, y is within 1.5 texels of the map from the tile. */
static bool touches_tile(const struct edge_grid *grid, uint32_t t, double x, double y)
{
	double left = t % grid->tiles, bottom = t / grid->tiles;
	double dx = fmax(fmax(left - x * grid->tiles, x * grid->tiles - left - 1.0), 0.0);
	double dy = fmax(fmax(bottom - y * grid->tiles, y * grid->tiles - bottom - 1.0), 0.0);
	return hypot(dx, dy) <= 1.5 / MAP_SIZE * grid->tiles;
}

/* Whether the edge is any of the receiver's concern, at one of many of its points. */
static bool concerns(
	const struct world *world, const struct receiver *receiver, const struct chain_point *edge)
{
	struct edge_vertex a = vertex_of(&edge[0]), b = vertex_of(&edge[1]);
	for (int i = 0; i <= 64; i++) {
		double share = i / 64.0;
		double x = a.x + share * ((double)b.x - a.x), y = a.y + share * ((double)b.y - a.y);
		double depth = a.depth + share * ((double)b.depth - a.depth);
		if (is_before_disc(world, receiver, x, y, depth) ||
			touches_tile(&world->grid, receiver->tile, x, y))
			return true;
	}
	return false;
}

/* Whether a receiver is farther from a spot, along its axis, than four thirds of its radius. */
static bool is_off_the_light(const struct world *world, double depth)
{
	const struct light_frame *frame = &world->frame;
	return frame->parallel ||
	       2.0 * (double)frame->half_extent * scale_of(world) * ((double)frame->pole - depth) <
		       0.75;
}

/* A random point of a triangle; false if it is not on the screen, or too near to a spot. */
static bool pick_receiver(const struct world *world, const struct object *object, size_t triangle,
	uint64_t *random, struct receiver *receiver)
{
	const struct mesh *mesh = &world->stage.scene->meshes[object->mesh];
	double u = 0.5 + 0.5 * (double)random_signed(random);
	double v = (1.0 - u) * (0.5 + 0.5 * (double)random_signed(random));
	float point[3];
	for (int axis = 0; axis < 3; axis++) {
		double p[3];
		for (size_t k = 0; k < 3; k++)
			p[k] = (double)mesh->positions[mesh->indices[3 * triangle + k]][axis];
		point[axis] = (float)(p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]));
	}
	mat4 to_clip;
	double clip[4];
	world_to_clip_of(world, object, to_clip);
	world_project(to_clip, point, clip);
	if (!(clip[2] > -clip[3]))
		return false;
	uint32_t tiles = world->grid.tiles;
	receiver->x = 0.5 + 0.5 * clip[0] / clip[3];
	receiver->y = 0.5 + 0.5 * clip[1] / clip[3];
	receiver->depth = 0.5 + 0.5 * clip[2] / clip[3];
	if (!(receiver->x > 0.0 && receiver->x < 1.0 && receiver->y > 0.0 && receiver->y < 1.0))
		return false;
	receiver->tile = (uint32_t)(receiver->y * tiles) * tiles + (uint32_t)(receiver->x * tiles);
	return is_off_the_light(world, receiver->depth);
}

/* Whether the receiver is on the nearer side of the triangle's plane. */
static bool is_before_plane(const struct receiver *receiver, const struct edge_vertex corners[3])
{
	const struct edge_vertex *a = &corners[0], *b = &corners[1], *c = &corners[2];
	double ux = (double)b->x - a->x, uy = (double)b->y - a->y;
	double vx = (double)c->x - a->x, vy = (double)c->y - a->y;
	double uz = (double)b->depth - a->depth, vz = (double)c->depth - a->depth;
	double x = receiver->x - a->x, y = receiver->y - a->y;
	double over = x * (uz * vy - uy * vz) + y * (ux * vz - uz * vx);
	return receiver->depth < a->depth + over / (ux * vy - uy * vx);
}

/* Grazing triangles are listed whole, and only before receivers where they count. Returns how many
 * the receiver's tile has. */
static int count_grazing(
	const struct world *world, const struct receiver *receiver, const char *what)
{
	const struct edge_grid *grid = &world->grid;
	int edges = 0;
	for (uint32_t i = 0; i < edge_tile_stretches(grid, &grid->of[receiver->tile]); i++) {
		struct edge_stretch stretch = edge_tile_stretch(grid, &grid->of[receiver->tile], i);
		for (uint32_t k = 1; k <= stretch.edges; k++) {
			const struct edge_vertex *at = &stretch.vertices[k];
			edges += at->sheets == 0.0f;
			bool whole = k >= 3 && at->sheets == 0.0f && at[-1].sheets == 0.0f &&
				     at[-2].sheets == 0.0f && same_place(at, at - 3);
			if (whole && !is_before_plane(receiver, at - 2))
				fail_msg("%s: (%g, %g, %g) is behind a triangle", what, receiver->x,
					receiver->y, receiver->depth);
		}
	}
	assert_int_equal(edges % 3, 0);
	return edges / 3;
}

static void assert_lists_all(
	const struct world *world, const struct receiver *receiver, const char *what)
{
	const struct edge_chains *chains = &world->grid.chains;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (edge->sheets == 0 || chain_is_grazing(edge) || !concerns(world, receiver, edge))
			continue;
		if (times_listed(&world->grid, receiver->tile, edge) == 0)
			fail_msg("%s: edge %zu concerns (%g, %g, %g) and is not listed in tile %u",
				what, i, receiver->x, receiver->y, receiver->depth, receiver->tile);
	}
}

/* Receivers that are asked. */
#define RECEIVERS 120

void assert_receivers_find_their_edges(const struct world *world, const char *what)
{
	const struct sm_scene *scene = world->stage.scene;
	uint64_t random = 7;
	int asked = 0;
	for (int i = 0; i < 40 * RECEIVERS && asked < RECEIVERS; i++) {
		const struct object *object =
			&scene->objects[random_next(&random) % scene->object_count];
		size_t triangles = scene->meshes[object->mesh].index_count / 3;
		struct receiver receiver;
		if (!object->receives ||
			!pick_receiver(world, object, random_next(&random) % triangles, &random,
				&receiver))
			continue;
		asked++;
		assert_lists_all(world, &receiver, what);
		count_grazing(world, &receiver, what);
		/* None is deeper than its tile's deepest. */
		assert_true(
			world->grid.depths.deepest[receiver.tile] >= (float)receiver.depth - 1e-5f);
	}
	assert_int_equal(asked, RECEIVERS);
}

/* A point of a sheet is not behind its tile's farthest caster. */
static void assert_sheets_are_not_behind_farthest(const struct world *world, const char *what)
{
	const struct edge_grid *grid = &world->grid;
	for (size_t i = 0; i < grid->chains.count; i++) {
		const struct chain_point *point = &grid->chains.points[i];
		struct edge_vertex at = vertex_of(point);
		/* What shows the light its back is no sheet. */
		if (chain_is_grazing(point) || (i > 0 && chain_is_grazing(point - 1)))
			continue;
		if (!(at.x >= 0.0f && at.x < 1.0f && at.y >= 0.0f && at.y < 1.0f))
			continue;
		uint32_t t = (uint32_t)(at.y * (float)grid->tiles) * grid->tiles +
			     (uint32_t)(at.x * (float)grid->tiles);
		if (at.depth > grid->of[t].farthest + 1e-5f)
			fail_msg("%s: tile %u: %g is behind %g", what, t, (double)at.depth,
				(double)grid->of[t].farthest);
	}
}

void assert_grid(const struct world *world, const char *what)
{
	assert_int_equal(world->grid.dropped, 0);
	assert_winding_counts_sheets(world, what);
	assert_lists_are_in_order(world, what);
	assert_sheets_are_not_behind_farthest(world, what);
	assert_receivers_find_their_edges(world, what);
}
