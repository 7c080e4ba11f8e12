/* SPDX-License-Identifier: MIT */
#include "scene/edge_chains.h"
#include "base/array.h"
#include "base/float_range.h"
#include "scene/hollow_search.h"
#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

/* Of a caster that has more, each hides too little for what finding them takes, but for those over
 * hollows. Those of the others are not listed by both rules. */
#define GRAZING_TRIANGLES_MAX 512

/* How much deeper than the triangle beside one over a hollow, as a share of how far that is behind
 * it, receivers are for which it counts. */
#define HOLLOW_DEEPER 2.0f

/* On the screen, in steps of the raster grid, but between them. */
struct screen_point {
	double x, y, depth;
};

/* A caster whose edges are being followed. */
struct walk {
	struct edge_chains *chains;
	const struct caster_view *view;
	const struct silhouette_edge *edges;
	const struct clip_vertex *clipped; /* that the edges are between; NULL: the caster's own */
	double screen;
};

static struct screen_point project(const struct walk *walk, uint32_t vertex)
{
	double position[4];
	const double *clip = position;
	if (walk->clipped != NULL)
		clip = walk->clipped[vertex].position;
	else
		clip_position(walk->view->caster, walk->view->to_clip, vertex, position);
	double scale = 0.5 / fmax(clip[3], DBL_MIN);
	return (struct screen_point){
		.x = (0.5 + clip[0] * scale) * walk->screen,
		.y = (0.5 + clip[1] * scale) * walk->screen,
		.depth = 0.5 + clip[2] * scale,
	};
}

static double clamp(double value, double low, double high)
{
	return fmax(low, fmin(value, high));
}

static bool is_within(const struct screen_point *point)
{
	return fabs(point->x) <= CHAIN_LIMIT && fabs(point->y) <= CHAIN_LIMIT;
}

/* Rounding never leads to half way between two steps of the raster grid, where the nearer one could
 * no longer be told. */
static int32_t on_grid(const struct edge_chains *chains, double at)
{
	int32_t point = (int32_t)lrint(at), step = (int32_t)chains->raster_step;
	if (step == 1 || (point & (step - 1)) != step / 2)
		return point;
	return rint(at / step) * step > point ? point + 1 : point - 1;
}

static struct chain_point chain_point_of(
	const struct edge_chains *chains, const struct screen_point *point, uint32_t sheets)
{
	return (struct chain_point){
		.x = on_grid(chains, clamp(point->x, -CHAIN_LIMIT, CHAIN_LIMIT)),
		.y = on_grid(chains, clamp(point->y, -CHAIN_LIMIT, CHAIN_LIMIT)),
		.depth = (float)clamp(point->depth, 0.0, CHAIN_DEPTH_MAX),
		.sheets = sheets,
	};
}

static bool append(struct edge_chains *chains, const struct screen_point *point, uint32_t sheets)
{
	if (!array_reserve((void **)&chains->points, &chains->point_capacity, chains->count + 1,
		    sizeof(*chains->points)))
		return false;
	chains->points[chains->count++] = chain_point_of(chains, point, sheets);
	return true;
}

/* Shares of the way at which an edge crosses the limits' lines, in order. */
static int crossings(
	const struct screen_point *from, const struct screen_point *to, double shares[4])
{
	int count = 0;
	for (int side = 0; side < 4; side++) {
		double limit = side % 2 ? CHAIN_LIMIT : -CHAIN_LIMIT;
		double start = side / 2 ? from->y : from->x, end = side / 2 ? to->y : to->x;
		double share = (limit - start) / (end - start);
		if (!(share > 0.0 && share < 1.0))
			continue;
		int place = count++;
		for (; place > 0 && shares[place - 1] > share; place--)
			shares[place] = shares[place - 1];
		shares[place] = share;
	}
	return count;
}

/* The edge's start and, where it leaves or enters what is within the limits, a point there: what is
 * outside is then moved onto the limits, which takes it over no point inside. */
static bool append_edge(struct edge_chains *chains, const struct screen_point *from,
	const struct screen_point *to, uint32_t sheets)
{
	if (!append(chains, from, sheets))
		return false;
	if (is_within(from) && is_within(to))
		return true;
	double shares[4];
	int count = crossings(from, to, shares);
	for (int i = 0; i < count; i++) {
		struct screen_point point = {
			from->x + shares[i] * (to->x - from->x),
			from->y + shares[i] * (to->y - from->y),
			from->depth + shares[i] * (to->depth - from->depth),
		};
		if (!append(chains, &point, sheets))
			return false;
	}
	return true;
}

/* Takes an edge from a vertex, and one more from there to the same end if there is one; returns how
 * many. */
static uint32_t take_edges(const struct walk *walk, uint32_t vertex, uint32_t *end)
{
	struct edge_chains *chains = walk->chains;
	uint32_t *link = &chains->edge_from[vertex], count = 0;
	*end = walk->edges[*link].b;
	while (*link != NONE && count < EDGE_SHEETS_MAX) {
		uint32_t edge = *link;
		if (walk->edges[edge].b == *end) {
			*link = chains->edge_after[edge];
			count++;
		} else {
			link = &chains->edge_after[edge];
		}
	}
	return count;
}

static bool follow(const struct walk *walk, uint32_t start)
{
	struct edge_chains *chains = walk->chains;
	struct screen_point first = project(walk, start), point = first;
	uint32_t vertex = start;
	while (chains->edge_from[vertex] != NONE) {
		uint32_t sheets = take_edges(walk, vertex, &vertex);
		struct screen_point next = vertex == start ? first : project(walk, vertex);
		if (!append_edge(chains, &point, &next, sheets))
			return false;
		point = next;
	}
	return append(chains, &point, 0);
}

static void link_edges(
	struct edge_chains *chains, const struct silhouette_edge *edges, size_t count)
{
	for (size_t i = 0; i < count; i++)
		chains->edge_from[edges[i].a] = NONE;
	for (size_t i = count; i-- > 0;) {
		uint32_t *from = &chains->edge_from[edges[i].a];
		chains->edge_after[i] = *from;
		*from = (uint32_t)i;
	}
}

static bool follow_all(const struct walk *walk, size_t edge_count, size_t vertex_count)
{
	struct edge_chains *chains = walk->chains;
	if (!array_reserve((void **)&chains->edge_from, &chains->from_capacity, vertex_count,
		    sizeof(*chains->edge_from)) ||
		!array_reserve((void **)&chains->edge_after, &chains->after_capacity, edge_count,
			sizeof(*chains->edge_after)))
		return false;
	link_edges(chains, walk->edges, edge_count);
	for (size_t i = 0; i < edge_count; i++)
		if (chains->edge_from[walk->edges[i].a] != NONE && !follow(walk, walk->edges[i].a))
			return false;
	chains->edge_count += edge_count;
	return true;
}

/* Whether the plane of a triangle cuts the light's disc, however that is turned. */
static bool is_grazing(const struct caster_view *view, const uint32_t corners[3])
{
	vec3 at[3], sides[2], normal;
	for (int k = 0; k < 3; k++)
		glm_mat4_mulv3((vec4 *)view->to_light, (float *)view->caster->positions[corners[k]],
			1.0f, at[k]);
	glm_vec3_sub(at[1], at[0], sides[0]);
	glm_vec3_sub(at[2], at[0], sides[1]);
	glm_vec3_cross(sides[0], sides[1], normal);
	float length = glm_vec3_norm(normal);
	float off = view->parallel ? normal[2] : glm_vec3_dot(normal, at[0]);
	return length > 0.0f && fabsf(off) < view->disc * length;
}

/* reversed: from its last corner to its first. */
static bool append_triangle(const struct walk *walk, const uint32_t corners[3], bool reversed)
{
	struct screen_point points[3];
	for (int k = 0; k < 3; k++) {
		points[k] = project(walk, corners[reversed ? 2 - k : k]);
		if (!is_within(&points[k]))
			return true;
	}
	for (uint32_t k = 0; k < 3; k++)
		if (!append(walk->chains, &points[k], CHAIN_GRAZING + k))
			return false;
	return append(walk->chains, &points[0], 0);
}

/* Those of closed parts. One that faces the light's centre is taken away where it counts. */
static bool append_grazing(const struct walk *walk)
{
	const struct caster_view *view = walk->view;
	size_t count = view->rule.one_sided;
	for (size_t t = 0; t < count; t++) {
		const uint32_t *corners = &view->caster->indices[3 * t];
		bool faces = view->facing[t / EDGE_BLOCK] >> t % EDGE_BLOCK & 1;
		if (is_grazing(view, corners) &&
			!append_triangle(walk, corners, faces != view->rule.mirrored))
			return false;
	}
	return true;
}

/* A triangle over a hollow: none that what is hidden is known to be in. */
static bool begin_hollow(const struct walk *walk, uint32_t triangle, struct chain_hollow *hollow)
{
	const uint32_t *corners = &walk->view->caster->indices[3 * triangle];
	*hollow = (struct chain_hollow){.triangle = triangle,
		.min = {CHAIN_LIMIT, CHAIN_LIMIT},
		.max = {-CHAIN_LIMIT, -CHAIN_LIMIT}};
	for (int k = 0; k < 3; k++) {
		/* As it faces the light it counts reversed. */
		bool reversed = !walk->view->rule.mirrored;
		struct screen_point point = project(walk, corners[reversed ? 2 - k : k]);
		if (!is_within(&point))
			return false;
		hollow->corners[k] = chain_point_of(walk->chains, &point, CHAIN_GRAZING);
	}
	return true;
}

/* Adds a triangle beside it. */
static void widen_hollow(const struct walk *walk, uint32_t beside, struct chain_hollow *hollow)
{
	float near = CHAIN_DEPTH_MAX, far = 0.0f;
	for (uint32_t k = 0; k < 3; k++) {
		struct screen_point point =
			project(walk, walk->view->caster->indices[3 * beside + k]);
		const float place[2] = {(float)point.x, (float)point.y};
		for (int axis = 0; axis < 2; axis++) {
			hollow->min[axis] = smaller(place[axis], hollow->min[axis]);
			hollow->max[axis] = larger(place[axis], hollow->max[axis]);
		}
		near = smaller(hollow->corners[k].depth, near);
		far = larger((float)point.depth, far);
	}
	hollow->far = larger(far + HOLLOW_DEEPER * larger(far - near, 0.0f), hollow->far);
}

static bool append_hollows(const struct walk *walk)
{
	struct edge_chains *chains = walk->chains;
	struct hollow_search search;
	struct chain_hollow hollow;
	size_t first = chains->hollow_count;
	hollow_search_begin(&search, walk->view);
	const struct hollow *found;
	while ((found = hollow_search_next(&search)) != NULL) {
		bool again = chains->hollow_count > first &&
			     chains->hollows[chains->hollow_count - 1].triangle == found->triangle;
		if (!again && !begin_hollow(walk, found->triangle, &hollow))
			continue;
		if (!again && !edge_chains_keep_hollows(chains, &hollow, 1))
			return false;
		widen_hollow(walk, found->corner / 3, &chains->hollows[chains->hollow_count - 1]);
	}
	return true;
}

/* Fills chains->edges; returns false when out of memory. */
static bool find_edges(struct edge_chains *chains, const struct caster_view *view, size_t *count)
{
	if (!array_reserve((void **)&chains->back, &chains->back_capacity,
		    facing_words(view->caster), sizeof(*chains->back)))
		return false;
	*count = sheets_find(view->caster, &view->rule, view->light, view->facing, chains->back,
		chains->edges, chains->edge_capacity);
	if (*count <= chains->edge_capacity)
		return true;
	if (!array_reserve((void **)&chains->edges, &chains->edge_capacity, *count,
		    sizeof(*chains->edges)))
		return false;
	sheets_find(view->caster, &view->rule, view->light, view->facing, chains->back,
		chains->edges, chains->edge_capacity);
	return true;
}

void edge_chains_clear(struct edge_chains *chains)
{
	chains->count = 0;
	chains->edge_count = 0;
	chains->hollow_count = 0;
	chains->block_count = chains->tested_count = 0;
}

bool edge_chains_see(struct edge_chains *chains, const struct sm_scene *scene,
	const struct object *object, const struct light_frame *frame, struct caster_view *view)
{
	const struct mesh *mesh = &scene->meshes[object->mesh];
	view->caster = &mesh->caster;
	glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform, view->to_clip);
	glm_mat4_mul((vec4 *)frame->world_to_light, (vec4 *)object->transform, view->to_light);
	view->parallel = frame->parallel;
	view->disc = frame->disc;
	view->rule = mesh_sheet_rule(mesh, (vec4 *)object->transform, view->to_clip);
	view->rule.all = chains->tests_all;
	view->cut = !mesh_beyond_near(mesh, view->to_clip);
	if (!array_reserve((void **)&chains->facing, &chains->facing_capacity,
		    facing_words(view->caster), sizeof(*chains->facing)))
		return false;
	mat4 to_object;
	glm_mat4_inv((vec4 *)object->transform, to_object);
	glm_mat4_mulv(to_object, (float *)frame->origin, view->light);
	chains->block_count += facing_words(view->caster);
	chains->tested_count += (chains->tests_all ? facing_find_all : facing_find)(
		view->caster, view->light, chains->facing);
	view->facing = chains->facing;
	return true;
}

bool edge_chains_add(struct edge_chains *chains, const struct caster_view *view, uint32_t screen,
	uint32_t raster_step)
{
	chains->raster_step = raster_step;
	size_t edge_count;
	if (!find_edges(chains, view, &edge_count))
		return false;
	struct walk walk = {chains, view, chains->edges, NULL, screen};
	if (!view->cut)
		return follow_all(&walk, edge_count, view->caster->vertex_count) &&
		       (view->rule.one_sided <= GRAZING_TRIANGLES_MAX ? append_grazing(&walk)
								      : append_hollows(&walk));
	if (!edge_clip_near(&chains->clip, view->caster, view->to_clip, view->facing, chains->back,
		    view->rule.mirrored, chains->edges, edge_count))
		return false;
	walk.edges = chains->clip.edges;
	walk.clipped = chains->clip.vertices;
	return follow_all(&walk, chains->clip.edge_count, chains->clip.vertex_count);
}

bool edge_chains_keep(struct edge_chains *chains, const struct chain_point *points, size_t count,
	size_t edge_count)
{
	if (!array_reserve((void **)&chains->points, &chains->point_capacity, chains->count + count,
		    sizeof(*chains->points)))
		return false;
	if (count > 0)
		memcpy(chains->points + chains->count, points, count * sizeof(*points));
	chains->count += count;
	chains->edge_count += edge_count;
	return true;
}

bool edge_chains_keep_hollows(
	struct edge_chains *chains, const struct chain_hollow *hollows, size_t count)
{
	if (!array_reserve((void **)&chains->hollows, &chains->hollow_capacity,
		    chains->hollow_count + count, sizeof(*chains->hollows)))
		return false;
	if (count > 0)
		memcpy(chains->hollows + chains->hollow_count, hollows, count * sizeof(*hollows));
	chains->hollow_count += count;
	return true;
}

void edge_chains_finish(struct edge_chains *chains)
{
	edge_clip_finish(&chains->clip);
	free(chains->points);
	free(chains->hollows);
	free(chains->facing);
	free(chains->back);
	free(chains->edges);
	free(chains->edge_from);
	free(chains->edge_after);
	*chains = (struct edge_chains){0};
}

size_t edge_chains_bytes(const struct edge_chains *chains)
{
	return chains->point_capacity * sizeof(*chains->points) +
	       chains->hollow_capacity * sizeof(*chains->hollows) +
	       chains->facing_capacity * sizeof(*chains->facing) +
	       chains->back_capacity * sizeof(*chains->back) +
	       chains->edge_capacity * sizeof(*chains->edges) +
	       chains->from_capacity * sizeof(*chains->edge_from) +
	       chains->after_capacity * sizeof(*chains->edge_after) +
	       edge_clip_bytes(&chains->clip);
}
