/* SPDX-License-Identifier: MIT */
#include "geom/orientation.h"
#include "changes.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void turn(struct model *model, size_t triangle)
{
	uint32_t *v = &model->indices[3 * triangle];
	uint32_t swap = v[1];
	v[1] = v[2];
	v[2] = swap;
}

static struct model some_turned(struct model model)
{
	for (size_t t = 0; t < model.index_count / 3; t += 3)
		turn(&model, t);
	return model;
}

static struct model first_turned(struct model model)
{
	turn(&model, 0);
	return model;
}

static struct model made(const float (*positions)[3], size_t vertex_count,
	const uint32_t (*triangles)[3], size_t triangle_count)
{
	struct model model = {
		.vertex_count = vertex_count,
		.positions = malloc(vertex_count * sizeof(*positions)),
		.index_count = 3 * triangle_count,
		.indices = malloc(triangle_count * sizeof(*triangles)),
	};
	assert_true(model.positions != NULL && model.indices != NULL);
	memcpy(model.positions, positions, vertex_count * sizeof(*positions));
	memcpy(model.indices, triangles, triangle_count * sizeof(*triangles));
	return model;
}

/* A square, and another of the same four vertices that is seen from the other side. */
static struct model doubled_square(void)
{
	static const float positions[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
	static const uint32_t triangles[4][3] = {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}};
	return made(positions, 4, triangles, 4);
}

/* A tetrahedron with an edge cut in two for one of its triangles. */
static struct model t_junction(void)
{
	static const float positions[5][3] = {
		{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, 0, 0}};
	static const uint32_t triangles[5][3] = {
		{0, 4, 2}, {4, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
	return made(positions, 5, triangles, 5);
}

/* Two cubes that share the edge from (1, 1, -1) to (1, 1, 1). */
static struct model touching_cubes(void)
{
	struct model a = model_cube(), b = model_cube();
	for (size_t v = 0; v < b.vertex_count; v++) {
		b.positions[v][0] += 2.0f;
		b.positions[v][1] += 2.0f;
	}
	return model_joined(a, b);
}

/* A cube to which a triangle is attached along an edge. */
static struct model cube_with_fin(void)
{
	struct model model = model_cube();
	float(*positions)[3] = realloc(model.positions, 9 * sizeof(*positions));
	uint32_t *indices = realloc(model.indices, 39 * sizeof(*indices));
	if (positions == NULL || indices == NULL)
		abort();
	memcpy(positions[8], (float[3]){3, 3, 0}, sizeof(positions[8]));
	memmove(&indices[3], indices, 36 * sizeof(*indices));
	memcpy(indices, (uint32_t[3]){3, 8, 7}, 3 * sizeof(*indices));
	return (struct model){9, positions, 39, indices};
}

static struct model cube_with_points(void)
{
	struct model points = model_cube();
	for (size_t t = 0; t < 12; t += 2)
		points.indices[3 * t + 2] = points.indices[3 * t];
	for (size_t t = 1; t < 12; t += 2)
		points.indices[3 * t + 2] = points.indices[3 * t + 1] = points.indices[3 * t];
	return model_joined(points, model_cube());
}

static struct orientation repair(const char *name, const struct model *model, struct mesh *mesh)
{
	struct sm_mesh_desc desc = model_desc(model, name);
	assert_true(mesh_init(mesh, &desc, NULL));
	return mesh->caster.found;
}

struct expected {
	size_t closed, open, non_orientable, turned, closed_count, repeated;
};

static void check_repair(const char *name, struct model model, const struct expected *expected)
{
	struct mesh mesh;
	struct orientation found = repair(name, &model, &mesh);
	const struct expected got = {found.closed_parts, found.open_parts,
		found.non_orientable_parts, found.turned, found.closed_count, found.repeated};
	if (memcmp(&got, expected, sizeof(got)) != 0)
		fail_msg("%s: %zu closed, %zu open, %zu not orientable, %zu turned, %zu first, %zu "
			 "dropped",
			name, got.closed, got.open, got.non_orientable, got.turned,
			got.closed_count, got.repeated);
	mesh_finish(&mesh);
	model_finish(&model);
}

static void finds_parts_and_turns_them(void **state)
{
	(void)state;
	const struct {
		const char *name;
		struct model model;
		struct expected expected;
	} cases[] = {
		{"cube", model_cube(), {1, 0, 0, 0, 12}},
		{"cube inside out", model_inverted(model_cube()), {1, 0, 0, 12, 12}},
		{"cube, some turned", some_turned(model_cube()), {1, 0, 0, 4, 12}},
		{"cube, most turned", some_turned(model_inverted(model_cube())), {1, 0, 0, 8, 12}},
		{"open cube", model_opened(model_cube()), {0, 1, 0, 0, 0}},
		{"open cube inside out", model_opened(model_inverted(model_cube())),
			{0, 1, 0, 0, 0}},
		{"open cube, some turned", some_turned(model_opened(model_cube())),
			{0, 1, 0, 4, 0}},
		{"strip", model_strip(), {0, 1, 0, 0, 0}},
		{"strip, some turned", some_turned(model_strip()), {0, 1, 0, 34, 0}},
		{"Moebius strip", model_moebius(), {0, 1, 1, 0, 0}},
		{"Moebius strip, some turned", some_turned(model_moebius()), {0, 1, 1, 0, 0}},
		{"two cubes", model_joined(model_cube(), model_moved(model_cube(), 5)),
			{2, 0, 0, 0, 24}},
		{"two cubes, one inside out",
			model_joined(model_cube(), model_moved(model_inverted(model_cube()), 5)),
			{2, 0, 0, 12, 24}},
		{"cube in a cube", model_joined(model_cube(), model_scaled(model_cube(), 0.5f)),
			{2, 0, 0, 0, 24}},
		{"hollow cube",
			model_joined(
				model_cube(), model_inverted(model_scaled(model_cube(), 0.5f))),
			{2, 0, 0, 12, 24}},
		{"cubes that touch", touching_cubes(), {2, 0, 0, 0, 24}},
		{"cube and open cube",
			model_joined(model_opened(model_cube()), model_moved(model_cube(), 5)),
			{1, 1, 0, 0, 12}},
		{"cube with a fin", cube_with_fin(), {1, 1, 0, 0, 12}},
		{"fan", model_fan(), {0, 5, 0, 0, 0}},
		{"T-junction", t_junction(), {0, 1, 0, 0, 0}},
		{"doubled square", doubled_square(), {1, 0, 0, 0, 4}},
		{"doubled square, one turned", first_turned(doubled_square()), {1, 0, 0, 1, 4}},
		{"doubled cube", model_doubled(false), {1, 0, 0, 0, 12, 12}},
		{"doubled cube, turned", model_doubled(true), {1, 0, 0, 0, 12, 12}},
		{"doubled strip", model_joined(model_strip(), model_inverted(model_strip())),
			{0, 1, 0, 0, 0, 100}},
		{"cube, three times",
			model_joined(model_cube(),
				model_joined(model_inverted(model_cube()), model_cube())),
			{1, 0, 0, 0, 12, 24}},
		{"cube and points", cube_with_points(), {1, 0, 0, 0, 12}},
		{"points", model_scaled(model_cube(), 0), {0, 0, 0, 0, 12}},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_repair(cases[i].name, cases[i].model, &cases[i].expected);
}

/* From its lowest vertex on. */
static void rotate(uint32_t v[3])
{
	while (v[1] < v[0] || v[2] < v[0]) {
		uint32_t first = v[0];
		v[0] = v[1];
		v[1] = v[2];
		v[2] = first;
	}
}

static int compare_triangles(const void *a, const void *b)
{
	const uint32_t *x = a, *y = b;
	for (int i = 0; i < 3; i++)
		if (x[i] != y[i])
			return x[i] < y[i] ? -1 : 1;
	return 0;
}

static void sort_triangles(uint32_t *indices, size_t triangle_count)
{
	for (size_t t = 0; t < triangle_count; t++)
		rotate(&indices[3 * t]);
	qsort(indices, triangle_count, 3 * sizeof(*indices), compare_triangles);
}

/* A welded mesh, with triangles turned at random, a share of them in 256ths, comes back. */
static void check_turned(const struct caster *caster, uint64_t *state, uint32_t share)
{
	size_t count = caster->triangle_count, size = 3 * count * sizeof(*caster->indices);
	uint32_t *expected = malloc(size), *indices = malloc(size);
	assert_true(expected != NULL && indices != NULL);
	memcpy(expected, caster->indices, size);
	memcpy(indices, caster->indices, size);
	struct model model = {.indices = indices, .index_count = 3 * count};
	size_t turned = 0;
	for (size_t t = 0; t < count; t++) {
		if (random_next(state) % 256 >= share)
			continue;
		turn(&model, t);
		turned++;
	}
	struct orientation found;
	assert_true(orientation_repair(&found, (const float(*)[3])caster->positions,
		caster->vertex_count, indices, &count));
	assert_int_equal(found.repeated, 0);
	assert_int_equal(found.turned, turned);
	assert_int_equal(found.open_parts, 0);
	assert_int_equal(found.closed_count, count);
	sort_triangles(expected, count);
	sort_triangles(indices, count);
	assert_memory_equal(indices, expected, size);
	free(expected);
	free(indices);
}

static void closed_meshes_come_back(void **state)
{
	(void)state;
	struct model models[] = {
		model_tetrahedron(),
		model_cube(),
		model_sphere(4),
		model_torus(),
		model_moved(model_torus(), 1e3f),
		model_joined(model_torus(), model_moved(model_sphere(2), 0.2f)),
		touching_cubes(),
	};
	uint64_t random = 5;
	for (size_t i = 0; i < sizeof(models) / sizeof(models[0]); i++) {
		struct mesh mesh;
		repair("closed", &models[i], &mesh);
		assert_int_equal(mesh.caster.found.turned, 0);
		for (uint32_t share = 0; share <= 256; share += 32)
			check_turned(&mesh.caster, &random, share);
		mesh_finish(&mesh);
		model_finish(&models[i]);
	}
}

/* Repairing once is enough, and the closed triangles are closed by themselves. */
static void check_model(const char *name, const struct model *model)
{
	struct mesh mesh;
	struct orientation found = repair(name, model, &mesh), again;
	const struct caster *caster = &mesh.caster;
	size_t left = caster->triangle_count, size = 3 * left * sizeof(*caster->indices);
	uint32_t *indices = malloc(size);
	assert_non_null(indices);
	memcpy(indices, caster->indices, size);
	assert_true(orientation_repair(&again, (const float(*)[3])caster->positions,
		caster->vertex_count, indices, &left));
	assert_int_equal(again.repeated, 0);
	assert_int_equal(again.turned, 0);
	assert_int_equal(again.closed_count, found.closed_count);
	assert_memory_equal(indices, caster->indices, size);

	struct edge_table table;
	assert_true(edge_table_init(&table, indices, found.closed_count, caster->vertex_count));
	struct edge_record *records = malloc(edge_table_records(&table) * sizeof(*records) + 1);
	assert_non_null(records);
	edge_table_decode(&table, records);
	for (size_t i = 0; i < edge_table_records(&table); i++)
		assert_true(records[i].neighbour != EDGE_OPEN);
	print_message("%-22s %6zu closed, %6zu open parts (%zu not orientable), %6zu turned, %6zu "
		      "dropped, %6zu of %6zu closed\n",
		name, found.closed_parts, found.open_parts, found.non_orientable_parts,
		found.turned, found.repeated, found.closed_count, caster->triangle_count);
	free(records);
	edge_table_finish(&table);
	free(indices);
	mesh_finish(&mesh);
}

static void once_is_enough(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_model);
}

/* What is seen of a mesh, and what is left out of that, go by how it came. */
static void the_mesh_as_seen_stays(void **state)
{
	(void)state;
	struct model straight = model_sphere(2), turned = some_turned(model_sphere(2));
	struct sm_mesh_desc desc = model_desc(&turned, "turned");
	struct mesh mesh;
	assert_true(mesh_init(&mesh, &desc, NULL));
	assert_false(mesh.solid);
	assert_true(mesh.stats.inverted_edges > 0);
	size_t outward = 0;
	for (size_t t = 0; t < mesh.index_count / 3; t++) {
		const uint32_t *v = &mesh.indices[3 * t];
		outward += face_volume(mesh.positions[v[0]], mesh.positions[v[1]],
				   mesh.positions[v[2]], (const float[3]){0, 0, 0}) > 0.0;
	}
	assert_int_equal(outward, straight.index_count / 3 - (straight.index_count / 3 + 2) / 3);
	mesh_finish(&mesh);
	model_finish(&straight);
	model_finish(&turned);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(finds_parts_and_turns_them),
		cmocka_unit_test(closed_meshes_come_back),
		cmocka_unit_test(once_is_enough),
		cmocka_unit_test(the_mesh_as_seen_stays),
	};
	return cmocka_run_group_tests_name("orientation", tests, NULL, NULL);
}
