/* SPDX-License-Identifier: MIT */
#include "scene/edge_chains.h"
#include "base/array.h"
#include <stdlib.h>

#define NONE UINT32_MAX

/* A caster on the light's screen. */
struct projection {
	const struct caster *caster;
	mat4 to_clip;
	double screen;
};

/* Rounded to the raster grid. */
static int32_t screen_steps(double steps)
{
	return (int32_t)lrint(fmax(-CHAIN_LIMIT, fmin(steps, CHAIN_LIMIT)));
}

static struct chain_point project(const struct projection *projection, uint32_t vertex)
{
	const float *p = projection->caster->positions[vertex];
	double clip[4];
	for (int row = 0; row < 4; row++)
		clip[row] = (double)projection->to_clip[0][row] * p[0] +
			    (double)projection->to_clip[1][row] * p[1] +
			    (double)projection->to_clip[2][row] * p[2] +
			    (double)projection->to_clip[3][row];
	double scale = 0.5 / fmax(clip[3], DBL_MIN);
	return (struct chain_point){
		.x = screen_steps((0.5 + clip[0] * scale) * projection->screen),
		.y = screen_steps((0.5 + clip[1] * scale) * projection->screen),
		.depth = (float)fmax(0.0, fmin(0.5 + clip[2] * scale, 1e6)),
	};
}

/* Fills chains->edges; returns false when out of memory. */
static bool find_silhouettes(struct edge_chains *chains, const struct caster *caster,
	const float light[4], size_t *count)
{
	if (!array_reserve((void **)&chains->facing, &chains->facing_capacity, facing_words(caster),
		    sizeof(*chains->facing)))
		return false;
	facing_find(caster, light, chains->facing);
	*count = silhouette_find(caster, chains->facing, chains->edges, chains->edge_capacity);
	if (*count <= chains->edge_capacity)
		return true;
	if (!array_reserve((void **)&chains->edges, &chains->edge_capacity, *count,
		    sizeof(*chains->edges)))
		return false;
	silhouette_find(caster, chains->facing, chains->edges, chains->edge_capacity);
	return true;
}

/* Which edges start where. */
static void link_edges(struct edge_chains *chains, size_t edge_count)
{
	for (size_t i = 0; i < edge_count; i++)
		chains->edge_from[chains->edges[i].a] = NONE;
	for (size_t i = edge_count; i-- > 0;) {
		uint32_t *from = &chains->edge_from[chains->edges[i].a];
		chains->edge_after[i] = *from;
		*from = (uint32_t)i;
	}
}

static void append(struct edge_chains *chains, struct chain_point point, bool ends)
{
	point.ends = ends;
	chains->points[chains->count++] = point;
}

/* As many edges end at a vertex as start there: whoever follows them gets stuck only where they
 * came from. */
static void follow(struct edge_chains *chains, const struct projection *projection, uint32_t start)
{
	struct chain_point first = project(projection, start), point = first;
	uint32_t vertex = start, edge;
	while ((edge = chains->edge_from[vertex]) != NONE) {
		append(chains, point, false);
		chains->edge_from[vertex] = chains->edge_after[edge];
		vertex = chains->edges[edge].b;
		point = project(projection, vertex);
	}
	append(chains, first, true);
}

static bool append_caster(
	struct edge_chains *chains, const struct projection *projection, size_t edge_count)
{
	if (!array_reserve((void **)&chains->edge_from, &chains->from_capacity,
		    projection->caster->vertex_count, sizeof(*chains->edge_from)) ||
		!array_reserve((void **)&chains->edge_after, &chains->after_capacity, edge_count,
			sizeof(*chains->edge_after)) ||
		!array_reserve((void **)&chains->points, &chains->point_capacity,
			chains->count + 2 * edge_count, sizeof(*chains->points)))
		return false;
	link_edges(chains, edge_count);
	for (size_t i = 0; i < edge_count; i++)
		if (chains->edge_from[chains->edges[i].a] != NONE)
			follow(chains, projection, chains->edges[i].a);
	chains->edge_count += edge_count;
	return true;
}

/* What is on the left before a mirror is on the right behind it. */
static void turn_edges(struct silhouette_edge *edges, size_t count)
{
	for (size_t i = 0; i < count; i++)
		edges[i] = (struct silhouette_edge){edges[i].b, edges[i].a};
}

bool edge_chains_find(struct edge_chains *chains, const struct sm_scene *scene,
	const struct light_frame *frame, uint32_t screen)
{
	chains->count = 0;
	chains->edge_count = 0;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct object *object = &scene->objects[i];
		if (!object->casts)
			continue;
		struct projection projection = {
			.caster = &scene->meshes[object->mesh].caster, .screen = screen};
		mat4 to_object;
		vec4 light;
		size_t edge_count;
		glm_mat4_mul((vec4 *)frame->world_to_clip, (vec4 *)object->transform,
			projection.to_clip);
		glm_mat4_inv((vec4 *)object->transform, to_object);
		glm_mat4_mulv(to_object, (float *)frame->origin, light);
		if (!find_silhouettes(chains, projection.caster, light, &edge_count))
			return false;
		if (glm_mat4_det((vec4 *)object->transform) < 0.0f)
			turn_edges(chains->edges, edge_count);
		if (!append_caster(chains, &projection, edge_count))
			return false;
	}
	return true;
}

void edge_chains_finish(struct edge_chains *chains)
{
	free(chains->points);
	free(chains->facing);
	free(chains->edges);
	free(chains->edge_from);
	free(chains->edge_after);
	*chains = (struct edge_chains){0};
}

size_t edge_chains_bytes(const struct edge_chains *chains)
{
	return chains->point_capacity * sizeof(*chains->points) +
	       chains->facing_capacity * sizeof(*chains->facing) +
	       chains->edge_capacity * sizeof(*chains->edges) +
	       chains->from_capacity * sizeof(*chains->edge_from) +
	       chains->after_capacity * sizeof(*chains->edge_after);
}
