/* SPDX-License-Identifier: MIT */
#include "scene/edge_grid.h"
#include "base/array.h"
#include <stdlib.h>

/* Of a tile's list, beyond the tile: texels of the map. */
#define MARGIN_TEXELS 1.5f

/* A tile and what is around it: window coordinates. */
struct tile_span {
	float min[2], max[2];
	float deepest;  /* of receivers; below 0: none */
	float farthest; /* of casters; 0: none */
};

/* What an object's box covers of the screen, and how deep. */
struct extent {
	float min[2], max[2];
	float deepest;
};

static void object_extent(
	struct extent *extent, const struct object *object, const struct light_frame *frame)
{
	*extent = (struct extent){{2.0f, 2.0f}, {-1.0f, -1.0f}, -1.0f};
	for (int i = 0; i < 8; i++) {
		vec4 clip, p = {i & 1 ? object->max[0] : object->min[0],
				   i & 2 ? object->max[1] : object->min[1],
				   i & 4 ? object->max[2] : object->min[2], 1.0f};
		glm_mat4_mulv((vec4 *)frame->world_to_clip, p, clip);
		if (clip[3] < frame->near * 0.5f && !frame->parallel) {
			*extent = (struct extent){{-1.0f, -1.0f}, {2.0f, 2.0f}, 1.0f};
			return;
		}
		for (int axis = 0; axis < 2; axis++) {
			float x = 0.5f + 0.5f * clip[axis] / clip[3];
			extent->min[axis] = fminf(extent->min[axis], x);
			extent->max[axis] = fmaxf(extent->max[axis], x);
		}
		extent->deepest = fmaxf(extent->deepest, 0.5f + 0.5f * clip[2] / clip[3]);
	}
}

static bool touches(const struct extent *extent, const struct tile_span *span, float margin)
{
	for (int axis = 0; axis < 2; axis++)
		if (extent->max[axis] < span->min[axis] - margin ||
			extent->min[axis] > span->max[axis] + margin)
			return false;
	return true;
}

/* Least distance from a segment to the tile's box, or less. */
static float distance_below(const struct tile_span *span, const float a[2], const float b[2])
{
	float center[2], half[2], along[2] = {b[0] - a[0], b[1] - a[1]};
	float length2 = along[0] * along[0] + along[1] * along[1], t = 0.0f;
	for (int axis = 0; axis < 2; axis++) {
		center[axis] = 0.5f * (span->min[axis] + span->max[axis]);
		half[axis] = span->max[axis] - center[axis];
		t += (center[axis] - a[axis]) * along[axis];
	}
	t = length2 > 0.0f ? fmaxf(0.0f, fminf(t / length2, 1.0f)) : 0.0f;
	float away = hypotf(a[0] + t * along[0] - center[0], a[1] + t * along[1] - center[1]);
	return away - hypotf(half[0], half[1]);
}

/* What a search goes through. */
struct search {
	struct edge_grid *grid;
	const struct sm_scene *scene;
	const struct light_frame *frame;
	const struct edge_grid_options *options;
	float step;   /* of the raster grid */
	float margin; /* window coordinates */
	float reach;  /* of a penumbra, for each unit of depth */
};

static struct tile_span tile_span_of(const struct search *search, uint32_t x, uint32_t y)
{
	float size = 1.0f / (float)search->grid->tiles;
	struct tile_span span = {.min = {(float)x * size, (float)y * size},
		.max = {((float)x + 1.0f) * size, ((float)y + 1.0f) * size},
		.deepest = -1.0f};
	for (size_t i = 0; i < search->scene->object_count; i++) {
		const struct object *object = &search->scene->objects[i];
		struct extent extent;
		object_extent(&extent, object, search->frame);
		if (!touches(&extent, &span, search->margin))
			continue;
		if (object->receives)
			span.deepest = fmaxf(span.deepest, extent.deepest);
		if (object->casts)
			span.farthest = fmaxf(span.farthest, extent.deepest);
	}
	return span;
}

static bool lists(
	const struct search *search, const struct tile_span *span, const struct chain_point *edge)
{
	float a[2] = {(float)edge[0].x * search->step, (float)edge[0].y * search->step};
	float b[2] = {(float)edge[1].x * search->step, (float)edge[1].y * search->step};
	if (span->deepest < 0.0f)
		return false;
	float nearest = fminf(edge[0].depth, edge[1].depth);
	float reach = fmaxf(search->margin, search->reach * (span->deepest - nearest));
	return distance_below(span, a, b) <= reach;
}

/* Of the edges from the center to the right. A vertex at its height counts as above. */
static int winding(const struct search *search, const struct tile_span *span)
{
	const struct edge_chains *chains = &search->grid->chains;
	double scale = (double)search->step;
	double x = 0.5 * ((double)span->min[0] + span->max[0]) / scale;
	double y = 0.5 * ((double)span->min[1] + span->max[1]) / scale;
	int sum = 0;
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *a = &chains->points[i], *b = a + 1;
		if (a->ends || (a->y >= y) == (b->y >= y))
			continue;
		double side = (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
		if (b->y > a->y ? side > 0.0 : side < 0.0)
			sum += b->y > a->y ? 1 : -1;
	}
	return sum < -128 ? -128 : sum > 127 ? 127 : sum;
}

static void append(const struct search *search, const struct chain_point *point, float start)
{
	search->grid->vertices[search->grid->vertex_count++] =
		(struct chain_vertex){(float)point->x * search->step,
			(float)point->y * search->step, point->depth, start};
}

/* Chains as they come: each start says what holds for the whole list. */
static void list_tile(struct search *search, uint32_t x, uint32_t y, size_t *listed)
{
	struct edge_grid *grid = search->grid;
	const struct edge_chains *chains = &grid->chains;
	struct edge_tile *tile = &grid->of[y * grid->tiles + x];
	struct tile_span span = tile_span_of(search, x, y);
	bool follows = false;
	*tile = (struct edge_tile){(uint32_t)grid->vertex_count, 0, 2.0f, span.farthest};
	for (size_t i = 0; i + 1 < chains->count; i++) {
		const struct chain_point *edge = &chains->points[i];
		if (edge->ends || !lists(search, &span, edge)) {
			follows = false;
			continue;
		}
		if (grid->vertex_count + 2 > search->options->vertices_max) {
			grid->dropped++;
			continue;
		}
		if (!follows)
			append(search, edge, 1.0f);
		append(search, edge + 1, 0.0f);
		tile->nearest = fminf(tile->nearest, fminf(edge[0].depth, edge[1].depth));
		follows = true;
		++*listed;
	}
	uint32_t count = (uint32_t)grid->vertex_count - tile->first;
	tile->count_winding = count | (uint32_t)(128 + winding(search, &span)) << 24;
}

bool edge_grid_find(struct edge_grid *grid, const struct sm_scene *scene,
	const struct light_frame *frame, const struct edge_grid_options *options)
{
	uint32_t screen = options->map_size << options->subpixel_bits;
	float corner = frame->parallel ? 0.0f : 2.0f * frame->half_extent * frame->half_extent;
	struct search search = {grid, scene, frame, options, 1.0f / (float)screen,
		MARGIN_TEXELS / (float)options->map_size, disc_scale(frame) * sqrtf(1.0f + corner)};
	grid->tiles = options->tiles;
	grid->vertex_count = 0;
	grid->dropped = 0;
	if (!edge_chains_find(&grid->chains, scene, frame, screen) ||
		!array_reserve((void **)&grid->of, &grid->tile_capacity,
			(size_t)grid->tiles * grid->tiles, sizeof(*grid->of)) ||
		!array_reserve((void **)&grid->vertices, &grid->vertex_capacity,
			options->vertices_max, sizeof(*grid->vertices)))
		return false;
	grid->edge_count = grid->chains.edge_count;
	size_t listed = 0, lists = 0;
	for (uint32_t i = 0; i < grid->tiles * grid->tiles; i++) {
		list_tile(&search, i % grid->tiles, i / grid->tiles, &listed);
		lists += edge_tile_count(&grid->of[i]) != 0;
	}
	grid->mean_list = lists == 0 ? 0.0f : (float)listed / (float)lists;
	return true;
}

void edge_grid_finish(struct edge_grid *grid)
{
	edge_chains_finish(&grid->chains);
	free(grid->of);
	free(grid->vertices);
	*grid = (struct edge_grid){0};
}

size_t edge_grid_bytes(const struct edge_grid *grid)
{
	return edge_chains_bytes(&grid->chains) + grid->tile_capacity * sizeof(*grid->of) +
	       grid->vertex_capacity * sizeof(*grid->vertices);
}
