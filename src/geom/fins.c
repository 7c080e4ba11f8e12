/* SPDX-License-Identifier: MIT */
#include "geom/fins.h"
#include "base/array.h"
#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#define NO_END UINT32_MAX
#define NO_FIN UINT32_MAX

#define NDC_LIMIT ((double)FIN_NDC_LIMIT)

/* Silhouette and light space are given in float: ends of an edge that are no more than a few float
 * steps apart, relative to their coordinates, have no direction but that of rounding. */
#define COINCIDENT (4.0 * FLT_EPSILON)

struct fin_end {
	float position[3]; /* NDC */
	float drawn;       /* NDC: of the width */
};

struct fin_edge {
	struct fin_end ends[2];
	float direction[2]; /* unit, from end 0 to end 1 */
	float outward[2];   /* unit */
	uint32_t next[2];   /* further edge end at the same vertex, or NO_END */
	uint32_t fin;       /* that is without a corner, or NO_FIN */
};

/* End i of edge e is numbered 2 e + i. */
static struct fin_edge *edge_of(const struct fin_scratch *scratch, uint32_t end)
{
	return &scratch->edges[end / 2];
}

struct fin_writer {
	const struct fin_params *params;
	struct fin *out;
	size_t capacity, count;
	size_t left_out_count;
};

static void write(struct fin_writer *writer, const struct fin *fin)
{
	if (writer->count < writer->capacity)
		writer->out[writer->count] = *fin;
	writer->count++;
}

static void write_edge(struct fin_writer *writer, struct fin_edge *edge)
{
	bool mirrored = writer->params->mirrored;
	const struct fin_end *a = &edge->ends[mirrored], *b = &edge->ends[!mirrored];
	edge->fin = NO_FIN;
	if (fmaxf(a->drawn, b->drawn) > writer->params->finest) {
		struct fin fin = fin_along(a->position, b->position);
		edge->fin = (uint32_t)writer->count;
		write(writer, &fin);
	} else {
		writer->left_out_count++;
	}
}

/* The sector between two unit normals; halfway between is on the right of the way from the first to
 * the second, if outside. It goes with the fin that starts there, if its edge has one, and else is
 * one of its own. */
static void write_corner(struct fin_writer *writer, struct fin_edge *edge, int end,
	const float from[2], const float to[2], enum fin_side side)
{
	float x = from[0] - to[0], y = from[1] - to[1], finest = writer->params->finest;
	const struct fin_end *at = &edge->ends[end];
	if (!(at->drawn * sqrtf(x * x + y * y) > finest))
		return;
	if (end == writer->params->mirrored && edge->fin != NO_FIN) {
		if (edge->fin < writer->capacity)
			fin_add_corner(&writer->out[edge->fin], from, to, side);
		edge->fin = NO_FIN;
		return;
	}
	struct fin fin = fin_along(at->position, at->position);
	fin_add_corner(&fin, from, to, side);
	write(writer, &fin);
}

static bool normalise(float v[2], float shortest)
{
	float length = hypotf(v[0], v[1]);
	/* Nothing, or rounding, has no direction to keep. */
	if (!(length > shortest))
		return false;
	v[0] /= length;
	v[1] /= length;
	return true;
}

/* Where one edge ends and one starts: a gap opens outside where the blocker, which is on their
 * left, turns left, and inside where it turns right; at a full turn back on either side. */
static void write_simple_corner(
	struct fin_writer *writer, struct fin_edge *in, struct fin_edge *out, enum fin_side side)
{
	const float *d0 = in->direction, *d1 = out->direction;
	float turn = d0[0] * d1[1] - d0[1] * d1[0];
	float along = d0[0] * d1[0] + d0[1] * d1[1];
	bool mirrored = writer->params->mirrored, turned = mirrored != (side == FIN_INSIDE);
	turn = turned ? -turn : turn;
	if (turn < 0.0f || (turn == 0.0f && along >= 0.0f))
		return;
	write_corner(writer, mirrored ? in : out, mirrored, turned ? out->outward : in->outward,
		turned ? in->outward : out->outward, side);
}

/* Chan & Durand 2003, section 3, "Multiple edges": a shared fin along the mean of the normals,
 * joined to that of each edge. */
static void write_shared_corner(
	struct fin_writer *writer, const struct fin_scratch *scratch, uint32_t first)
{
	float mean[2] = {0.0f, 0.0f};
	float count = 0.0f;
	for (uint32_t end = first; end != NO_END; end = edge_of(scratch, end)->next[end % 2]) {
		const float *n = edge_of(scratch, end)->outward;
		mean[0] += n[0];
		mean[1] += n[1];
		count += 1.0f;
	}
	/* The sum of unit vectors in float is off by about a float step each. */
	if (!normalise(mean, count * FLT_EPSILON))
		return;
	for (uint32_t end = first; end != NO_END; end = edge_of(scratch, end)->next[end % 2]) {
		struct fin_edge *edge = edge_of(scratch, end);
		const float *n = edge->outward;
		bool left = mean[0] * n[1] - mean[1] * n[0] >= 0.0f;
		write_corner(writer, edge, end % 2, left ? mean : n, left ? n : mean,
			writer->params->both_sides ? FIN_BOTH : FIN_OUTSIDE);
	}
}

static void write_corners_at(
	struct fin_writer *writer, const struct fin_scratch *scratch, uint32_t first)
{
	struct fin_edge *edge = edge_of(scratch, first);
	uint32_t second = edge->next[first % 2];
	if (second == NO_END)
		return;
	struct fin_edge *other = edge_of(scratch, second);
	if (other->next[second % 2] != NO_END || first % 2 == second % 2) {
		write_shared_corner(writer, scratch, first);
		return;
	}
	struct fin_edge *in = first % 2 == 1 ? edge : other;
	struct fin_edge *out = first % 2 == 1 ? other : edge;
	write_simple_corner(writer, in, out, FIN_OUTSIDE);
	if (writer->params->both_sides)
		write_simple_corner(writer, in, out, FIN_INSIDE);
}

/* The half-spaces whose intersection is kept, as p . plane >= 0 in clip space: in front of the near
 * plane, and the surroundings of the screen. */
static const double clip_planes[][4] = {
	{0.0, 0.0, 1.0, 1.0},
	{1.0, 0.0, 0.0, NDC_LIMIT},
	{-1.0, 0.0, 0.0, NDC_LIMIT},
	{0.0, 1.0, 0.0, NDC_LIMIT},
	{0.0, -1.0, 0.0, NDC_LIMIT},
};

static double dot(const double a[4], const double b[4])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/* Moves the ends inside, setting cut[] of each that moves; false if nothing is left. */
static bool clip_edge(double ends[2][4], bool cut[2])
{
	for (size_t i = 0; i < sizeof(clip_planes) / sizeof(clip_planes[0]); i++) {
		double d[2] = {dot(ends[0], clip_planes[i]), dot(ends[1], clip_planes[i])};
		bool inside[2] = {d[0] >= 0.0, d[1] >= 0.0};
		if (!inside[0] && !inside[1])
			return false;
		if (inside[0] && inside[1])
			continue;
		int in = inside[0] ? 0 : 1, out = 1 - in;
		/* d has two signs, so that the divisor is not zero. */
		double t = d[in] / (d[in] - d[out]);
		for (int c = 0; c < 4; c++) /* from the end that may be less far away */
			ends[out][c] = ends[in][c] + t * (ends[out][c] - ends[in][c]);
		cut[out] = true;
	}
	/* Only x = y = w = 0 is left on the wrong side of the division. */
	return ends[0][3] > 0.0 && ends[1][3] > 0.0;
}

static void transform(const float matrix[16], const float position[3], double clip[4])
{
	for (int r = 0; r < 4; r++) {
		clip[r] = matrix[12 + r];
		for (int c = 0; c < 3; c++)
			clip[r] += (double)matrix[4 * c + r] * position[c];
	}
}

/* Into the range, and NaN to its start. */
static double clamp(double value, double min, double max)
{
	return fmin(fmax(value, min), max);
}

static struct fin_end end_of(
	const struct fin_params *params, double x, double y, const double clip[4])
{
	float z = (float)clamp(clip[2] / clip[3], -1.0, 1.0);
	return (struct fin_end){
		.position = {(float)x, (float)y, z},
		.drawn = fin_law_drawn(&params->law, z),
	};
}

/* As fin_expand() finds it, so that corners meet the fins of their edges. The ends do not coincide:
 * project_edge() saw to that. */
static void find_direction(const struct fin_params *params, struct fin_edge *edge)
{
	const float *a = edge->ends[0].position, *b = edge->ends[1].position;
	float x = b[0] - a[0], y = b[1] - a[1], length = sqrtf(x * x + y * y);
	float side = params->mirrored ? -1.0f : 1.0f;
	edge->direction[0] = x / length;
	edge->direction[1] = y / length;
	edge->outward[0] = side * edge->direction[1];
	edge->outward[1] = side * -edge->direction[0];
}

/* Sees an edge from the light; false if there is nothing to see. */
static bool project_edge(const struct fin_params *params, const float a[3], const float b[3],
	struct fin_edge *edge, bool cut[2])
{
	double clip[2][4];
	transform(params->object_to_clip, a, clip[0]);
	transform(params->object_to_clip, b, clip[1]);
	if (!clip_edge(clip, cut))
		return false;

	double p[2][2], largest = 1.0;
	for (int i = 0; i < 2; i++) {
		for (int c = 0; c < 2; c++) {
			/* clip_edge() leaves w > 0 and the quotient inside, but for rounding. */
			p[i][c] = clamp(clip[i][c] / clip[i][3], -NDC_LIMIT, NDC_LIMIT);
			largest = fmax(largest, fabs(p[i][c]));
		}
		edge->ends[i] = end_of(params, p[i][0], p[i][1], clip[i]);
	}
	double dx = p[1][0] - p[0][0], dy = p[1][1] - p[0][1];
	if (dx * dx + dy * dy <= COINCIDENT * largest * (COINCIDENT * largest))
		return false;
	find_direction(params, edge);
	return true;
}

static void link_end(struct fin_scratch *scratch, uint32_t vertex, uint32_t end)
{
	edge_of(scratch, end)->next[end % 2] = scratch->first[vertex];
	scratch->first[vertex] = end;
}

void fin_scratch_init(struct fin_scratch *scratch)
{
	*scratch = (struct fin_scratch){0};
}

void fin_scratch_finish(struct fin_scratch *scratch)
{
	free(scratch->edges);
	free(scratch->first);
	fin_scratch_init(scratch);
}

size_t fin_scratch_bytes(const struct fin_scratch *scratch)
{
	return scratch->edge_capacity * sizeof(*scratch->edges) +
	       scratch->vertex_capacity * sizeof(*scratch->first);
}

bool fin_scratch_reserve(
	struct fin_scratch *scratch, const struct caster *caster, size_t edge_count)
{
	if (edge_count >= NO_END / 2)
		return false;
	void *edges = scratch->edges;
	bool ok =
		array_reserve(&edges, &scratch->edge_capacity, edge_count, sizeof(*scratch->edges));
	scratch->edges = edges;

	void *first = scratch->first;
	size_t known = scratch->vertex_capacity;
	ok = ok && array_reserve(&first, &scratch->vertex_capacity, caster->vertex_count,
			   sizeof(*scratch->first));
	scratch->first = first;
	for (size_t v = known; v < scratch->vertex_capacity; v++)
		scratch->first[v] = NO_END;
	return ok;
}

size_t fins_max(size_t edge_count)
{
	/* One an edge, or a corner at its start without it; and a corner at its other end: a simple
	 * one has two ends, if two sides. Saturates, so that allocating as much fails. */
	return edge_count <= SIZE_MAX / 2 ? 2 * edge_count : SIZE_MAX;
}

size_t fins_build(const struct caster *caster, const struct silhouette_edge *edges,
	size_t edge_count, const struct fin_params *params, struct fin_scratch *scratch,
	struct fin *out, size_t capacity)
{
	assert(edge_count <= scratch->edge_capacity);
	struct fin_writer writer = {.params = params, .out = out, .capacity = capacity};
	for (size_t e = 0; e < edge_count; e++) {
		struct fin_edge *edge = &scratch->edges[e];
		uint32_t a = edges[e].a, b = edges[e].b;
		bool cut[2] = {false, false};
		if (!project_edge(params, caster->positions[a], caster->positions[b], edge, cut))
			continue;
		write_edge(&writer, edge);
		/* Where an edge is cut is no corner. */
		if (!cut[0])
			link_end(scratch, a, (uint32_t)(2 * e));
		if (!cut[1])
			link_end(scratch, b, (uint32_t)(2 * e + 1));
	}
	for (size_t e = 0; e < edge_count; e++) {
		uint32_t vertices[2] = {edges[e].a, edges[e].b};
		for (int i = 0; i < 2; i++) {
			uint32_t *first = &scratch->first[vertices[i]];
			if (*first == NO_END)
				continue;
			write_corners_at(&writer, scratch, *first);
			*first = NO_END;
		}
	}
	scratch->left_out_count = writer.left_out_count;
	return writer.count;
}
