/* SPDX-License-Identifier: MIT */
#include "geom/edges.h"
#include "geom/mesh.h"
#include "geom/sides.h"
#include "models.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define NO_RECORD (UINT32_MAX - 1)

/* The specification: half-edges in a plain table, sorted by edge and then by corner. */
struct half_edge {
	uint32_t low, high;
	size_t corner;
	bool reversed;
};

static int compare(const void *a, const void *b)
{
	const struct half_edge *x = a, *y = b;
	if (x->low != y->low)
		return x->low < y->low ? -1 : 1;
	if (x->high != y->high)
		return x->high < y->high ? -1 : 1;
	return x->corner < y->corner ? -1 : x->corner > y->corner;
}

static size_t list_half_edges(
	const uint32_t *indices, size_t triangle_count, struct half_edge *list)
{
	size_t count = 0;
	for (size_t c = 0; c < 3 * triangle_count; c++) {
		const uint32_t *v = &indices[c - c % 3];
		uint32_t from = v[c % 3], to = v[(c + 1) % 3];
		if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
			continue;
		list[count++] = (struct half_edge){
			from < to ? from : to, from < to ? to : from, c, from > to};
	}
	qsort(list, count, sizeof(*list), compare);
	return count;
}

/* Each half-edge takes the first of the same edge and other direction that is still free. */
static void pair_off(const struct half_edge *group, size_t count, uint32_t *expected)
{
	for (size_t i = 0; i < count; i++)
		expected[group[i].corner] = EDGE_OPEN;
	size_t free_from = 0;
	for (size_t i = 0; i < count; i++) {
		if (expected[group[i].corner] != EDGE_OPEN)
			continue;
		size_t j = free_from > i + 1 ? free_from : i + 1;
		while (j < count && (group[j].reversed == group[i].reversed ||
					    expected[group[j].corner] == NO_RECORD))
			j++;
		if (j == count)
			continue;
		free_from = j + 1 < count && group[j + 1].reversed == group[j].reversed ? j + 1 : 0;
		expected[group[i].corner] = (uint32_t)(group[j].corner / 3);
		expected[group[j].corner] = NO_RECORD;
	}
}

/* expected: [3 * triangle_count]: the neighbour of the record that a corner owns */
static struct edge_counts expect(const uint32_t *indices, size_t triangle_count, uint32_t *expected)
{
	struct edge_counts counts = {0};
	struct half_edge *list = malloc(3 * triangle_count * sizeof(*list));
	assert_non_null(list);
	size_t count = list_half_edges(indices, triangle_count, list);
	for (size_t c = 0; c < 3 * triangle_count; c++)
		expected[c] = NO_RECORD;
	for (size_t begin = 0, end; begin < count; begin = end) {
		for (end = begin + 1; end < count && list[end].low == list[begin].low &&
				      list[end].high == list[begin].high;)
			end++;
		size_t size = end - begin;
		counts.edges++;
		counts.open += size == 1;
		counts.non_manifold += size > 2;
		counts.inverted += size == 2 && list[begin].reversed == list[begin + 1].reversed;
		pair_off(&list[begin], size, expected);
	}
	free(list);
	return counts;
}

static void check_records(const struct edge_table *table, const uint32_t *expected)
{
	size_t count = edge_table_records(table);
	struct edge_record *records = malloc(count * sizeof(*records) + 1);
	assert_non_null(records);
	edge_table_decode(table, records);
	size_t expected_count = 0;
	for (size_t c = 0; c < 3 * table->triangle_count; c++)
		expected_count += expected[c] != NO_RECORD;
	assert_int_equal(count, expected_count);

	bool *seen = calloc(3 * table->triangle_count, sizeof(*seen));
	assert_non_null(seen);
	for (size_t i = 0; i < count; i++) {
		assert_int_equal(records[i].neighbour, expected[records[i].corner]);
		assert_false(seen[records[i].corner]);
		seen[records[i].corner] = true;
	}
	free(seen);
	free(records);
}

static void check_counts(
	const uint32_t *indices, size_t triangle_count, const struct edge_counts *expected)
{
	size_t vertex_count = 0;
	for (size_t i = 0; i < 3 * triangle_count; i++)
		if (vertex_count <= indices[i])
			vertex_count = (size_t)indices[i] + 1;
	struct sides sides;
	assert_true(sides_init(&sides, indices, triangle_count, vertex_count));
	struct edge_counts counts = sides_count_edges(&sides);
	assert_int_equal(counts.edges, expected->edges);
	assert_int_equal(counts.open, expected->open);
	assert_int_equal(counts.non_manifold, expected->non_manifold);
	assert_int_equal(counts.inverted, expected->inverted);
	sides_finish(&sides);
}

static void check_table(
	const struct edge_table *table, const uint32_t *indices, size_t triangle_count)
{
	uint32_t *expected = malloc(3 * triangle_count * sizeof(*expected));
	assert_non_null(expected);
	struct edge_counts counts = expect(indices, triangle_count, expected);
	check_counts(indices, triangle_count, &counts);
	check_records(table, expected);
	free(expected);
}

static void check_model(const char *name, const struct model *model)
{
	struct sm_mesh_desc desc = model_desc(model, name);
	struct mesh mesh;
	assert_true(mesh_init(&mesh, &desc, NULL));
	const struct caster *caster = &mesh.caster;
	check_table(&caster->edges, caster->indices, caster->triangle_count);

	double records = (double)edge_table_records(&caster->edges);
	double edges = (double)mesh.stats.edge_bytes / records;
	double both = (double)(mesh.stats.edge_bytes + mesh.stats.plane_bytes) / records;
	print_message("%-22s %7.0f records, %5zu links, %.2f bytes an edge, %.2f with planes\n",
		name, records, caster->edges.link_count, edges, both);
	/* What a block has once counts for little in a whole one. */
	if (caster->triangle_count >= EDGE_BLOCK) {
		assert_true(edges + face_cones_bytes(&caster->cones) / records <= 6.0);
		assert_true(both <= 12.0);
	}
	mesh_finish(&mesh);
}

static void decodes_to_the_plain_table(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_model);
}

/* Here the triangles' order is the model's own, so that neighbours are anywhere. */
static void check_unordered(const char *name, const struct model *model)
{
	(void)name;
	size_t triangle_count = model->index_count / 3;
	struct edge_table table;
	assert_true(edge_table_init(&table, model->indices, triangle_count, model->vertex_count));
	check_table(&table, model->indices, triangle_count);
	edge_table_finish(&table);
}

static void decodes_in_any_triangle_order(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_unordered);
}

/* Two triangles that share an edge, `distance` apart. */
static void check_distance(size_t distance, size_t links)
{
	size_t count = distance + 1;
	uint32_t *indices = calloc(count, 3 * sizeof(*indices));
	assert_non_null(indices);
	memcpy(indices, (uint32_t[3]){0, 1, 2}, 3 * sizeof(*indices));
	memcpy(&indices[3 * (count - 1)], (uint32_t[3]){2, 1, 3}, 3 * sizeof(*indices));
	struct edge_table table;
	assert_true(edge_table_init(&table, indices, count, 4));
	assert_int_equal(table.link_count, links);
	check_table(&table, indices, count);
	edge_table_finish(&table);
	free(indices);
}

static void reaches_any_distance(void **state)
{
	(void)state;
	const struct {
		size_t distance, links;
	} cases[] = {{1, 0}, {63, 0}, {64, 1}, {65, 1}, {65535, 1}, {65536, 1}, {200000, 1}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_distance(cases[i].distance, cases[i].links);
}

static void counts_kinds_of_edges(void **state)
{
	(void)state;
	const struct {
		const char *name;
		struct model model;
		struct edge_counts counts;
	} cases[] = {
		{"tetrahedron", model_tetrahedron(), {.edges = 6}},
		{"cube", model_cube(), {.edges = 18}},
		{"strip", model_strip(), {.edges = 201, .open = 102}},
		{"fan", model_fan(), {.edges = 11, .open = 10, .non_manifold = 1}},
		{"moebius", model_moebius(), {.edges = 160, .open = 80, .inverted = 1}},
		{"doubled", model_doubled(false), {.edges = 18, .non_manifold = 18}},
		{"grid", model_grid(10), {.edges = 320, .open = 40}},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct model model = cases[i].model;
		struct sm_mesh_desc desc = model_desc(&model, cases[i].name);
		struct mesh mesh;
		assert_true(mesh_init(&mesh, &desc, NULL));
		assert_int_equal(mesh.stats.edges, cases[i].counts.edges);
		assert_int_equal(mesh.stats.open_edges, cases[i].counts.open);
		assert_int_equal(mesh.stats.non_manifold_edges, cases[i].counts.non_manifold);
		assert_int_equal(mesh.stats.inverted_edges, cases[i].counts.inverted);
		mesh_finish(&mesh);
		model_finish(&model);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(decodes_to_the_plain_table),
		cmocka_unit_test(decodes_in_any_triangle_order),
		cmocka_unit_test(reaches_any_distance),
		cmocka_unit_test(counts_kinds_of_edges),
	};
	return cmocka_run_group_tests_name("edges", tests, NULL, NULL);
}
