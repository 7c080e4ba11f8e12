/* SPDX-License-Identifier: MIT */
#include "fin_probe.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

const float perspective[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -1, 0, 0, -3, 0};

struct fin_params params_of(const float object_to_clip[16])
{
	struct fin_params params = {.law = fin_law_constant(0.1f)};
	memcpy(params.object_to_clip, object_to_clip, sizeof(params.object_to_clip));
	return params;
}

struct caster caster_of(const float (*positions)[3], size_t vertex_count)
{
	return (struct caster){.vertex_count = vertex_count, .positions = (float(*)[3])positions};
}

struct fins expand(const struct fin *built, size_t count, const struct fin_params *params)
{
	struct fins fins = {
		malloc(FIN_VERTICES_MAX * count * sizeof(*fins.vertices) + (count == 0)), 0};
	assert_non_null(fins.vertices);
	for (size_t i = 0; i < count; i++) {
		size_t expanded = fin_expand(
			&built[i], &params->law, params->both_sides, fins.vertices + fins.count);
		assert_in_range(expanded, 4, FIN_VERTICES_MAX);
		assert_int_equal(expanded, 4 * fin_quads(&built[i], params->both_sides));
		fins.count += expanded;
	}
	return fins;
}

struct fins build(const struct caster *caster, const struct silhouette_edge *edges,
	size_t edge_count, const struct fin_params *params)
{
	struct fin_scratch scratch;
	fin_scratch_init(&scratch);
	assert_true(fin_scratch_reserve(&scratch, caster, edge_count));
	size_t count = fins_build(caster, edges, edge_count, params, &scratch, NULL, 0);
	assert_true(count <= fins_max(edge_count));
	struct fin *built = malloc(count * sizeof(*built) + (count == 0));
	assert_non_null(built);
	assert_int_equal(
		fins_build(caster, edges, edge_count, params, &scratch, built, count), count);
	struct fins fins = expand(built, count, params);
	fins.left_out_count = scratch.left_out_count;
	free(built);
	for (size_t v = 0; v < scratch.vertex_capacity; v++)
		assert_int_equal(scratch.first[v], UINT32_MAX);
	fin_scratch_finish(&scratch);
	return fins;
}

struct fins build_positions(const float (*positions)[3], size_t vertex_count,
	const struct silhouette_edge *edges, size_t edge_count, const struct fin_params *params)
{
	struct caster caster = caster_of(positions, vertex_count);
	return build(&caster, edges, edge_count, params);
}

void assert_vertex(
	const struct fin_vertex *v, const float position[3], const float offset[2], float width)
{
	float off = 0.0f;
	for (int i = 0; i < 3; i++)
		off = fmaxf(off, fabsf(v->position[i] - position[i]));
	for (int i = 0; i < 2; i++)
		off = fmaxf(off, fabsf(v->offset[i] - offset[i]));
	off = fmaxf(off, fabsf(v->width - width));
	if (!(off <= CLOSE))
		fail_msg("(%g %g %g), (%g %g), %g is not (%g %g %g), (%g %g), %g", v->position[0],
			v->position[1], v->position[2], v->offset[0], v->offset[1], v->width,
			position[0], position[1], position[2], offset[0], offset[1], width);
}

float side(const float a[2], const float b[2], const float p[2])
{
	return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

bool covers(const struct fin_vertex quad[4], const float p[2])
{
	bool left = true, right = true;
	for (int i = 0; i < 4; i++) {
		float s = side(quad[i].position, quad[(i + 1) % 4].position, p);
		left = left && s >= -CLOSE;
		right = right && s <= CLOSE;
	}
	return left || right;
}

float alpha_at(const struct fins *fins, const float p[2])
{
	return alpha_on_side(fins, 1.0f, p);
}

float alpha_on_side(const struct fins *fins, float side, const float p[2])
{
	float alpha = 1.0f;
	for (size_t i = 0; i < fins->count; i += 4) {
		const struct fin_vertex *quad = &fins->vertices[i];
		if (quad[0].width * side <= 0.0f || !covers(quad, p))
			continue;
		/* Offsets are all "vertex minus silhouette", so that in quads of constant width the
		 * offset at p follows from any two edges of the quad, as on the GPU. */
		float u[2], v[2], q[2], d[2];
		for (int c = 0; c < 2; c++) {
			u[c] = quad[1].position[c] - quad[0].position[c];
			v[c] = quad[3].position[c] - quad[0].position[c];
			q[c] = p[c] - quad[0].position[c];
		}
		float det = u[0] * v[1] - u[1] * v[0];
		float s = (q[0] * v[1] - q[1] * v[0]) / det, t = (u[0] * q[1] - u[1] * q[0]) / det;
		for (int c = 0; c < 2; c++)
			d[c] = quad[0].offset[c] + s * (quad[1].offset[c] - quad[0].offset[c]) +
			       t * (quad[3].offset[c] - quad[0].offset[c]);
		alpha = fminf(alpha, hypotf(d[0], d[1]) / fabsf(quad[0].width));
	}
	return alpha;
}

float distance_at(const float (*positions)[3], const struct silhouette_edge *edges,
	size_t edge_count, float width, const float p[2])
{
	float least = width;
	for (size_t e = 0; e < edge_count; e++) {
		const float *a = positions[edges[e].a], *b = positions[edges[e].b];
		float dx = b[0] - a[0], dy = b[1] - a[1];
		float t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy);
		t = fminf(fmaxf(t, 0.0f), 1.0f);
		least = fminf(least, hypotf(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy));
	}
	return least / width;
}
