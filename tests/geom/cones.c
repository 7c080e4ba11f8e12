/* SPDX-License-Identifier: MIT */
#include "geom/cones.h"
#include "facing.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static struct mesh mesh_of(struct model model)
{
	struct mesh mesh;
	struct sm_mesh_desc desc = model_desc(&model, "cones");
	assert_true(mesh_init(&mesh, &desc, NULL));
	model_finish(&model);
	return mesh;
}

/* How many of the blocks are decided; each as all its triangles are by definition. */
static size_t count_decided(const struct caster *caster, const float light[4])
{
	struct cone_light seen;
	size_t decided = 0;
	assert_true(cone_light_of(&caster->planes, light, &seen));
	for (size_t first = 0; first < caster->cones.count; first += CONE_BATCH) {
		uint8_t sides[CONE_BATCH];
		face_cones_test(&caster->cones, first, &seen, sides);
		for (size_t i = 0; i < CONE_BATCH; i++) {
			size_t begin = (first + i) * EDGE_BLOCK, end = begin + EDGE_BLOCK;
			if (sides[i] == CONE_MIXED)
				continue;
			decided++;
			assert_true(begin < caster->triangle_count);
			for (size_t t = begin; t < end && t < caster->triangle_count; t++)
				assert_int_equal(faces_by_definition(caster, t, light),
					sides[i] == CONE_FACES);
		}
	}
	return decided;
}

static void most_blocks_of_a_sphere_are_decided(void **state)
{
	(void)state;
	struct mesh mesh = mesh_of(model_sphere(7));
	const struct caster *caster = &mesh.caster;
	size_t blocks = edge_table_blocks(&caster->edges);
	assert_true(caster->cones.count >= blocks);
	const float lights[][4] = {{0, 3, 0, 1}, {2, 2, 2, 1}, {1, 0, 0, 0}, {1, -1, 3, 0},
		{0, 3, 0, -1}, {1e6f, 0, 0, 1}};
	for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++)
		assert_true(count_decided(caster, lights[i]) > blocks * 3 / 4);
	/* From inside, every triangle shows its back. */
	assert_true(count_decided(caster, (const float[4]){0.1f, 0, 0, 1}) == blocks);
	mesh_finish(&mesh);
}

/* A light at a distance from a flat mesh, either way. */
static void a_plane_is_decided_up_to_the_margin(void **state)
{
	(void)state;
	struct model model = model_grid(64);
	for (size_t v = 0; v < model.vertex_count; v++)
		model.positions[v][2] = 0.0f;
	struct mesh mesh = mesh_of(model);
	const struct caster *caster = &mesh.caster;
	size_t blocks = edge_table_blocks(&caster->edges);
	float scale = (float)caster->planes.radius;
	const struct {
		float height;
		bool decided;
	} cases[] = {{1e-3f, true}, {-1e-3f, true}, {1e-6f, false}, {0, false}, {-1e-6f, false}};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		float light[4] = {(float)caster->planes.center[0], (float)caster->planes.center[1],
			(float)caster->planes.center[2] + cases[i].height * scale, 1};
		size_t decided = count_decided(caster, light);
		assert_int_equal(decided, cases[i].decided ? blocks : 0);
	}
	mesh_finish(&mesh);
}

static void a_triangle_without_area_keeps_its_block_open(void **state)
{
	(void)state;
	struct model model = model_grid(16);
	/* Some triangle loses its area, but keeps three vertices: two of them come to lie in one
	 * place with the third between. */
	uint32_t *v = model.indices;
	for (int i = 0; i < 3; i++)
		model.positions[v[2]][i] =
			(model.positions[v[0]][i] + model.positions[v[1]][i]) / 2.0f;
	struct mesh mesh = mesh_of(model);
	const struct caster *caster = &mesh.caster;
	assert_true(caster->planes.degenerate > 0);
	assert_true(caster->cones.count > 0);
	size_t blocks = edge_table_blocks(&caster->edges);
	const float lights[][4] = {{0, 0, 1, 0}, {0, 0, -1, 0}, {0, 0, 9, 1}, {0, 0, 9, -1}};
	for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++)
		assert_true(count_decided(caster, lights[i]) < blocks);
	mesh_finish(&mesh);
}

static void what_looks_all_ways_has_no_cones(void **state)
{
	(void)state;
	struct mesh mesh = mesh_of(model_cube());
	assert_int_equal(mesh.caster.cones.count, 0);
	assert_int_equal(face_cones_bytes(&mesh.caster.cones), 0);
	mesh_finish(&mesh);
}

static void some_lights_are_not_for_cones(void **state)
{
	(void)state;
	struct mesh mesh = mesh_of(model_sphere(3));
	struct cone_light seen;
	const float lights[][4] = {
		{0, 1, 0, 2}, {0, 1, 0, 0.5f}, {0, 1, 0, -3}, {0, 0, 0, 0}, {NAN, 0, 0, 1}};
	for (size_t i = 0; i < sizeof(lights) / sizeof(lights[0]); i++)
		assert_false(cone_light_of(&mesh.caster.planes, lights[i], &seen));
	mesh_finish(&mesh);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(most_blocks_of_a_sphere_are_decided),
		cmocka_unit_test(a_plane_is_decided_up_to_the_margin),
		cmocka_unit_test(a_triangle_without_area_keeps_its_block_open),
		cmocka_unit_test(what_looks_all_ways_has_no_cones),
		cmocka_unit_test(some_lights_are_not_for_cones),
	};
	return cmocka_run_group_tests_name("cones", tests, NULL, NULL);
}
