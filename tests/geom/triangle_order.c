/* SPDX-License-Identifier: MIT */
#include "geom/triangle_order.h"
#include "geom/edges.h"
#include "geom/face.h"
#include "models.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int compare_triangles(const void *a, const void *b)
{
	return memcmp(a, b, 3 * sizeof(uint32_t));
}

static uint32_t *sorted_copy(const uint32_t *indices, size_t triangle_count)
{
	size_t size = 3 * sizeof(*indices);
	uint32_t *copy = malloc(triangle_count * size + 1);
	assert_non_null(copy);
	memcpy(copy, indices, triangle_count * size);
	qsort(copy, triangle_count, size, compare_triangles);
	return copy;
}

/* From a third on: the first ones stay, and the others are the same, corner by corner. */
static void check_model(const char *name, const struct model *model)
{
	(void)name;
	size_t count = model->index_count / 3, first = count / 3;
	size_t size = 3 * sizeof(*model->indices);
	uint32_t *indices = malloc(count * size + 1);
	assert_non_null(indices);
	memcpy(indices, model->indices, count * size);
	assert_true(triangle_order_blocks(
		(const float(*)[3])model->positions, model->vertex_count, indices, first, count));
	assert_memory_equal(indices, model->indices, first * size);
	uint32_t *before = sorted_copy(model->indices + 3 * first, count - first);
	uint32_t *after = sorted_copy(indices + 3 * first, count - first);
	assert_memory_equal(before, after, (count - first) * size);
	free(before);
	free(after);
	free(indices);
}

static void only_the_order_changes(void **state)
{
	(void)state;
	models_visit(SMOOTHIE_SHARED, check_model);
	float positions[1][3];
	uint32_t indices[1];
	check_model("nothing", &(struct model){.positions = positions, .indices = indices});
}

static void shuffle(struct model *model, uint64_t seed)
{
	for (size_t t = model->index_count / 3; t > 1; t--) {
		uint32_t *a = &model->indices[3 * (t - 1)];
		uint32_t *b = &model->indices[3 * (random_next(&seed) % t)];
		uint32_t kept[3];
		memcpy(kept, a, sizeof(kept));
		memmove(a, b, sizeof(kept));
		memcpy(b, kept, sizeof(kept));
	}
}

/* The share of blocks that show a direction both sides. */
static double mixed_share(const struct model *model)
{
	size_t count = model->index_count / 3, mixed = 0, blocks = count / EDGE_BLOCK;
	for (size_t b = 0; b < blocks; b++) {
		unsigned sides = 0;
		for (size_t t = b * EDGE_BLOCK; t < (b + 1) * EDGE_BLOCK; t++) {
			const uint32_t *v = &model->indices[3 * t];
			double n[3];
			face_normal(model->positions[v[0]], model->positions[v[1]],
				model->positions[v[2]], n);
			sides |= n[0] + 2.0 * n[1] + 3.0 * n[2] > 0.0 ? 1 : 2;
		}
		mixed += sides == 3;
	}
	return (double)mixed / (double)blocks;
}

static void most_blocks_look_one_way(void **state)
{
	(void)state;
	struct model model = model_sphere(6);
	shuffle(&model, 5);
	assert_true(mixed_share(&model) > 0.99);
	/* Each triangle of the sphere has vertices of its own: only looks keep them together. */
	assert_true(triangle_order_blocks((const float(*)[3])model.positions, model.vertex_count,
		model.indices, 0, model.index_count / 3));
	assert_true(mixed_share(&model) < 0.1);
	model_finish(&model);
}

static void triangles_are_followed_by_neighbours(void **state)
{
	(void)state;
	struct model model = model_grid(64);
	size_t count = model.index_count / 3;
	shuffle(&model, 7);
	assert_true(triangle_order_blocks(
		(const float(*)[3])model.positions, model.vertex_count, model.indices, 0, count));
	struct edge_table table;
	assert_true(edge_table_init(&table, model.indices, count, model.vertex_count));
	assert_true(table.next_count > count * 3 / 4);
	assert_true(table.far_count < edge_table_records(&table) / 4);
	edge_table_finish(&table);
	model_finish(&model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(only_the_order_changes),
		cmocka_unit_test(most_blocks_look_one_way),
		cmocka_unit_test(triangles_are_followed_by_neighbours),
	};
	return cmocka_run_group_tests_name("triangle_order", tests, NULL, NULL);
}
