/* SPDX-License-Identifier: MIT */
#include "geom/fins.h"
#include "base/array.h"
#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

/*
 * Along a silhouette edge p0 -> p1 with outward normal n and widths w0, w1 lies the quad p0, p1,
 * p1 + n w1, p0 + n w0. Its offsets are 0, 0, n w1, n w0 and its widths w0, w1, w1, w0. Both are
 * affine over the whole trapezoid (offset is n times the distance from the edge; width changes
 * along it alone), so that its two triangles interpolate the same functions. As w = 1 everywhere,
 * interpolation is linear on the screen; so are the laws of width, since 1 / w and z of a straight
 * line are linear after projection.
 *
 * Around a corner at p, offset is the vertex minus p and width is constant: alpha is the distance
 * from p, whatever the quad. It has to cover the sector of radius w between two normals; beyond
 * that alpha is at least 1, and where fins overlap the lowest alpha wins and is right.
 */

#define NO_END UINT32_MAX

/* In NDC. Far beyond the screen, [-1, 1], and any fin that reaches it; near enough that floats
 * there still step by less than a texel of the largest shadow map. */
#define NDC_LIMIT 1024.0

/* Silhouette and light space are given in float: ends of an edge that are no more than a few float
 * steps apart, relative to their coordinates, have no direction but that of rounding. */
#define COINCIDENT (4.0 * FLT_EPSILON)

struct fin_end {
	float position[3]; /* NDC */
	float width;       /* NDC */
	float drawn;       /* NDC: of the width */
};

struct fin_edge {
	struct fin_end ends[2];
	float direction[2]; /* unit, from end 0 to end 1 */
	float outward[2];   /* unit */
	uint32_t next[2];   /* further edge end at the same vertex, or NO_END */
};

/* End i of edge e is numbered 2 e + i. */
static struct fin_edge *edge_of(const struct fin_scratch *scratch, uint32_t end)
{
	return &scratch->edges[end / 2];
}

struct quad_writer {
	const struct fin_params *params;
	float side; /* that is written: 1 outside, -1 inside */
	struct fin_vertex *out;
	size_t capacity, count;
	size_t left_out_count;
};

static void write_vertex(struct fin_vertex *out, const struct quad_writer *writer,
	const struct fin_end *end, const float offset[2])
{
	float x = writer->side * end->drawn * offset[0], y = writer->side * end->drawn * offset[1];
	*out = (struct fin_vertex){
		.position = {end->position[0] + x, end->position[1] + y, end->position[2]},
		.offset = {x, y},
		.width = writer->side * end->width,
	};
}

/* offsets: of the four vertices from their ends, in widths as drawn, as if outside */
static void write_quad(
	struct quad_writer *writer, const struct fin_end *const ends[4], const float offsets[4][2])
{
	if (writer->capacity - writer->count >= 4 && writer->count <= writer->capacity) {
		for (int i = 0; i < 4; i++)
			write_vertex(&writer->out[writer->count + (size_t)i], writer, ends[i],
				offsets[i]);
	}
	writer->count += 4;
}

static void write_edge(struct quad_writer *writer, const struct fin_edge *edge, float side)
{
	const struct fin_end *a = &edge->ends[0], *b = &edge->ends[1];
	const float *n = edge->outward;
	writer->side = side;
	if (fmaxf(a->drawn, b->drawn) > writer->params->finest)
		write_quad(writer, (const struct fin_end *const[]){a, b, b, a},
			(const float[4][2]){{0, 0}, {0, 0}, {n[0], n[1]}, {n[0], n[1]}});
	else
		writer->left_out_count++;
}

/* The sector between two unit normals; outer: unit, halfway between them, used when they are more
 * than a right angle apart. */
static void write_corner(struct quad_writer *writer, const struct fin_end *end, const float n0[2],
	const float n1[2], const float outer[2])
{
	float gap = end->drawn * hypotf(n0[0] - n1[0], n0[1] - n1[1]);
	if (!(gap > writer->params->finest))
		return;
	const struct fin_end *const ends[] = {end, end, end, end};
	if (n0[0] * n1[0] + n0[1] * n1[1] >= 0.0f) {
		/* A kite along the tangents; up to a right angle, the divisor is at least 2. */
		float x = n0[0] + n1[0], y = n0[1] + n1[1];
		float reach = 2.0f / (x * x + y * y);
		write_quad(writer, ends,
			(const float[4][2]){
				{0, 0}, {n0[0], n0[1]}, {x * reach, y * reach}, {n1[0], n1[1]}});
	} else {
		float x = outer[0], y = outer[1];
		write_quad(writer, ends,
			(const float[4][2]){{-y, x}, {-y + x, x + y}, {y + x, -x + y}, {y, -x}});
	}
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
	struct quad_writer *writer, const struct fin_edge *in, const struct fin_edge *out)
{
	const float *d0 = in->direction, *d1 = out->direction;
	float turn = d0[0] * d1[1] - d0[1] * d1[0];
	float along = d0[0] * d1[0] + d0[1] * d1[1];
	turn *= writer->params->mirrored ? -writer->side : writer->side;
	if (turn < 0.0f || (turn == 0.0f && along >= 0.0f))
		return;
	float outer[2] = {writer->side * (d0[0] - d1[0]), writer->side * (d0[1] - d1[1])};
	normalise(outer, 0.0f);
	write_corner(writer, &in->ends[1], in->outward, out->outward, outer);
}

/* Halfway between two normals, also when they are opposite. */
static void find_outer(const float n0[2], const float n1[2], float outer[2])
{
	outer[0] = n1[1] - n0[1];
	outer[1] = n0[0] - n1[0];
	if (outer[0] * (n0[0] + n1[0]) + outer[1] * (n0[1] + n1[1]) < 0.0f) {
		outer[0] = -outer[0];
		outer[1] = -outer[1];
	}
	normalise(outer, 0.0f);
}

/* Chan & Durand 2003, section 3, "Multiple edges": a shared fin along the mean of the normals,
 * joined to that of each edge. */
static void write_shared_corner(
	struct quad_writer *writer, const struct fin_scratch *scratch, uint32_t first)
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
		const struct fin_edge *edge = edge_of(scratch, end);
		float outer[2];
		find_outer(mean, edge->outward, outer);
		write_corner(writer, &edge->ends[end % 2], mean, edge->outward, outer);
	}
}

static void write_corners_at(
	struct quad_writer *writer, const struct fin_scratch *scratch, uint32_t first, float side)
{
	const struct fin_edge *edge = edge_of(scratch, first);
	uint32_t second = edge->next[first % 2];
	if (second == NO_END)
		return;
	writer->side = side;
	const struct fin_edge *other = edge_of(scratch, second);
	bool simple = other->next[second % 2] == NO_END && first % 2 != second % 2;
	if (!simple)
		write_shared_corner(writer, scratch, first);
	else if (first % 2 == 1)
		write_simple_corner(writer, edge, other);
	else
		write_simple_corner(writer, other, edge);
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

static double width_at(const struct fin_params *params, double z, double w)
{
	switch (params->width) {
	case FIN_WIDTH_CONSTANT:
		return params->scale;
	case FIN_WIDTH_PERSPECTIVE:
		return params->scale / w; /* w > 0 after clipping */
	case FIN_WIDTH_PARALLEL:
		return params->scale * (1.0 - z) / 2.0;
	}
	return 0.0;
}

/* 1 - b/r for a receiver at the far plane: (1 - d) / (K - d) at window depth d <= 1 < K. Along an
 * edge it bulges above the straight line that is drawn, but times a width of scale / w it is
 * straight: fins of constant width are drawn in full. */
static double drawn_share(const struct fin_params *params, double z)
{
	double d = (z + 1.0) / 2.0;
	if (params->width != FIN_WIDTH_PERSPECTIVE || !(params->pole > 1.0f))
		return 1.0;
	return (1.0 - d) / (params->pole - d);
}

static struct fin_end end_of(
	const struct fin_params *params, double x, double y, const double clip[4])
{
	double z = clamp(clip[2] / clip[3], -1.0, 1.0);
	double width = clamp(width_at(params, z, clip[3]), 0.0, NDC_LIMIT);
	return (struct fin_end){
		.position = {(float)x, (float)y, (float)z},
		.width = (float)width,
		.drawn = (float)clamp(
			width * drawn_share(params, z) + params->apron, 0.0, NDC_LIMIT),
	};
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
	double length = hypot(dx, dy);
	if (length <= COINCIDENT * largest)
		return false;
	float x = (float)(dx / length), y = (float)(dy / length);
	float side = params->mirrored ? -1.0f : 1.0f;
	edge->direction[0] = x;
	edge->direction[1] = y;
	edge->outward[0] = side * y;
	edge->outward[1] = side * -x;
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

size_t fins_max_vertices(size_t edge_count, bool both_sides)
{
	/* A quad an edge and one an end; saturates, so that allocating as much fails. */
	size_t most = both_sides ? 24 : 12;
	return edge_count <= SIZE_MAX / most ? most * edge_count : SIZE_MAX;
}

size_t fins_build(const struct caster *caster, const struct silhouette_edge *edges,
	size_t edge_count, const struct fin_params *params, struct fin_scratch *scratch,
	struct fin_vertex *out, size_t capacity)
{
	assert(edge_count <= scratch->edge_capacity);
	struct quad_writer writer = {.params = params, .out = out, .capacity = capacity};
	for (size_t e = 0; e < edge_count; e++) {
		struct fin_edge *edge = &scratch->edges[e];
		uint32_t a = edges[e].a, b = edges[e].b;
		bool cut[2] = {false, false};
		if (!project_edge(params, caster->positions[a], caster->positions[b], edge, cut))
			continue;
		write_edge(&writer, edge, 1.0f);
		if (params->both_sides)
			write_edge(&writer, edge, -1.0f);
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
			write_corners_at(&writer, scratch, *first, 1.0f);
			if (params->both_sides)
				write_corners_at(&writer, scratch, *first, -1.0f);
			*first = NO_END;
		}
	}
	scratch->left_out_count = writer.left_out_count;
	return writer.count;
}
