/* SPDX-License-Identifier: MIT */
#include "geom/lit_triangles.h"
#include "base/array.h"
#include "base/float_range.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OBJECT_OF_FINS UINT32_MAX

/* That take as long as to look closer once, and as to ask for a triangle at all. */
#define CLOSE_VISITS 30
#define TRIANGLE_VISITS 100

/* Members for each shape, and beyond that, from which on cells are made larger. */
#define MEMBERS_A_SHAPE 4
#define MEMBERS_BEYOND 65536

/* NDC depth: of 24-bit depths a step, by which neighbours in a plane may seem to be in front of one
 * another. A map's bias is sixteen. */
#define FLAT (2.0 / 16777216.0)

/* Of the light's depth range: surfaces that are nearer to each other than this as good as touch. */
#define GAP (1.0 / 2048.0)

/* NDC, x or y: what is no farther beside a triangle without sharing a corner may be drawn over a
 * pixel of it, as floats round. */
#define BESIDE (1.0 / 65536.0)

/* A triangle has three, and each of three cuts doubles them at most, whatever rounds. */
#define CORNERS_MAX 24

struct lit_shape {
	uint32_t vertices[3], object;
	float min[2], max[2];      /* NDC */
	float near, far;           /* NDC depth that no part of it is before, or beyond */
	uint8_t first[2], last[2]; /* cells, of LIT_CELLS_MAX a side */
};
_Static_assert(LIT_CELLS_MAX <= UINT8_MAX + 1, "cells are counted in bytes");

struct lit_place {
	float near; /* of a shape */
	uint32_t shape;
};

/* NDC depth over a screen: z = x[0] x + x[1] y + at. */
struct plane {
	double x[2], at;
};

/* The triangle that is asked for. */
struct receiver {
	uint32_t object;
	double clip[3][4], points[3][3];
	struct plane plane;
	double slope; /* along x and y together */
	double min[2], max[2];
	double gap;   /* NDC depth */
	double clear; /* NDC depth, from which on nothing can matter */
	double touch; /* NDC depth, before which nothing can touch it */
	bool averted; /* no light arrives, whatever is in front */
	size_t visits;
	const struct lit_shape *self;
};

void lit_search_finish(struct lit_search *search)
{
	free(search->vertices);
	free(search->shapes);
	free(search->starts);
	free(search->sorted);
	free(search->members);
	*search = (struct lit_search){0};
}

size_t lit_search_bytes(const struct lit_search *search)
{
	return search->vertex_capacity * sizeof(*search->vertices) +
	       search->shape_capacity * sizeof(*search->shapes) +
	       search->start_capacity * sizeof(*search->starts) +
	       search->sorted_capacity * sizeof(*search->sorted) +
	       search->member_capacity * sizeof(*search->members);
}

void lit_search_clear(struct lit_search *search)
{
	search->vertex_count = search->shape_count = 0;
}

static bool reserve(struct lit_search *search, size_t vertices, size_t shapes)
{
	vertices += search->vertex_count;
	shapes += search->shape_count;
	return vertices < UINT32_MAX && shapes < UINT32_MAX &&
	       array_reserve((void **)&search->vertices, &search->vertex_capacity, vertices,
		       sizeof(*search->vertices)) &&
	       array_reserve((void **)&search->shapes, &search->shape_capacity, shapes,
		       sizeof(*search->shapes));
}

/* The same for equal positions, to the bit. */
static void transform(const float to_clip[4][4], const float position[3], double clip[4])
{
	for (int row = 0; row < 4; row++) {
		clip[row] = to_clip[3][row];
		for (int axis = 0; axis < 3; axis++)
			clip[row] += (double)to_clip[axis][row] * position[axis];
	}
}

/* Adds a vertex to what the shape is over; false where that has no end, or is behind the eye. */
static bool add_vertex(struct lit_shape *shape, const double v[4])
{
	bool finite = v[3] > 0.0;
	for (int axis = 0; axis < 2 && v[3] > 0.0; axis++) {
		float at = (float)(v[axis] / v[3]);
		shape->min[axis] = smaller(at, shape->min[axis]);
		shape->max[axis] = larger(at, shape->max[axis]);
		finite = finite && isfinite(at);
	}
	if (finite) {
		float depth = (float)(v[2] / v[3]);
		shape->near = smaller(depth, shape->near);
		shape->far = larger(depth, shape->far);
	}
	return finite;
}

/* What is behind the eye as a whole is nowhere. */
static void add_shape(struct lit_search *search, const uint32_t vertices[3], uint32_t object)
{
	struct lit_shape shape = {.object = object,
		.min = {INFINITY, INFINITY},
		.max = {-INFINITY, -INFINITY},
		.near = INFINITY,
		.far = -INFINITY};
	int behind = 0;
	bool finite = true;
	for (int i = 0; i < 3; i++) {
		const double *v = search->vertices[vertices[i]];
		shape.vertices[i] = vertices[i];
		behind += v[3] <= 0.0;
		finite = add_vertex(&shape, v) && finite;
	}
	if (behind == 3)
		return;
	if (!finite) {
		shape.min[0] = shape.min[1] = shape.near = -INFINITY;
		shape.max[0] = shape.max[1] = shape.far = INFINITY;
	}
	search->shapes[search->shape_count++] = shape;
}

bool lit_search_add(struct lit_search *search, uint32_t object, const float (*positions)[3],
	size_t vertex_count, const uint32_t *indices, size_t index_count, const float to_clip[4][4])
{
	size_t first = search->vertex_count;
	if (!reserve(search, vertex_count, index_count / 3))
		return false;
	for (size_t i = 0; i < vertex_count; i++)
		transform(to_clip, positions[i], search->vertices[first + i]);
	search->vertex_count += vertex_count;
	for (size_t i = 0; i < index_count; i += 3) {
		uint32_t vertices[3];
		for (size_t corner = 0; corner < 3; corner++)
			vertices[corner] = (uint32_t)first + indices[i + corner];
		add_shape(search, vertices, object);
	}
	return true;
}

bool lit_search_add_fin(struct lit_search *search, const float corners[4][3])
{
	uint32_t first = (uint32_t)search->vertex_count;
	if (!reserve(search, 4, 2))
		return false;
	for (int i = 0; i < 4; i++) {
		double *v = search->vertices[search->vertex_count++];
		for (int axis = 0; axis < 3; axis++)
			v[axis] = corners[i][axis];
		v[3] = 1.0;
	}
	add_shape(search, (uint32_t[]){first, first + 1, first + 2}, OBJECT_OF_FINS);
	add_shape(search, (uint32_t[]){first, first + 2, first + 3}, OBJECT_OF_FINS);
	return true;
}

struct cells {
	int first[2], last[2];
};

/* Of LIT_CELLS_MAX a side. What is beside the screen is in the cells along its border. */
static int cell_at(double ndc)
{
	double cell = (0.5 * ndc + 0.5) * LIT_CELLS_MAX;
	return cell > 0.0 ? (int)smaller_double(cell, LIT_CELLS_MAX - 1.0) : 0;
}

/* The cells that a shape is in, LIT_CELLS_MAX >> shift of them a side. */
static struct cells shape_cells(const struct lit_shape *shape, int shift)
{
	return (struct cells){{shape->first[0] >> shift, shape->first[1] >> shift},
		{shape->last[0] >> shift, shape->last[1] >> shift}};
}

static void find_shape_cells(struct lit_search *search)
{
	for (size_t i = 0; i < search->shape_count; i++) {
		struct lit_shape *shape = &search->shapes[i];
		for (int axis = 0; axis < 2; axis++) {
			shape->first[axis] = (uint8_t)cell_at(shape->min[axis]);
			shape->last[axis] = (uint8_t)cell_at(shape->max[axis]);
		}
	}
}

static size_t count_members(const struct lit_search *search, int shift)
{
	size_t count = 0;
	for (size_t i = 0; i < search->shape_count; i++) {
		struct cells cells = shape_cells(&search->shapes[i], shift);
		count += (size_t)(cells.last[0] - cells.first[0] + 1) *
			 (size_t)(cells.last[1] - cells.first[1] + 1);
	}
	return count;
}

/* Returns how many members there are. */
static size_t choose_cells(struct lit_search *search)
{
	size_t most = MEMBERS_A_SHAPE * search->shape_count + MEMBERS_BEYOND, count;
	search->shift = 0;
	while ((count = count_members(search, search->shift)) > most)
		search->shift++;
	return count;
}

static int cells_a_side(const struct lit_search *search)
{
	return LIT_CELLS_MAX >> search->shift;
}

/* Counts each cell's, and has starts lead to where they end. */
static void find_ends(struct lit_search *search, size_t cell_count)
{
	memset(search->starts, 0, (cell_count + 1) * sizeof(*search->starts));
	for (size_t i = 0; i < search->shape_count; i++) {
		struct cells cells = shape_cells(&search->shapes[i], search->shift);
		for (int y = cells.first[1]; y <= cells.last[1]; y++)
			for (int x = cells.first[0]; x <= cells.last[0]; x++)
				search->starts[y * cells_a_side(search) + x]++;
	}
	for (size_t i = 1; i <= cell_count; i++)
		search->starts[i] += search->starts[i - 1];
}

/* From each cell's end down to its start. */
static void write_members(struct lit_search *search)
{
	for (size_t i = search->shape_count; i-- > 0;) {
		struct lit_place place = {search->shapes[i].near, (uint32_t)i};
		struct cells cells = shape_cells(&search->shapes[i], search->shift);
		for (int y = cells.first[1]; y <= cells.last[1]; y++)
			for (int x = cells.first[0]; x <= cells.last[0]; x++)
				search->members[--search->starts[y * cells_a_side(search) + x]] =
					place;
	}
}

bool lit_search_sort(struct lit_search *search)
{
	find_shape_cells(search);
	size_t count = choose_cells(search);
	size_t cell_count = (size_t)cells_a_side(search) * (size_t)cells_a_side(search);
	if (count >= UINT32_MAX ||
		!array_reserve((void **)&search->starts, &search->start_capacity, cell_count + 1,
			sizeof(*search->starts)) ||
		!array_reserve((void **)&search->sorted, &search->sorted_capacity, cell_count,
			sizeof(*search->sorted)) ||
		!array_reserve((void **)&search->members, &search->member_capacity, count,
			sizeof(*search->members)))
		return false;
	memset(search->sorted, 0, cell_count * sizeof(*search->sorted));
	find_ends(search, cell_count);
	write_members(search);
	return true;
}

static int compare_places(const void *a, const void *b)
{
	const struct lit_place *left = a, *right = b;
	if (left->near != right->near)
		return left->near < right->near ? -1 : 1;
	return left->shape < right->shape ? -1 : left->shape > right->shape;
}

/* Of more members a cell is sorted by the library. */
#define SORTED_HERE 32

static void sort_places(struct lit_place *places, size_t count)
{
	if (count > SORTED_HERE) {
		qsort(places, count, sizeof(*places), compare_places);
		return;
	}
	for (size_t i = 1; i < count; i++) {
		struct lit_place place = places[i];
		size_t to = i;
		for (; to > 0 && compare_places(&places[to - 1], &place) > 0; to--)
			places[to] = places[to - 1];
		places[to] = place;
	}
}

/* False where the light sees it edge on, or as good as. */
static bool find_plane(const double points[3][3], struct plane *plane)
{
	double u[3], v[3];
	for (int axis = 0; axis < 3; axis++) {
		u[axis] = points[1][axis] - points[0][axis];
		v[axis] = points[2][axis] - points[0][axis];
	}
	double area = u[0] * v[1] - u[1] * v[0];
	if (area == 0.0)
		return false;
	plane->x[0] = (u[2] * v[1] - u[1] * v[2]) / area;
	plane->x[1] = (u[0] * v[2] - u[2] * v[0]) / area;
	plane->at = points[0][2] - plane->x[0] * points[0][0] - plane->x[1] * points[0][1];
	return isfinite(plane->at);
}

static double slope_of(const struct plane *plane)
{
	return fabs(plane->x[0]) + fabs(plane->x[1]);
}

/* How far behind the plane a vertex is, in NDC depth times its w: linear in clip space, also behind
 * the eye. */
static double behind(const struct plane *plane, const double clip[4])
{
	return clip[2] - plane->x[0] * clip[0] - plane->x[1] * clip[1] - plane->at * clip[3];
}

/* False if part of it is behind the eye. */
static bool project(const double *const clip[3], double points[3][3])
{
	for (int i = 0; i < 3; i++) {
		if (!(clip[i][3] > 0.0))
			return false;
		for (int axis = 0; axis < 3; axis++)
			points[i][axis] = clip[i][axis] / clip[i][3];
	}
	return true;
}

/* NDC depth of GAP at a window depth: d = l / (k + l (1 - k)) at linear depth l (scene/light.h). */
static double gap_at(double depth, double near_to_far)
{
	double divisor = 1.0 - depth * (1.0 - near_to_far);
	return 2.0 * GAP * divisor * divisor / near_to_far;
}

/* Whether receivers on it are biased by their plane's slope. */
static bool follows_slope(const struct receiver *receiver, const struct lit_rule *rule)
{
	for (int i = 0; i < 3; i++) {
		double depth = 0.5 * receiver->points[i][2] + 0.5;
		/* Shaders find both in float: a tenth is far more than that is off. */
		if (!(receiver->slope <= 0.9 * (rule->limit[0] + rule->limit[1] * depth)))
			return false;
	}
	return true;
}

static bool find_receiver(struct receiver *receiver, const float triangle[3][3],
	const float to_clip[4][4], const struct lit_rule *rule)
{
	for (int i = 0; i < 3; i++)
		transform(to_clip, triangle[i], receiver->clip[i]);
	const double *const clip[3] = {receiver->clip[0], receiver->clip[1], receiver->clip[2]};
	if (!project(clip, receiver->points) || !find_plane(receiver->points, &receiver->plane))
		return false;
	double(*p)[3] = receiver->points;
	double around = receiver->averted ? BESIDE : rule->around;
	for (int axis = 0; axis < 2; axis++) {
		receiver->min[axis] =
			smaller_double(smaller_double(p[0][axis], p[1][axis]), p[2][axis]) - around;
		receiver->max[axis] =
			larger_double(larger_double(p[0][axis], p[1][axis]), p[2][axis]) + around;
	}
	receiver->slope = slope_of(&receiver->plane);
	receiver->gap = fmax(fmax(gap_at(0.5 * p[0][2] + 0.5, rule->near_to_far),
				     gap_at(0.5 * p[1][2] + 0.5, rule->near_to_far)),
		gap_at(0.5 * p[2][2] + 0.5, rule->near_to_far));
	/* Where the plane is followed for taps it goes on to be farther; floats may round a depth.
	 */
	receiver->clear = fmax(fmax(p[0][2], p[1][2]), p[2][2]) +
			  receiver->slope * fmax(-rule->bias, 0.0) + receiver->gap + FLAT;
	receiver->touch = fmin(fmin(p[0][2], p[1][2]), p[2][2]) - receiver->gap - FLAT;
	return receiver->averted || follows_slope(receiver, rule);
}

/* A convex polygon in clip space. */
struct polygon {
	double corners[CORNERS_MAX][4];
	int count;
};

static void polygon_init(struct polygon *polygon, const double *const clip[3])
{
	polygon->count = 3;
	for (int i = 0; i < 3; i++)
		memcpy(polygon->corners[i], clip[i], sizeof(polygon->corners[i]));
}

static void polygon_init_own(struct polygon *polygon, const struct receiver *receiver)
{
	const double *const clip[3] = {receiver->clip[0], receiver->clip[1], receiver->clip[2]};
	polygon_init(polygon, clip);
}

/* Keeps what of it is on one side: n[0] x + n[1] y + n[2] w >= 0. */
static void cut(struct polygon *polygon, const double n[3])
{
	struct polygon kept;
	kept.count = 0;
	for (int i = 0; i < polygon->count; i++) {
		const double *a = polygon->corners[i];
		const double *b = polygon->corners[(i + 1) % polygon->count];
		double at_a = n[0] * a[0] + n[1] * a[1] + n[2] * a[3];
		double at_b = n[0] * b[0] + n[1] * b[1] + n[2] * b[3];
		if (at_a >= 0.0)
			memcpy(kept.corners[kept.count++], a, sizeof(kept.corners[0]));
		/* A side's ends differ, and so do the signs: the divisor is not 0. */
		if ((at_a >= 0.0) != (at_b >= 0.0)) {
			double t = at_a / (at_a - at_b), *corner = kept.corners[kept.count++];
			for (int axis = 0; axis < 4; axis++)
				corner[axis] = a[axis] + t * (b[axis] - a[axis]);
		}
	}
	polygon->count = kept.count;
	memcpy(polygon->corners, kept.corners, (size_t)kept.count * sizeof(kept.corners[0]));
}

/* Keeps what of it is over a triangle, NDC, or within `slack` of it in x and y. */
static void cut_to(struct polygon *polygon, const double points[3][3], double slack)
{
	double area = (points[1][0] - points[0][0]) * (points[2][1] - points[0][1]) -
		      (points[1][1] - points[0][1]) * (points[2][0] - points[0][0]);
	double side = area < 0.0 ? -1.0 : 1.0;
	for (int i = 0; i < 3 && polygon->count > 0; i++) {
		const double *a = points[i], *b = points[(i + 1) % 3];
		double x = side * (a[1] - b[1]), y = side * (b[0] - a[0]);
		const double n[3] = {x, y, slack * (fabs(x) + fabs(y)) - (x * a[0] + y * a[1])};
		cut(polygon, n);
	}
}

/* Whether all of it is before a plane by `least`, NDC depth. */
static bool all_before(const struct polygon *polygon, const struct plane *plane, double least)
{
	for (int i = 0; i < polygon->count; i++) {
		const double *corner = polygon->corners[i];
		if (!(-behind(plane, corner) >= least * corner[3]))
			return false;
	}
	return true;
}

/* Whether all that is looked up of a shape is as far from the light as the receiver, less its bias.
 * It is found up to `around` from a point of the receiver: by as much it may come nearer, on its
 * own plane, than it is there. */
static bool is_beyond(
	const struct receiver *receiver, const double *const clip[3], const struct lit_rule *rule)
{
	double points[3][3];
	struct plane plane;
	if (!project(clip, points) || !find_plane(points, &plane))
		return false;
	double least = slope_of(&plane) * rule->around - receiver->slope * rule->bias;
	struct polygon over;
	polygon_init_own(&over, receiver);
	/* What all of it is, its part over the shape is. */
	if (all_before(&over, &plane, least))
		return true;
	cut_to(&over, points, rule->around);
	return all_before(&over, &plane, least);
}

/* As a transform makes them of one vertex; most differ in the first number. */
static bool is_same(const double a[4], const double b[4])
{
	return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && a[3] == b[3];
}

/* Which of a shape's corners each of the receiver's is, -1 for none; and how many are. */
static int find_shared(const struct receiver *receiver, const double *const clip[3], int shared[3])
{
	int count = 0;
	for (int i = 0; i < 3; i++) {
		shared[i] = -1;
		for (int j = 0; j < 3; j++)
			if (is_same(receiver->clip[i], clip[j]))
				shared[i] = j;
		count += shared[i] >= 0;
	}
	return count;
}

/* Whether the side that they share leads the same way in both: then both are in front on one side
 * of it. */
static bool is_inverted(const int shared[3])
{
	for (int i = 0; i < 3; i++) {
		int a = shared[i], b = shared[(i + 1) % 3];
		if (a >= 0 && b >= 0)
			return b == (a + 1) % 3;
	}
	return false;
}

/* How far behind the receiver's plane a polygon is, NDC depth, least and most. */
static void find_depths(
	const struct receiver *receiver, const struct polygon *polygon, double *least, double *most)
{
	*least = INFINITY;
	*most = -INFINITY;
	for (int i = 0; i < polygon->count; i++) {
		const double *corner = polygon->corners[i];
		/* What goes on behind the eye has no end there. */
		double depth = behind(&receiver->plane, corner);
		double at = corner[3] > 0.0 ? depth / corner[3] : copysign(INFINITY, depth);
		*least = smaller_double(at, *least);
		*most = larger_double(at, *most);
	}
}

/* Twice the area, NDC; of what is before the eye. */
static double area_of(const struct polygon *polygon)
{
	const double *first = polygon->corners[0];
	double area = 0.0;
	for (int i = 2; i < polygon->count; i++) {
		const double *a = polygon->corners[i - 1], *b = polygon->corners[i];
		area += (a[0] / a[3] - first[0] / first[3]) * (b[1] / b[3] - first[1] / first[3]) -
			(a[1] / a[3] - first[1] / first[3]) * (b[0] / b[3] - first[0] / first[3]);
	}
	return fabs(area);
}

/* Of a receiver: what two triangles that share a side have in common for rounding. */
#define OVERLAP 1e-9

/* Whether a neighbour is folded over the receiver. */
static bool is_folded(const struct receiver *receiver, const double *const clip[3])
{
	struct polygon over, whole;
	double least, most;
	polygon_init(&over, clip);
	polygon_init_own(&whole, receiver);
	find_depths(receiver, &over, &least, &most);
	if (least < -FLAT || most > FLAT)
		return false;
	cut_to(&over, receiver->points, 0.0);
	return area_of(&over) > OVERLAP * area_of(&whole);
}

/* Whether part of a shape of the receiver's object is at its depth, or as good as: of neighbours,
 * other than where they are joined, since each pixel there is one's alone. */
static bool touches(
	struct receiver *receiver, const struct lit_shape *shape, const double *const clip[3])
{
	int shared[3], count = find_shared(receiver, clip, shared);
	double least, most;
	if (count == 3) {
		bool other = receiver->self != NULL && receiver->self != shape;
		receiver->self = shape;
		return other;
	}
	if (count > 0)
		return is_inverted(shared) || is_folded(receiver, clip);
	struct polygon over;
	polygon_init(&over, clip);
	find_depths(receiver, &over, &least, &most);
	if (least > receiver->gap || most < -receiver->gap)
		return false;
	cut_to(&over, receiver->points, BESIDE);
	find_depths(receiver, &over, &least, &most);
	return least <= receiver->gap && most >= -receiver->gap;
}

/* Whether a shape neither is in front of the receiver, which must matter, nor, of the same object,
 * touches it. */
static bool is_clear(const struct lit_search *search, struct receiver *receiver,
	const struct lit_shape *shape, const struct lit_rule *rule)
{
	const double *clip[3];
	bool is_behind = true;
	for (int i = 0; i < 3; i++) {
		clip[i] = search->vertices[shape->vertices[i]];
		is_behind = is_behind &&
			    behind(&receiver->plane, clip[i]) >= -FLAT * fmax(clip[i][3], 0.0);
	}
	if (!is_behind && !receiver->averted && !is_beyond(receiver, clip, rule))
		return false;
	return shape->object != receiver->object || !touches(receiver, shape, clip);
}

/* Whether it can matter: to one that no light arrives at, what touches it alone does. */
static bool concerns(const struct receiver *receiver, const struct lit_shape *shape)
{
	return !receiver->averted ||
	       (shape->object == receiver->object && shape->far >= receiver->touch);
}

static bool is_beside(const struct receiver *receiver, const struct lit_shape *shape)
{
	for (int axis = 0; axis < 2; axis++)
		if (shape->min[axis] > receiver->max[axis] ||
			shape->max[axis] < receiver->min[axis])
			return true;
	return false;
}

/* Whether a cell is the first that a shape and the receiver have in common. */
static bool is_first(const struct lit_search *search, const struct lit_shape *shape,
	const struct cells *cells, int x, int y)
{
	struct cells own = shape_cells(shape, search->shift);
	return x == (own.first[0] > cells->first[0] ? own.first[0] : cells->first[0]) &&
	       y == (own.first[1] > cells->first[1] ? own.first[1] : cells->first[1]);
}

/* Whether all members of a cell are clear of the receiver, and not too many with those before. */
static bool cell_is_clear(struct lit_search *search, struct receiver *receiver,
	const struct cells *cells, int x, int y, const struct lit_rule *rule)
{
	int cell = y * cells_a_side(search) + x;
	const uint32_t *start = &search->starts[cell];
	if (!search->sorted[cell]) {
		sort_places(&search->members[start[0]], start[1] - start[0]);
		search->sorted[cell] = true;
	}
	for (uint32_t i = start[0]; i < start[1]; i++) {
		const struct lit_place *place = &search->members[i];
		const struct lit_shape *shape = &search->shapes[place->shape];
		if (place->near >= receiver->clear)
			break;
		if (++receiver->visits >= LIT_VISITS_MAX)
			return false;
		if (!concerns(receiver, shape) || !is_first(search, shape, cells, x, y) ||
			is_beside(receiver, shape))
			continue;
		receiver->visits += CLOSE_VISITS;
		if (!is_clear(search, receiver, shape, rule))
			return false;
	}
	return true;
}

static bool is_lit(
	struct lit_search *search, struct receiver *receiver, const struct lit_rule *rule)
{
	struct cells cells;
	for (int axis = 0; axis < 2; axis++) {
		cells.first[axis] = cell_at(receiver->min[axis]) >> search->shift;
		cells.last[axis] = cell_at(receiver->max[axis]) >> search->shift;
	}
	for (int y = cells.first[1]; y <= cells.last[1]; y++)
		for (int x = cells.first[0]; x <= cells.last[0]; x++)
			if (!cell_is_clear(search, receiver, &cells, x, y, rule))
				return false;
	return true;
}

bool lit_search_is_lit(struct lit_search *search, uint32_t object, const float triangle[3][3],
	bool averted, const float to_clip[4][4], const struct lit_rule *rule, size_t *visits)
{
	struct receiver receiver = {
		.object = object, .averted = averted, .visits = TRIANGLE_VISITS};
	bool lit = find_receiver(&receiver, triangle, to_clip, rule) &&
		   is_lit(search, &receiver, rule);
	*visits += receiver.visits;
	return lit;
}
