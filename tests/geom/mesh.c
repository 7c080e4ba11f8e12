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

/* A power of two rounds nothing: what coincides, how parts are wound, and the order of triangles,
 * which goes by how they lie to each other, stay. */
static float *scaled(const struct model *model)
{
	float *positions = test_malloc(model->vertex_count * sizeof(*model->positions));
	for (size_t i = 0; i < 3 * model->vertex_count; i++)
		positions[i] = 4 * model->positions[i / 3][i % 3];
	return positions;
}

static void check_same_caster(const struct caster *got, const struct caster *expected)
{
	assert_int_equal(got->vertex_count, expected->vertex_count);
	assert_int_equal(got->triangle_count, expected->triangle_count);
	assert_memory_equal(
		got->positions, expected->positions, got->vertex_count * sizeof(*got->positions));
	assert_memory_equal(
		got->indices, expected->indices, 3 * got->triangle_count * sizeof(*got->indices));
	assert_memory_equal(
		got->planes.values, expected->planes.values, face_planes_bytes(&expected->planes));
	assert_memory_equal(
		got->planes.center, expected->planes.center, sizeof(got->planes.center));
	assert_true(got->planes.radius == expected->planes.radius);
	assert_int_equal(got->planes.degenerate, expected->planes.degenerate);
}

/* As if it had been made there. */
static void check_moved(const char *name, const struct model *model)
{
	float *positions = scaled(model), *normals = test_calloc(model->vertex_count, 12);
	bool changed;
	for (size_t v = 0; v < model->vertex_count; v++)
		normals[3 * v + 1] = 1;
	struct sm_mesh_desc desc = model_desc(model, name);
	desc.normals = normals;
	struct mesh mesh = made(&desc);
	desc.positions = positions;
	struct mesh expected = made(&desc);
	assert_true(mesh_set_vertices(&mesh, positions, normals, &changed, NULL));
	assert_true(changed);
	assert_int_equal(mesh.vertex_count, expected.vertex_count);
	size_t bytes = mesh.vertex_count * sizeof(*mesh.positions);
	assert_memory_equal(mesh.positions, expected.positions, bytes);
	assert_memory_equal(mesh.normals, expected.normals, bytes);
	assert_memory_equal(mesh.min, expected.min, sizeof(mesh.min));
	assert_memory_equal(mesh.max, expected.max, sizeof(mesh.max));
	check_same_caster(&mesh.caster, &expected.caster);
	assert_memory_equal(&mesh.stats, &expected.stats, sizeof(mesh.stats));
	assert_false(mesh.solid);
	mesh_finish(&mesh);
	mesh_finish(&expected);
	test_free(positions);
	test_free(normals);
}

static void moves_as_if_made_there(void **state)
{
	(void)state;
	models_visit("/nowhere", check_moved);
}

static void moves_back_to_each_bit(void **state)
{
	(void)state;
	struct model sphere = model_sphere(2);
	struct sm_mesh_desc desc = model_desc(&sphere, "sphere");
	struct mesh mesh = made(&desc), expected = made(&desc);
	float *positions = scaled(&sphere);
	bool changed;
	assert_true(mesh.solid);
	assert_true(mesh_set_vertices(&mesh, desc.positions, NULL, &changed, NULL));
	assert_true(changed && !mesh.solid);
	assert_true(mesh_set_vertices(&mesh, desc.positions, NULL, &changed, NULL));
	assert_false(changed);
	assert_true(mesh_set_vertices(&mesh, positions, NULL, &changed, NULL));
	assert_true(changed && !mesh.solid);
	assert_true(mesh_set_vertices(&mesh, desc.positions, NULL, &changed, NULL));
	assert_true(changed && !mesh.solid);
	size_t bytes = mesh.vertex_count * sizeof(*mesh.positions);
	assert_memory_equal(mesh.positions, expected.positions, bytes);
	assert_memory_equal(mesh.normals, expected.normals, bytes);
	check_same_caster(&mesh.caster, &expected.caster);
	mesh_finish(&mesh);
	mesh_finish(&expected);
	model_finish(&sphere);
	test_free(positions);
}

static void makes_normals_of_moved_vertices(void **state)
{
	(void)state;
	struct sm_mesh_desc desc = square_desc();
	struct mesh mesh = made(&desc);
	/* Onto the plane x = 0, facing +x. */
	const float positions[4][3] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}};
	const float normals[4][3] = {{0, 2, 0}, {0, 0, 0}, {NAN, 0, 0}, {0, 0, 3}};
	const float given[4][3] = {{0, 1, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 1}};
	bool changed;
	assert_true(mesh_set_vertices(&mesh, positions[0], NULL, &changed, NULL));
	for (size_t v = 0; v < 4; v++)
		assert_memory_equal(mesh.normals[v], ((float[]){1, 0, 0}), 12);
	assert_true(mesh_set_vertices(&mesh, positions[0], normals[0], &changed, NULL));
	assert_true(changed);
	for (size_t v = 0; v < 4; v++)
		assert_memory_equal(mesh.normals[v], given[mesh.sources[v]], 12);
	mesh_finish(&mesh);
}

static void refuses_to_move_out_of_numbers(void **state)
{
	(void)state;
	struct sm_mesh_desc desc = square_desc();
	struct mesh mesh = made(&desc), expected = made(&desc);
	struct sm_error error = {0};
	float positions[4][3] = {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {6, 6, INFINITY}};
	bool changed;
	assert_false(mesh_set_vertices(&mesh, positions[0], NULL, &changed, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_string_equal(error.text, "mesh square: the position of vertex 3 is not finite");
	assert_false(changed);
	assert_memory_equal(mesh.positions, expected.positions, sizeof(positions));
	assert_memory_equal(mesh.normals, expected.normals, sizeof(positions));
	check_same_caster(&mesh.caster, &expected.caster);
	mesh_finish(&mesh);
	mesh_finish(&expected);
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
		cmocka_unit_test(moves_as_if_made_there),
		cmocka_unit_test(moves_back_to_each_bit),
		cmocka_unit_test(makes_normals_of_moved_vertices),
		cmocka_unit_test(refuses_to_move_out_of_numbers),
		cmocka_unit_test(finish_takes_an_empty_mesh),
	};
	return cmocka_run_group_tests_name("mesh", tests, NULL, NULL);
}
