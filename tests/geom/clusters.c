/* SPDX-License-Identifier: MIT */
#include "geom/clusters.h"
#include "models.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static void counts_round_up(void **state)
{
	(void)state;
	const struct {
		size_t triangles, clusters;
	} cases[] = {
		{0, 0}, {1, 1}, {127, 1}, {128, 1}, {129, 2}, {256, 2}, {257, 3}, {1000000, 7813}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		assert_int_equal(clusters_count(cases[i].triangles), cases[i].clusters);
}

/* Nothing sticks out, and each of the six sides is touched. */
static void check_box(const struct cluster *box, const float (*positions)[3],
	const uint32_t *indices, size_t index_count)
{
	for (int axis = 0; axis < 3; axis++) {
		bool touches_min = false, touches_max = false;
		for (size_t i = 0; i < index_count; i++) {
			float p = positions[indices[i]][axis];
			assert_true(p >= box->min[axis] && p <= box->max[axis]);
			touches_min = touches_min || p == box->min[axis];
			touches_max = touches_max || p == box->max[axis];
		}
		assert_true(touches_min && touches_max);
	}
}

/* Into exactly as much memory as is needed, so that a sanitizer sees any access beyond. */
static void check_clusters(const struct model *model, size_t triangle_count)
{
	size_t count = clusters_count(triangle_count), done = 0;
	struct cluster *clusters = malloc(count * sizeof(*clusters));
	uint32_t *indices = malloc(3 * triangle_count * sizeof(*indices));
	assert_true(clusters != NULL && indices != NULL);
	for (size_t i = 0; i < 3 * triangle_count; i++)
		indices[i] = model->indices[i];
	const float(*positions)[3] = (const float(*)[3])model->positions;
	clusters_find(positions, indices, triangle_count, clusters);
	for (size_t c = 0; c < count; c++) {
		size_t left = triangle_count - done;
		size_t triangles = left < CLUSTER_TRIANGLES ? left : CLUSTER_TRIANGLES;
		check_box(&clusters[c], positions, indices + 3 * done, 3 * triangles);
		done += triangles;
	}
	assert_int_equal(done, triangle_count);
	free(indices);
	free(clusters);
}

static void boxes_cover_exactly_their_triangles(void **state)
{
	(void)state;
	const size_t counts[] = {1, 2, 127, 128, 129, 255, 256, 257, 5000};
	struct model soup = model_soup(3000, 5000);
	for (size_t i = 0; i < sizeof(counts) / sizeof(counts[0]); i++)
		check_clusters(&soup, counts[i]);
	model_finish(&soup);
}

static void no_triangles_no_boxes(void **state)
{
	(void)state;
	struct cluster untouched = {.min = {1, 2, 3}};
	clusters_find(NULL, NULL, 0, &untouched);
	assert_true(untouched.min[0] == 1.0f);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(counts_round_up),
		cmocka_unit_test(boxes_cover_exactly_their_triangles),
		cmocka_unit_test(no_triangles_no_boxes),
	};
	return cmocka_run_group_tests_name("clusters", tests, NULL, NULL);
}
