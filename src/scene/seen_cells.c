/* SPDX-License-Identifier: MIT */
#include "scene/seen_cells.h"
#include <stdlib.h>

/* Share of what is added up for a coordinate that it may be rounded by. */
#define ROUNDING 1e-5f

/* What is seen of an object, on the light's screen. More points than these are marked as all. */
#define POINTS_MAX 1024

struct outline {
	struct screen_point points[POINTS_MAX];
	int count;
	float slack; /* NDC, that points may be off by */
};

/* In clip space. False: there is no room, or no such place. */
static bool add_point(struct outline *outline, const float p[4], float size)
{
	struct screen_point point = {p[0] / p[3], p[1] / p[3]};
	/* false for NaN too */
	if (outline->count == POINTS_MAX ||
		!(fabsf(point.x) < INFINITY && fabsf(point.y) < INFINITY))
		return false;
	float most = 1.0f + fmaxf(fabsf(point.x), fabsf(point.y));
	outline->slack = fmaxf(outline->slack, ROUNDING * size * most / p[3]);
	outline->points[outline->count++] = point;
	return true;
}

/* Where the hull of points is cut by a plane w = least, a bound: the ways between points on either
 * side of it cross it there. */
static bool add_crossings(
	struct outline *outline, const vec4 *clip, int count, float least, float size)
{
	for (int i = 0; i < count; i++)
		for (int j = 0; j < count && clip[i][3] < least; j++) {
			vec4 p;
			if (!(clip[j][3] > least))
				continue;
			/* w differs, so that the divisor is not 0. */
			glm_vec4_lerp((float *)clip[i], (float *)clip[j],
				(least - clip[i][3]) / (clip[j][3] - clip[i][3]), p);
			p[3] = least;
			if (!add_point(outline, p, size))
				return false;
		}
	return true;
}

/* The points of a part of space that is beyond half of the near plane's distance: before the near
 * plane everything is lit. */
static bool find_outline(
	struct outline *outline, const struct light_frame *frame, const vec3 *part, int count)
{
	vec4 clip[VIEW_PART_CORNERS_MAX];
	float least = frame->parallel ? 0.0f : 0.5f * frame->near, size = 0.0f;
	outline->count = 0;
	outline->slack = 0.0f;
	for (int i = 0; i < count; i++) {
		glm_mat4_mulv((vec4 *)frame->world_to_clip,
			(vec4){part[i][0], part[i][1], part[i][2], 1.0f}, clip[i]);
		for (int row = 0; row < 4; row++) {
			float sum = fabsf(frame->world_to_clip[3][row]);
			for (int axis = 0; axis < 3; axis++)
				sum += fabsf(frame->world_to_clip[axis][row] * part[i][axis]);
			/* Of depth nothing is asked. */
			size = row == 2 ? size : fmaxf(size, sum);
		}
	}
	for (int i = 0; i < count; i++)
		/* The others, and NaN, which is none of them. */
		if (!(clip[i][3] < least) && !add_point(outline, clip[i], size))
			return false;
	return add_crossings(outline, clip, count, least, size);
}

static int compare_points(const void *a, const void *b)
{
	const struct screen_point *p = a, *q = b;
	if (p->x != q->x)
		return p->x < q->x ? -1 : 1;
	return (p->y > q->y) - (p->y < q->y);
}

/* Whether the way from a over b to c turns to the left. */
static bool turns_left(
	const struct screen_point *a, const struct screen_point *b, const struct screen_point *c)
{
	return (double)(b->x - a->x) * (double)(c->y - a->y) -
		       (double)(b->y - a->y) * (double)(c->x - a->x) >
	       0.0;
}

/* Adds a chain of the hull of sorted points, `step` of them at a time (Andrew 1979). */
static int find_chain(
	const struct screen_point *points, int count, int step, struct screen_point *chain)
{
	int kept = 0;
	for (int i = 0; i < count; i++) {
		while (kept >= 2 && !turns_left(&chain[kept - 2], &chain[kept - 1], points))
			kept--;
		chain[kept++] = *points;
		points += step;
	}
	return kept;
}

/* Marks a convex polygon's hull, triangle by triangle about its first corner. */
static void mark_fan(
	struct screen_grid *cells, const struct screen_point *corners, int count, float slack)
{
	static const uint8_t sides[3][2] = {{0, 1}, {1, 2}, {2, 0}};
	int last = count - 1;
	for (int i = 1; i == 1 || i < last; i++) {
		const struct screen_point triangle[3] = {
			corners[0], corners[i < last ? i : last], corners[i < last ? i + 1 : last]};
		screen_grid_add(cells, triangle, sides, 3, slack);
	}
}

static void mark_outline(struct screen_grid *cells, struct outline *outline, float margin)
{
	struct screen_point chain[POINTS_MAX];
	float slack = (margin + outline->slack) * (0.5f * SCREEN_GRID_SIZE);
	int count = outline->count;
	if (count == 0)
		return;
	qsort(outline->points, (size_t)count, sizeof(*outline->points), compare_points);
	/* Below and above the way from the first to the last: each hull holds that. */
	mark_fan(cells, chain, find_chain(outline->points, count, 1, chain), slack);
	mark_fan(cells, chain, find_chain(outline->points + count - 1, count, -1, chain), slack);
}

void seen_cells_find(struct screen_grid *cells, const struct sm_scene *scene,
	const struct light_frame *frame, const struct view_volume *volume, float margin)
{
	screen_grid_clear(cells);
	for (size_t i = 0; i < scene->object_count; i++) {
		vec3 part[VIEW_PART_CORNERS_MAX];
		struct outline outline;
		if (!scene->objects[i].receives)
			continue;
		int count = view_volume_cut(volume, &scene->objects[i], part);
		if (find_outline(&outline, frame, (const vec3 *)part, count)) {
			mark_outline(cells, &outline, margin);
		} else {
			screen_grid_fill(cells);
			return;
		}
	}
}
