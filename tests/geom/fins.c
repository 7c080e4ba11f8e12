/* SPDX-License-Identifier: MIT */
#include "fin_probe.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void an_edge_becomes_a_quad_on_its_right(void **state)
{
	(void)state;
	const float positions[2][3] = {{-0.5f, 0, 0.25f}, {0.5f, 0, -0.25f}};
	const struct silhouette_edge edge = {0, 1};
	struct fin_params params = params_of(identity);
	for (int mirrored = 0; mirrored < 2; mirrored++) {
		params.mirrored = mirrored;
		float y = mirrored ? 0.1f : -0.1f;
		struct fins fins = build_positions(positions, 2, &edge, 1, &params);
		assert_int_equal(fins.count, 4);
		const struct fin_vertex *v = fins.vertices;
		/* The order is reversed where mirrored, so that the outside stays on the right. */
		int a = mirrored ? 1 : 0, b = 1 - a, c = b + 2 * a + 1, d = 5 - c;
		assert_vertex(&v[a], (float[]){-0.5f, 0, 0.25f}, (float[]){0, 0}, 0.1f);
		assert_vertex(&v[b], (float[]){0.5f, 0, -0.25f}, (float[]){0, 0}, 0.1f);
		assert_vertex(&v[c], (float[]){0.5f, y, -0.25f}, (float[]){0, y}, 0.1f);
		assert_vertex(&v[d], (float[]){-0.5f, y, 0.25f}, (float[]){0, y}, 0.1f);
		free(fins.vertices);
	}
}

static void widths_follow_their_law(void **state)
{
	(void)state;
	/* At the near plane, w = 1 and z = 0 in window space, and at the far plane, w = 3, z = 1.
	 */
	const float positions[2][3] = {{-1, 0, -1}, {3, 0, -3}};
	const struct silhouette_edge edge = {0, 1};
	const struct {
		struct fin_law law;
		float near, far, drawn_near, drawn_far;
	} cases[] = {
		{fin_law_constant(0.3f), 0.3f, 0.3f, 0.3f, 0.3f},
		{fin_law_perspective(0.3f, 1, 3), 0.3f, 0.1f, 0.2f, 0},
		{fin_law_parallel(0.3f), 0.3f, 0, 0.3f, 0},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct fin_params params = params_of(perspective);
		params.law = cases[i].law;
		struct fins fins = build_positions(positions, 2, &edge, 1, &params);
		assert_int_equal(fins.count, 4);
		float near = cases[i].near, far = cases[i].far;
		const struct fin_vertex *v = fins.vertices;
		assert_vertex(&v[0], (float[]){-1, 0, -1}, (float[]){0, 0}, near);
		assert_vertex(&v[1], (float[]){1, 0, 1}, (float[]){0, 0}, far);
		float y0 = -cases[i].drawn_near, y1 = -cases[i].drawn_far;
		assert_vertex(&v[2], (float[]){1, y1, 1}, (float[]){0, y1}, far);
		assert_vertex(&v[3], (float[]){-1, y0, -1}, (float[]){0, y0}, near);
		free(fins.vertices);
	}
}

static void no_width_no_fin(void **state)
{
	(void)state;
	const float positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
	const struct silhouette_edge edges[] = {{0, 1}, {1, 2}};
	const float scales[] = {0.0f, -1.0f, NAN};
	for (size_t i = 0; i < 3; i++) {
		struct fin_params params = params_of(identity);
		params.law = fin_law_constant(scales[i]);
		struct fins fins = build_positions(positions, 3, edges, 2, &params);
		assert_int_equal(fins.count, 0);
		free(fins.vertices);
	}
}

struct polygon {
	size_t corners;
	float positions[12][3];
	struct silhouette_edge edges[12];
};

/* Anticlockwise around the origin; every other corner of a star is nearer to it. */
static struct polygon polygon_of(size_t corners, bool star)
{
	struct polygon polygon = {.corners = corners};
	for (size_t i = 0; i < corners; i++) {
		float angle = 6.2831853f * (float)i / (float)corners;
		float radius = star && i % 2 ? 0.25f : 0.5f;
		polygon.positions[i][0] = radius * cosf(angle);
		polygon.positions[i][1] = radius * sinf(angle);
		polygon.edges[i] =
			(struct silhouette_edge){(uint32_t)i, (uint32_t)((i + 1) % corners)};
	}
	return polygon;
}

static bool inside_polygon(const struct polygon *polygon, const float p[2])
{
	float winding = 0.0f;
	for (size_t e = 0; e < polygon->corners; e++) {
		const float *a = polygon->positions[polygon->edges[e].a];
		const float *b = polygon->positions[polygon->edges[e].b];
		winding += atan2f(side(p, a, b),
			(a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]));
	}
	return fabsf(winding) >= 3.0f;
}

static void check_polygon(const struct polygon *polygon, const struct fin_params *params)
{
	struct fins fins =
		build_positions(polygon->positions, 12, polygon->edges, polygon->corners, params);
	uint64_t random = 3;
	for (int i = 0; i < 2000; i++) {
		float p[2] = {random_signed(&random), random_signed(&random)};
		bool inside = inside_polygon(polygon, p);
		if (inside && !params->both_sides)
			continue;
		float expected =
			distance_at(polygon->positions, polygon->edges, polygon->corners, 0.1f, p);
		float alpha = alpha_on_side(&fins, inside ? -1.0f : 1.0f, p);
		assert_true(fabsf(alpha - expected) < 1e-4f);
	}
	free(fins.vertices);
}

/* Blockers with corners of all angles: alpha is the distance from the silhouette. */
static void alpha_is_the_distance_from_a_polygon(void **state)
{
	(void)state;
	struct fin_params params = params_of(identity);
	for (size_t i = 0; i < 40; i++) {
		struct polygon polygon = polygon_of(3 + i / 4, i % 2);
		params.both_sides = i % 4 >= 2;
		check_polygon(&polygon, &params);
	}
}

/* Corners share the fins of their edges, whichever way round and on whichever sides these are. */
static void a_loop_takes_a_fin_an_edge(void **state)
{
	(void)state;
	for (size_t i = 0; i < 40; i++) {
		struct polygon polygon = polygon_of(4 + i / 8, i % 2);
		struct caster caster = caster_of(polygon.positions, 12);
		struct fin_params params = params_of(identity);
		struct fin_scratch scratch;
		params.both_sides = i % 4 >= 2;
		params.mirrored = i % 8 >= 4;
		fin_scratch_init(&scratch);
		assert_true(fin_scratch_reserve(&scratch, &caster, polygon.corners));
		assert_int_equal(fins_build(&caster, polygon.edges, polygon.corners, &params,
					 &scratch, NULL, 0),
			polygon.corners);
		fin_scratch_finish(&scratch);
		struct fins fins = build_positions(
			polygon.positions, 12, polygon.edges, polygon.corners, &params);
		/* A corner on one side or the other. */
		assert_true(!params.both_sides || fins.count == 12 * polygon.corners);
		free(fins.vertices);
	}
}

static void an_apron_widens_what_is_drawn_alone(void **state)
{
	(void)state;
	const float positions[2][3] = {{-0.5f, 0, 0.25f}, {0.5f, 0, -0.25f}};
	const struct silhouette_edge edge = {0, 1};
	struct fin_params params = params_of(identity);
	fin_law_add_apron(&params.law, 0.05f);
	params.both_sides = true;
	struct fins fins = build_positions(positions, 2, &edge, 1, &params);
	assert_int_equal(fins.count, 8);
	for (int quad = 0; quad < 2; quad++) {
		const struct fin_vertex *v = &fins.vertices[4 * quad];
		float width = quad == 0 ? 0.1f : -0.1f, y = quad == 0 ? -0.15f : 0.15f;
		assert_vertex(&v[0], (float[]){-0.5f, 0, 0.25f}, (float[]){0, 0}, width);
		assert_vertex(&v[1], (float[]){0.5f, 0, -0.25f}, (float[]){0, 0}, width);
		assert_vertex(&v[2], (float[]){0.5f, y, -0.25f}, (float[]){0, y}, width);
		assert_vertex(&v[3], (float[]){-0.5f, y, 0.25f}, (float[]){0, y}, width);
	}
	free(fins.vertices);
}

/* Seen in a mirror, the same polygon has the same fins, mirrored. */
static void corners_swap_when_mirrored(void **state)
{
	(void)state;
	const float positions[4][3] = {{0, 0, 0}, {0.5f, 0, 0}, {0.1f, 0.1f, 0}, {0, 0.5f, 0}};
	const struct silhouette_edge edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
	struct fin_params params = params_of(identity);
	struct fins plain = build_positions(positions, 4, edges, 4, &params);
	assert_int_equal(plain.count, 4 * 4 + 3 * 4);
	params.object_to_clip[0] = -1.0f;
	params.mirrored = true;
	struct fins mirrored = build_positions(positions, 4, edges, 4, &params);
	assert_int_equal(mirrored.count, plain.count);
	uint64_t random = 5;
	for (int i = 0; i < 1000; i++) {
		float p[2] = {random_signed(&random), random_signed(&random)};
		float q[2] = {-p[0], p[1]};
		assert_true(fabsf(alpha_at(&plain, p) - alpha_at(&mirrored, q)) < 1e-4f);
	}
	free(plain.vertices);
	free(mirrored.vertices);
}

/* Two edges from (0,0) to the right and on at an angle; the blocker is above. */
static void only_convex_corners_are_filled(void **state)
{
	(void)state;
	const struct {
		float x, y;
		size_t corners;
	} cases[] = {{1, 0.5f, 1}, {0.5f, 0.5f, 1}, {0, 0.5f, 1}, {1, 0, 0}, {1, -0.5f, 0},
		{0.5f, -0.5f, 0}, {0, -0.5f, 0}, {0, 0, 1}, {0.25f, 0, 1}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		const float positions[3][3] = {
			{0, 0, 0}, {0.5f, 0, 0}, {cases[i].x, cases[i].y, 0}};
		const struct silhouette_edge edges[] = {{0, 1}, {1, 2}};
		struct fin_params params = params_of(identity);
		struct fins fins = build_positions(positions, 3, edges, 2, &params);
		assert_int_equal(fins.count, 8 + 4 * cases[i].corners);
		free(fins.vertices);
	}
}

static void a_full_turn_gets_half_a_disc(void **state)
{
	(void)state;
	const float positions[2][3] = {{0, 0, 0}, {0.5f, 0, 0}};
	const struct silhouette_edge edges[] = {{0, 1}, {1, 0}};
	struct fin_params params = params_of(identity);
	for (int mirrored = 0; mirrored < 2; mirrored++) {
		params.mirrored = mirrored;
		struct fins fins = build_positions(positions, 2, edges, 2, &params);
		assert_int_equal(fins.count, 16);
		uint64_t random = 9;
		for (int i = 0; i < 1000; i++) {
			float p[2] = {random_signed(&random), random_signed(&random)};
			float expected = distance_at(positions, edges, 2, 0.1f, p);
			assert_true(fabsf(alpha_at(&fins, p) - expected) < 1e-4f);
		}
		free(fins.vertices);
	}
}

static bool is_along_edge(const struct fin_vertex quad[4])
{
	return quad[1].offset[0] == 0.0f && quad[1].offset[1] == 0.0f;
}

/* Two blockers that touch in one point of the silhouette. */
static void more_than_two_edges_share_a_normal(void **state)
{
	(void)state;
	const float positions[5][3] = {
		{0, 0, 0}, {-0.5f, 0.2f, 0}, {-0.5f, 0.5f, 0}, {0.5f, 0.2f, 0}, {0.5f, 0.5f, 0}};
	const struct silhouette_edge edges[] = {{1, 0}, {0, 2}, {4, 0}, {0, 3}};
	struct fin_params params = params_of(identity);
	struct fins fins = build_positions(positions, 5, edges, 4, &params);
	assert_int_equal(fins.count, 4 * 4 + 4 * 4);
	float mean[2] = {0, 0};
	const float *normals[4];
	size_t edge_count = 0;
	for (size_t i = 0; i < fins.count; i += 4) {
		if (!is_along_edge(&fins.vertices[i]))
			continue;
		assert_true(edge_count < 4);
		normals[edge_count] = fins.vertices[i + 2].offset;
		for (int c = 0; c < 2; c++)
			mean[c] += normals[edge_count][c];
		edge_count++;
	}
	assert_int_equal(edge_count, 4);
	float length = hypotf(mean[0], mean[1]);
	for (size_t i = 0; i < fins.count; i += 4) {
		if (is_along_edge(&fins.vertices[i]))
			continue;
		/* Each joins the shared normal to an edge's: both outer ends are covered, at
		 * alpha 1. */
		float shared[2] = {0.1f * mean[0] / length, 0.1f * mean[1] / length};
		assert_true(covers(&fins.vertices[i], shared));
		bool joins = false;
		for (size_t e = 0; e < 4; e++)
			joins = joins || covers(&fins.vertices[i], normals[e]);
		assert_true(joins);
	}
	free(fins.vertices);
}

static void opposite_normals_have_no_mean(void **state)
{
	(void)state;
	const float positions[5][3] = {
		{0, 0, 0}, {-0.5f, 0, 0}, {0.5f, 0, 0}, {0, -0.5f, 0}, {0, 0.5f, 0}};
	const struct silhouette_edge edges[] = {{1, 0}, {0, 2}, {2, 0}, {0, 1}, {3, 0}, {4, 0}};
	struct fin_params params = params_of(identity);
	struct fins fins = build_positions(positions, 5, edges, 6, &params);
	/* The ends (0.5, 0) and (-0.5, 0) are simple; the middle has no shared fin. */
	assert_int_equal(fins.count, 6 * 4 + 2 * 4);
	free(fins.vertices);
}

static void edges_seen_end_on_are_left_out(void **state)
{
	(void)state;
	const float positions[4][3] = {{0, 0, 0}, {0, 0, 0.5f}, {1e-7f, 0, 0.9f}, {0.5f, 0, 0}};
	const struct silhouette_edge edges[] = {{0, 1}, {1, 2}, {0, 3}};
	struct fin_params params = params_of(identity);
	struct fins fins = build_positions(positions, 4, edges, 3, &params);
	assert_int_equal(fins.count, 4);
	assert_true(fins.vertices[1].position[0] == 0.5f);
	free(fins.vertices);
}

/* An end at the light itself, where every direction of the screen meets. */
static void edges_that_end_nowhere_are_left_out(void **state)
{
	(void)state;
	const float all_w[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0};
	const float positions[2][3] = {{0, 0, 0}, {0.5f, 0.5f, 1}};
	const struct silhouette_edge edge = {0, 1};
	struct fin_params params = params_of(all_w);
	struct fins fins = build_positions(positions, 2, &edge, 1, &params);
	assert_int_equal(fins.count, 0);
	free(fins.vertices);
}

static void edges_are_cut_at_the_near_plane(void **state)
{
	(void)state;
	/* From w = 2 to w = 0, at x = 1: the near plane is met at w = 1, x / w = 1. */
	const float positions[4][3] = {{1, 0, -2}, {1, 0, 0}, {1, 1, 5}, {0, 0, -2}};
	const struct silhouette_edge edges[] = {{0, 1}, {1, 2}, {2, 0}, {3, 0}};
	struct fin_params params = params_of(perspective);
	params.law = fin_law_perspective(0.1f, 1, 3);
	struct fins one = build_positions(positions, 4, edges, 1, &params);
	assert_int_equal(one.count, 4);
	const struct fin_vertex *v = one.vertices;
	assert_vertex(&v[0], (float[]){0.5f, 0, 0.5f}, (float[]){0, 0}, 0.05f);
	assert_vertex(&v[1], (float[]){1, 0, -1}, (float[]){0, 0}, 0.1f);
	float near = -0.2f / 3, far = -0.05f / 3;
	assert_vertex(&v[2], (float[]){1, near, -1}, (float[]){0, near}, 0.1f);
	assert_vertex(&v[3], (float[]){0.5f, far, 0.5f}, (float[]){0, far}, 0.05f);
	free(one.vertices);

	struct fins behind = build_positions(positions, 4, &edges[1], 1, &params);
	assert_int_equal(behind.count, 0);
	free(behind.vertices);

	/* What meets behind the near plane has no corner there; what meets in front has. */
	const struct silhouette_edge meets_behind[] = {{0, 1}, {1, 3}};
	struct fins open = build_positions(positions, 4, meets_behind, 2, &params);
	struct fins loop = build_positions(positions, 4, edges, 3, &params);
	struct fins shared = build_positions(positions, 4, edges, 4, &params);
	assert_int_equal(open.count, 2 * 4);
	assert_int_equal(loop.count, 2 * 4 + 4);
	assert_int_equal(shared.count, 3 * 4 + 3 * 4);
	free(open.vertices);
	free(loop.vertices);
	free(shared.vertices);
}

/* They are cut far outside the screen, and stay on the same line. */
static void edges_far_off_the_screen_keep_their_line(void **state)
{
	(void)state;
	const float ends[][2] = {
		{8e6f, 2e6f}, {-8e6f, 2e6f}, {-2e6f, -8e6f}, {2e6f, 8e6f}, {3e38f, 1e38f}};
	for (size_t i = 0; i < sizeof(ends) / sizeof(ends[0]); i++) {
		const float positions[2][3] = {{0, 0, 0}, {ends[i][0], ends[i][1], 0}};
		const struct silhouette_edge edge = {0, 1};
		struct fin_params params = params_of(identity);
		struct fins fins = build_positions(positions, 2, &edge, 1, &params);
		assert_int_equal(fins.count, 4);
		float length = hypotf(ends[i][0] / 1e6f, ends[i][1] / 1e6f) * 1e6f;
		const float *far = fins.vertices[1].position, *offset = fins.vertices[2].offset;
		assert_true(hypotf(far[0], far[1]) > 1000.0f);
		assert_true(fabsf(offset[0] - 0.1f * ends[i][1] / length) <= CLOSE);
		assert_true(fabsf(offset[1] + 0.1f * ends[i][0] / length) <= CLOSE);
		assert_true(fabsf(far[0] / far[1] - ends[i][0] / ends[i][1]) <= 1e-5f);
		free(fins.vertices);
	}
}

static struct fin_law random_law(uint64_t *random, const float *values, size_t count)
{
	float scale = values[random_next(random) % count];
	switch (random_next(random) % 3) {
	case 0:
		return fin_law_constant(scale);
	case 1:
		return fin_law_parallel(scale);
	default:
		return fin_law_perspective(scale, values[random_next(random) % count],
			values[random_next(random) % count]);
	}
}

static void everything_written_is_finite(void **state)
{
	(void)state;
	const float extreme[] = {
		0, -0.0f, 1e-45f, 1e-30f, 1, -1, 2e3f, -1e30f, 3e38f, INFINITY, NAN};
	const size_t extremes = sizeof(extreme) / sizeof(extreme[0]);
	uint64_t random = 13;
	float positions[8][3];
	struct silhouette_edge edges[12];
	for (int round = 0; round < 20000; round++) {
		struct fin_params params = {
			.law = random_law(&random, extreme, extremes),
			.both_sides = round % 3 == 0,
			.mirrored = random_next(&random) % 2,
		};
		/* Extreme values are rare enough that most rounds leave something to see. */
		size_t kinds = round % 2 == 0 ? 7 : extremes;
		for (int i = 0; i < 16; i++)
			params.object_to_clip[i] = random_next(&random) % 4 != 0
							   ? perspective[i]
							   : extreme[random_next(&random) % kinds];
		for (int v = 0; v < 8; v++)
			for (int c = 0; c < 3; c++)
				positions[v][c] = random_next(&random) % 2
							  ? 4.0f * random_signed(&random)
							  : extreme[random_next(&random) % 9];
		for (int e = 0; e < 12; e++)
			edges[e] = (struct silhouette_edge){
				random_next(&random) % 8, random_next(&random) % 8};
		struct fins fins =
			build_positions((const float(*)[3])positions, 8, edges, 12, &params);
		for (size_t i = 0; i < fins.count; i++) {
			const struct fin_vertex *v = &fins.vertices[i];
			for (int c = 0; c < 3; c++)
				assert_true(isfinite(v->position[c]));
			assert_true(fabsf(v->position[2]) <= 1.0f);
			assert_true(isfinite(v->offset[0]) && isfinite(v->offset[1]));
			assert_true(isfinite(v->width) && (v->width >= 0.0f || params.both_sides));
		}
		free(fins.vertices);
	}
}

static void writes_up_to_capacity(void **state)
{
	(void)state;
	const float positions[3][3] = {{0, 0, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}};
	const struct silhouette_edge edges[] = {{0, 1}, {1, 2}, {2, 0}};
	struct caster caster = caster_of(positions, 3);
	struct fin_params params = params_of(identity);
	struct fin all[3];
	struct fin_scratch scratch;
	fin_scratch_init(&scratch);
	assert_true(fin_scratch_reserve(&scratch, &caster, 3));
	assert_int_equal(fins_build(&caster, edges, 3, &params, &scratch, all, 3), 3);
	for (size_t capacity = 1; capacity <= 3; capacity++) {
		struct fin *exact = malloc(capacity * sizeof(*exact));
		assert_non_null(exact);
		assert_int_equal(
			fins_build(&caster, edges, 3, &params, &scratch, exact, capacity), 3);
		assert_memory_equal(exact, all, capacity * sizeof(*exact));
		free(exact);
	}
	fin_scratch_finish(&scratch);
}

static void scratch_grows_and_refuses(void **state)
{
	(void)state;
	const float positions[2][3] = {{0, 0, 0}, {0.5f, 0, 0}};
	struct caster small = caster_of(positions, 2);
	struct caster huge = {.vertex_count = SIZE_MAX};
	struct fin_scratch scratch;
	fin_scratch_init(&scratch);
	assert_true(fin_scratch_reserve(&scratch, &small, 1));
	assert_false(fin_scratch_reserve(&scratch, &small, UINT32_MAX));
	assert_false(fin_scratch_reserve(&scratch, &huge, 1));
	assert_true(fin_scratch_reserve(&scratch, &small, 1000));
	assert_int_equal(fins_max(1000), 2000);
	assert_int_equal(fins_max(SIZE_MAX / 2 + 1), SIZE_MAX);
	fin_scratch_finish(&scratch);
}

static void check_model(const char *name, const struct model *model)
{
	struct sm_mesh_desc desc = model_desc(model, name);
	struct mesh mesh;
	assert_true(mesh_init(&mesh, &desc, NULL));
	size_t capacity = edge_table_records(&mesh.caster.edges);
	uint64_t *facing = malloc(facing_words(&mesh.caster) * sizeof(*facing));
	struct silhouette_edge *edges = malloc(capacity * sizeof(*edges) + 1);
	assert_true(facing != NULL && edges != NULL);
	facing_find(&mesh.caster, (const float[4]){0, 0, 1, 0}, facing);
	size_t count = silhouette_find(&mesh.caster, facing, edges, capacity);

	/* An orthographic light along -z that sees all of the mesh. */
	const struct face_planes *planes = &mesh.caster.planes;
	struct fin_params params = {.law = fin_law_parallel(0.05f)};
	for (int i = 0; i < 3; i++) {
		double scale = (i == 2 ? -0.9 : 0.9) / planes->radius;
		params.object_to_clip[5 * i] = (float)scale;
		params.object_to_clip[12 + i] = (float)(-scale * planes->center[i]);
	}
	params.object_to_clip[15] = 1.0f;
	struct fins fins = build(&mesh.caster, edges, count, &params);
	assert_true(count == 0 || fins.count > 0);
	for (size_t i = 0; i < fins.count; i++)
		assert_true(hypotf(fins.vertices[i].offset[0], fins.vertices[i].offset[1]) <=
			    1.4143f * fins.vertices[i].width);
	free(fins.vertices);
	free(edges);
	free(facing);
	mesh_finish(&mesh);
}

static void takes_every_model(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(an_edge_becomes_a_quad_on_its_right),
		cmocka_unit_test(widths_follow_their_law),
		cmocka_unit_test(no_width_no_fin),
		cmocka_unit_test(alpha_is_the_distance_from_a_polygon),
		cmocka_unit_test(a_loop_takes_a_fin_an_edge),
		cmocka_unit_test(an_apron_widens_what_is_drawn_alone),
		cmocka_unit_test(corners_swap_when_mirrored),
		cmocka_unit_test(only_convex_corners_are_filled),
		cmocka_unit_test(a_full_turn_gets_half_a_disc),
		cmocka_unit_test(more_than_two_edges_share_a_normal),
		cmocka_unit_test(opposite_normals_have_no_mean),
		cmocka_unit_test(edges_seen_end_on_are_left_out),
		cmocka_unit_test(edges_that_end_nowhere_are_left_out),
		cmocka_unit_test(edges_are_cut_at_the_near_plane),
		cmocka_unit_test(edges_far_off_the_screen_keep_their_line),
		cmocka_unit_test(everything_written_is_finite),
		cmocka_unit_test(writes_up_to_capacity),
		cmocka_unit_test(scratch_grows_and_refuses),
		cmocka_unit_test(takes_every_model),
	};
	return cmocka_run_group_tests_name("fins", tests, NULL, NULL);
}
