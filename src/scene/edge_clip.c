/* SPDX-License-Identifier: MIT */
#include "scene/edge_clip.h"
#include "base/array.h"
#include <stdlib.h>
#include <string.h>

void clip_position(
	const struct caster *caster, const mat4 to_clip, uint32_t vertex, double position[4])
{
	const float *p = caster->positions[vertex];
	for (int row = 0; row < 4; row++)
		position[row] = (double)to_clip[0][row] * p[0] + (double)to_clip[1][row] * p[1] +
				(double)to_clip[2][row] * p[2] + (double)to_clip[3][row];
}

/* What is clipped, and with what. */
struct clipping {
	struct edge_clip *clip;
	const struct caster *caster;
	const vec4 *to_clip;
};

static struct clip_vertex vertex_of(const struct clipping *clipping, uint32_t vertex)
{
	struct clip_vertex of = {.a = vertex, .b = vertex};
	clip_position(clipping->caster, clipping->to_clip, vertex, of.position);
	return of;
}

static double beyond_near(const struct clip_vertex *vertex)
{
	return vertex->position[2] + vertex->position[3];
}

static bool is_inside(const struct clip_vertex *vertex)
{
	return beyond_near(vertex) >= 0.0;
}

/* One of both is inside. The same in every bit whichever way the edge runs. */
static struct clip_vertex cut_between(const struct clip_vertex *p, const struct clip_vertex *q)
{
	const struct clip_vertex *low = p->a < q->a ? p : q, *high = low == p ? q : p;
	double at_low = beyond_near(low), at_high = beyond_near(high);
	double share = at_low / (at_low - at_high);
	struct clip_vertex cut = {.a = low->a, .b = high->a};
	for (int i = 0; i < 4; i++)
		cut.position[i] = low->position[i] + share * (high->position[i] - low->position[i]);
	return cut;
}

/* There is room. */
static void append(
	struct edge_clip *clip, const struct clip_vertex *from, const struct clip_vertex *to)
{
	clip->ends[clip->end_count++] = *from;
	clip->ends[clip->end_count++] = *to;
}

static void clip_edge(const struct clipping *clipping, struct silhouette_edge edge)
{
	struct clip_vertex from = vertex_of(clipping, edge.a), to = vertex_of(clipping, edge.b);
	bool starts = is_inside(&from), ends = is_inside(&to);
	if (!starts && !ends)
		return;
	if (starts != ends)
		*(starts ? &to : &from) = cut_between(&from, &to);
	append(clipping->clip, &from, &to);
}

/* The boundary of what is left of a triangle leaves its edges where it goes out, and is back where
 * it comes in. */
static void close_triangle(const struct clipping *clipping, const uint32_t corners[3], bool turned)
{
	struct clip_vertex vertices[3], out, in;
	int crossings = 0;
	for (int k = 0; k < 3; k++)
		vertices[k] = vertex_of(clipping, corners[k]);
	for (int k = 0; k < 3; k++) {
		const struct clip_vertex *from = &vertices[k], *to = &vertices[(k + 1) % 3];
		if (is_inside(from) == is_inside(to))
			continue;
		*(is_inside(from) ? &out : &in) = cut_between(from, to);
		crossings++;
	}
	if (crossings == 2)
		append(clipping->clip, turned ? &in : &out, turned ? &out : &in);
}

static int compare_vertices(const void *p, const void *q)
{
	const struct clip_vertex *v = p, *w = q;
	if (v->a != w->a)
		return v->a < w->a ? -1 : 1;
	return v->b < w->b ? -1 : v->b > w->b;
}

/* Sets vertices to the distinct ones of the edges' ends, in order. */
static bool collect_vertices(struct edge_clip *clip)
{
	if (!array_reserve((void **)&clip->vertices, &clip->vertex_capacity, clip->end_count,
		    sizeof(*clip->vertices)))
		return false;
	clip->vertex_count = 0;
	if (clip->end_count == 0)
		return true;
	memcpy(clip->vertices, clip->ends, clip->end_count * sizeof(*clip->ends));
	qsort(clip->vertices, clip->end_count, sizeof(*clip->vertices), compare_vertices);
	for (size_t i = 0; i < clip->end_count; i++)
		if (i == 0 || compare_vertices(&clip->vertices[i],
				      &clip->vertices[clip->vertex_count - 1]) != 0)
			clip->vertices[clip->vertex_count++] = clip->vertices[i];
	return true;
}

static uint32_t place_of(const struct edge_clip *clip, const struct clip_vertex *vertex)
{
	const struct clip_vertex *found = bsearch(
		vertex, clip->vertices, clip->vertex_count, sizeof(*vertex), compare_vertices);
	return (uint32_t)(found - clip->vertices);
}

static bool number_edges(struct edge_clip *clip)
{
	clip->edge_count = clip->end_count / 2;
	if (!array_reserve((void **)&clip->edges, &clip->edge_capacity, clip->edge_count,
		    sizeof(*clip->edges)))
		return false;
	for (size_t i = 0; i < clip->edge_count; i++)
		clip->edges[i] = (struct silhouette_edge){
			place_of(clip, &clip->ends[2 * i]), place_of(clip, &clip->ends[2 * i + 1])};
	return true;
}

bool edge_clip_near(struct edge_clip *clip, const struct caster *caster, const mat4 to_clip,
	const uint64_t *facing, const uint64_t *back, bool mirrored,
	const struct silhouette_edge *edges, size_t edge_count)
{
	struct clipping clipping = {clip, caster, to_clip};
	clip->end_count = 0;
	if (!array_reserve((void **)&clip->ends, &clip->end_capacity,
		    2 * (edge_count + caster->triangle_count), sizeof(*clip->ends)))
		return false;
	for (size_t i = 0; i < edge_count; i++)
		clip_edge(&clipping, edges[i]);
	for (size_t t = 0; t < caster->triangle_count; t++) {
		bool faces = facing[t / EDGE_BLOCK] >> t % EDGE_BLOCK & 1;
		if (faces || back[t / EDGE_BLOCK] >> t % EDGE_BLOCK & 1)
			close_triangle(&clipping, &caster->indices[3 * t], faces == mirrored);
	}
	return collect_vertices(clip) && number_edges(clip);
}

void edge_clip_finish(struct edge_clip *clip)
{
	free(clip->vertices);
	free(clip->edges);
	free(clip->ends);
	*clip = (struct edge_clip){0};
}

size_t edge_clip_bytes(const struct edge_clip *clip)
{
	return clip->vertex_capacity * sizeof(*clip->vertices) +
	       clip->edge_capacity * sizeof(*clip->edges) +
	       clip->end_capacity * sizeof(*clip->ends);
}
