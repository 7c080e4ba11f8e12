/* SPDX-License-Identifier: MIT */
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* A square of two triangles in the plane z = 0, facing +z. */
static const float square[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
static const float up[4][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
static const uint32_t square_indices[6] = {0, 1, 2, 1, 3, 2};

static struct sm_mesh_desc square_desc(void)
{
	return (struct sm_mesh_desc){
		.name = "square",
		.positions = &square[0][0],
		.normals = &up[0][0],
		.vertex_count = 4,
		.indices = square_indices,
		.index_count = 6,
	};
}

static struct mesh made(const struct sm_mesh_desc *desc)
{
	struct mesh mesh;
	struct sm_error error = {.text = "no error given"};
	if (!mesh_init(&mesh, desc, &error))
		fail_msg("%s", error.text);
	return mesh;
}

static void keeps_what_is_drawn(void **state)
{
	(void)state;
	const float uvs[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
	struct sm_mesh_desc desc = square_desc();
	desc.uvs = &uvs[0][0];
	struct mesh mesh = made(&desc);
	assert_string_equal(mesh.name, "square");
	assert_int_equal(mesh.vertex_count, 4);
	assert_int_equal(mesh.index_count, 6);
	double area = 0.0;
	for (size_t t = 0; t < 2; t++) {
		const uint32_t *v = &mesh.indices[3 * t];
		double normal[3];
		face_normal(
			mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]], normal);
		area += normal[2] / 2.0;
	}
	assert_true(area == 1.0);
	for (size_t v = 0; v < 4; v++) {
		assert_memory_equal(mesh.uvs[v], mesh.positions[v], sizeof(mesh.uvs[v]));
		assert_memory_equal(mesh.normals[v], up[0], sizeof(up[0]));
	}
	for (int i = 0; i < 3; i++) {
		assert_true(mesh.min[i] == 0.0f);
		assert_true(mesh.max[i] == (i < 2 ? 1.0f : 0.0f));
	}
	mesh_finish(&mesh);
}

static void merges_identical_vertices(void **state)
{
	(void)state;
	float positions[6][3], normals[6][3];
	for (int i = 0; i < 6; i++) {
		memcpy(positions[i], square[square_indices[i]], sizeof(positions[i]));
		memcpy(normals[i], up[0], sizeof(normals[i]));
	}
	const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
	struct mesh mesh = made(&(struct sm_mesh_desc){.positions = &positions[0][0],
		.normals = &normals[0][0],
		.vertex_count = 6,
		.indices = indices,
		.index_count = 6});
	assert_null(mesh.name);
	assert_int_equal(mesh.stats.vertices, 4);
	assert_int_equal(mesh.stats.welded_vertices, 4);
	assert_int_equal(mesh.stats.edges, 5);
	assert_int_equal(mesh.stats.open_edges, 4);
	mesh_finish(&mesh);
}

static void welds_across_a_uv_seam(void **state)
{
	(void)state;
	const float positions[6][3] = {
		{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
	const float normals[6][3] = {
		{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
	const float uvs[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5f, 0}, {1, 1}, {0, 0.5f}};
	const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
	struct mesh mesh = made(&(struct sm_mesh_desc){.positions = &positions[0][0],
		.normals = &normals[0][0],
		.uvs = &uvs[0][0],
		.vertex_count = 6,
		.indices = indices,
		.index_count = 6});
	assert_int_equal(mesh.stats.vertices, 6);
	assert_int_equal(mesh.stats.welded_vertices, 4);
	assert_int_equal(mesh.stats.open_edges, 4);
	mesh_finish(&mesh);
}

static void welds_negative_zero(void **state)
{
	(void)state;
	const float positions[6][3] = {
		{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -0.0f, 0}, {1, 1, 0}, {-0.0f, 1, -0.0f}};
	const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
	struct mesh mesh = made(&(struct sm_mesh_desc){.positions = &positions[0][0],
		.vertex_count = 6,
		.indices = indices,
		.index_count = 6});
	assert_int_equal(mesh.stats.welded_vertices, 4);
	assert_int_equal(mesh.stats.vertices, 4);
	mesh_finish(&mesh);
}

static void drops_unused_vertices(void **state)
{
	(void)state;
	const float positions[5][3] = {{-9, 0, 0}, {0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {0, 1, 0}};
	const uint32_t indices[3] = {1, 2, 4};
	struct mesh mesh = made(&(struct sm_mesh_desc){.positions = &positions[0][0],
		.vertex_count = 5,
		.indices = indices,
		.index_count = 3});
	assert_int_equal(mesh.stats.vertices, 3);
	assert_int_equal(mesh.stats.welded_vertices, 3);
	assert_true(mesh.min[0] == 0.0f && mesh.max[0] == 1.0f && mesh.max[2] == 0.0f);
	mesh_finish(&mesh);
}

static void makes_flat_normals(void **state)
{
	(void)state;
	struct model cube = model_cube();
	struct sm_mesh_desc desc = model_desc(&cube, "cube");
	struct mesh mesh = made(&desc);
	/* Each corner of the cube needs three normals; the two triangles of a face share theirs. */
	assert_int_equal(mesh.stats.vertices, 24);
	assert_int_equal(mesh.stats.welded_vertices, 8);
	for (size_t i = 0; i < mesh.index_count; i++) {
		const float *n = mesh.normals[mesh.indices[i]];
		const float *p = mesh.positions[mesh.indices[i]];
		assert_true(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] == 1.0f);
		assert_true(fabsf(n[0]) + fabsf(n[1]) + fabsf(n[2]) == 1.0f);
	}
	mesh_finish(&mesh);
	model_finish(&cube);
}

static void repairs_normals(void **state)
{
	(void)state;
	/* Facing +x, and a triangle without area, with a vertex of its own. */
	const float positions[5][3] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {0, 2, 0}};
	const uint32_t indices[9] = {0, 1, 2, 1, 3, 2, 0, 1, 4};
	const struct {
		float given[3], expected[3];
		bool has_direction;
	} cases[] = {
		{{0, 0, 0}, {1, 0, 0}, false},
		{{NAN, 0, 0}, {1, 0, 0}, false},
		{{0, INFINITY, 0}, {1, 0, 0}, false},
		{{0, 5, 0}, {0, 1, 0}, true},
		{{1e-30f, 0, 0}, {1, 0, 0}, true},
		{{0, 3e38f, 0}, {0, 1, 0}, true},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		float normals[5][3];
		for (int v = 0; v < 5; v++)
			memcpy(normals[v], cases[i].given, sizeof(normals[v]));
		struct mesh mesh = made(&(struct sm_mesh_desc){.positions = &positions[0][0],
			.normals = &normals[0][0],
			.vertex_count = 5,
			.indices = indices,
			.index_count = 9});
		for (size_t v = 0; v < mesh.vertex_count; v++) {
			bool lonely = mesh.positions[v][1] == 2.0f && !cases[i].has_direction;
			assert_memory_equal(
				mesh.normals[v], lonely ? up[0] : cases[i].expected, sizeof(up[0]));
		}
		mesh_finish(&mesh);
	}
}

static void zeroes_broken_uvs(void **state)
{
	(void)state;
	const float uvs[4][2] = {{NAN, 1}, {1, INFINITY}, {NAN, NAN}, {-INFINITY, 0}};
	struct sm_mesh_desc desc = square_desc();
	desc.uvs = &uvs[0][0];
	struct mesh mesh = made(&desc);
	for (size_t v = 0; v < mesh.vertex_count; v++)
		assert_true(mesh.uvs[v][0] == 0.0f && mesh.uvs[v][1] == 0.0f);
	mesh_finish(&mesh);
}

static void counts_triangles_without_area(void **state)
{
	(void)state;
	const float positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
	const uint32_t indices[9] = {
		0, 1, 3, /* on a line: */ 0, 1, 2, /* twice the same: */ 3, 3, 1};
	struct mesh mesh = made(&(struct sm_mesh_desc){.positions = &positions[0][0],
		.vertex_count = 4,
		.indices = indices,
		.index_count = 9});
	assert_int_equal(mesh.stats.triangles, 3);
	assert_int_equal(mesh.stats.degenerate_triangles, 2);
	assert_int_equal(mesh.stats.edges, 5);
	assert_int_equal(mesh.stats.inverted_edges, 1);
	for (size_t i = 0; i < mesh.index_count; i++)
		assert_true(mesh.normals[mesh.indices[i]][2] == 1.0f);
	mesh_finish(&mesh);
}

static void refuses(const struct sm_mesh_desc *desc, const char *message)
{
	struct mesh mesh;
	struct sm_error error = {0};
	assert_false(mesh_init(&mesh, desc, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_string_equal(error.text, message);
	assert_false(mesh_init(&mesh, desc, NULL));
}

static void refuses_bad_counts(void **state)
{
	(void)state;
	const struct {
		size_t vertex_count, index_count;
		const char *message;
	} cases[] = {
		{4, 0, "mesh square: no triangle"},
		{4, 5, "mesh square: 5 indices, not a multiple of 3"},
		{3, 6, "mesh square: index 4 is 3, but there are 3 vertices"},
		{0, 3, "mesh square: index 0 is 0, but there are 0 vertices"},
		{4, 3 * (size_t)INT32_MAX + 3,
			"mesh square: 2147483648 triangles, above 2147483647"},
		{(size_t)UINT32_MAX, 6, "mesh square: 4294967295 vertices, above 4294967294"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_mesh_desc desc = square_desc();
		desc.vertex_count = cases[i].vertex_count;
		desc.index_count = cases[i].index_count;
		refuses(&desc, cases[i].message);
	}
	struct sm_mesh_desc flat = square_desc();
	flat.normals = NULL;
	flat.index_count = 3 * (size_t)INT32_MAX;
	refuses(&flat, "mesh square: 6442450941 corners without normals, above 4294967294");
}

static void refuses_positions_that_are_not_finite(void **state)
{
	(void)state;
	const float bad[] = {NAN, INFINITY, -INFINITY};
	for (size_t b = 0; b < 3; b++) {
		for (size_t i = 0; i < 3; i++) {
			float positions[4][3];
			memcpy(positions, square, sizeof(square));
			positions[2][i] = bad[b];
			struct sm_mesh_desc desc = square_desc();
			desc.positions = &positions[0][0];
			refuses(&desc, "mesh square: the position of vertex 2 is not finite");
		}
	}
}

static void names_a_mesh_without_name(void **state)
{
	(void)state;
	struct sm_mesh_desc desc = square_desc();
	desc.name = NULL;
	desc.index_count = 0;
	refuses(&desc, "mesh (unnamed): no triangle");
}

static void finish_takes_an_empty_mesh(void **state)
{
	(void)state;
	struct mesh mesh = {0};
	mesh_finish(&mesh);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(keeps_what_is_drawn),
		cmocka_unit_test(merges_identical_vertices),
		cmocka_unit_test(welds_across_a_uv_seam),
		cmocka_unit_test(welds_negative_zero),
		cmocka_unit_test(drops_unused_vertices),
		cmocka_unit_test(makes_flat_normals),
		cmocka_unit_test(repairs_normals),
		cmocka_unit_test(zeroes_broken_uvs),
		cmocka_unit_test(counts_triangles_without_area),
		cmocka_unit_test(refuses_bad_counts),
		cmocka_unit_test(refuses_positions_that_are_not_finite),
		cmocka_unit_test(names_a_mesh_without_name),
		cmocka_unit_test(finish_takes_an_empty_mesh),
	};
	return cmocka_run_group_tests_name("mesh", tests, NULL, NULL);
}
