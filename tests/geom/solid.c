/* SPDX-License-Identifier: MIT */
#include "geom/solid.h"
#include "geom/mesh.h"
#include "models.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static bool is_solid(const struct model *model)
{
	struct sm_mesh_desc desc = model_desc(model, "subject");
	struct mesh mesh;
	assert_true(mesh_init(&mesh, &desc, NULL));
	bool solid = caster_is_solid(&mesh.caster);
	assert_true(mesh.solid == solid);
	mesh_finish(&mesh);
	return solid;
}

static void check(struct model model, bool solid, const char *what)
{
	if (is_solid(&model) != solid)
		fail_msg("%s is %s", what, solid ? "not solid" : "solid");
	model_finish(&model);
}

/* Those below take a model and give it back changed. */

static struct model inverted(struct model model)
{
	for (size_t i = 0; i < model.index_count; i += 3) {
		uint32_t swap = model.indices[i];
		model.indices[i] = model.indices[i + 1];
		model.indices[i + 1] = swap;
	}
	return model;
}

static struct model first_triangle_inverted(struct model model)
{
	struct model one = {.indices = model.indices, .index_count = 3};
	inverted(one);
	return model;
}

static struct model first_triangle_missing(struct model model)
{
	model.index_count -= 3;
	memmove(model.indices, model.indices + 3, model.index_count * sizeof(*model.indices));
	return model;
}

static struct model scaled(struct model model, float scale)
{
	for (size_t v = 0; v < model.vertex_count; v++)
		for (int axis = 0; axis < 3; axis++)
			model.positions[v][axis] *= scale;
	return model;
}

static struct model moved(struct model model, float by)
{
	const float along[3] = {1.0f, -0.7f, 0.3f};
	for (size_t v = 0; v < model.vertex_count; v++)
		for (int axis = 0; axis < 3; axis++)
			model.positions[v][axis] += by * along[axis];
	return model;
}

static struct model joined(struct model a, struct model b)
{
	struct model both = {
		.vertex_count = a.vertex_count + b.vertex_count,
		.index_count = a.index_count + b.index_count,
	};
	both.positions = malloc(both.vertex_count * sizeof(*both.positions));
	both.indices = malloc(both.index_count * sizeof(*both.indices));
	assert_true(both.positions != NULL && both.indices != NULL);
	memcpy(both.positions, a.positions, a.vertex_count * sizeof(*a.positions));
	memcpy(both.positions + a.vertex_count, b.positions, b.vertex_count * sizeof(*b.positions));
	memcpy(both.indices, a.indices, a.index_count * sizeof(*a.indices));
	for (size_t i = 0; i < b.index_count; i++)
		both.indices[a.index_count + i] = b.indices[i] + (uint32_t)a.vertex_count;
	model_finish(&a);
	model_finish(&b);
	return both;
}

/* Radii 1 and .4. */
static struct model torus(void)
{
	const uint32_t around = 24, across = 12;
	const float turn = 6.2831853f;
	struct model model = {.vertex_count = around * across, .index_count = 6 * around * across};
	model.positions = malloc(model.vertex_count * sizeof(*model.positions));
	model.indices = malloc(model.index_count * sizeof(*model.indices));
	assert_true(model.positions != NULL && model.indices != NULL);
	uint32_t *index = model.indices;
	for (uint32_t i = 0; i < around; i++) {
		for (uint32_t j = 0; j < across; j++, index += 6) {
			uint32_t row = i * across, next_row = (i + 1) % around * across;
			uint32_t a = row + j, b = next_row + j;
			uint32_t c = next_row + (j + 1) % across, d = row + (j + 1) % across;
			float u = turn * (float)i / (float)around;
			float v = turn * (float)j / (float)across;
			float radius = 1.0f + 0.4f * cosf(v);
			memcpy(model.positions[a],
				(float[3]){radius * cosf(u), radius * sinf(u), 0.4f * sinf(v)},
				sizeof(model.positions[a]));
			memcpy(index, (uint32_t[]){a, b, c, a, c, d}, 6 * sizeof(*index));
		}
	}
	return model;
}

static void closed_and_outward_is_solid(void **state)
{
	(void)state;
	check(model_tetrahedron(), true, "a tetrahedron");
	check(model_cube(), true, "a cube");
	check(model_sphere(3), true, "a sphere");
	check(torus(), true, "a torus");
	check(joined(model_sphere(2), moved(model_sphere(2), 3.0f)), true, "two spheres");
	check(joined(model_sphere(2), moved(model_sphere(2), 0.5f)), true,
		"two spheres that overlap");
	check(joined(model_sphere(2), scaled(model_sphere(2), 0.5f)), true,
		"two spheres, one in the other");
}

static void inside_out_is_not(void **state)
{
	(void)state;
	check(inverted(model_tetrahedron()), false, "an inverted tetrahedron");
	check(inverted(model_sphere(3)), false, "an inverted sphere");
	check(inverted(torus()), false, "an inverted torus");
	check(scaled(model_sphere(2), -1.0f), false, "a mirrored sphere");
}

/* Whichever comes first, and however much more the right one encloses. */
static void each_part_counts(void **state)
{
	(void)state;
	check(joined(model_sphere(2), moved(inverted(model_sphere(2)), 3.0f)), false,
		"a sphere before one inside out");
	check(joined(moved(inverted(model_sphere(2)), 3.0f), model_sphere(2)), false,
		"a sphere after one inside out");
	check(joined(scaled(model_sphere(2), 1e3f), moved(inverted(model_sphere(2)), 2e3f)), false,
		"a large sphere beside a small one inside out");
	/* The inner wall is a part that faces its own inside. */
	check(joined(model_sphere(2), scaled(inverted(model_sphere(2)), 0.5f)), false,
		"a hollow sphere");
}

static void a_surface_that_is_not_closed_or_oriented_is_not(void **state)
{
	(void)state;
	check(first_triangle_missing(model_cube()), false, "a box with a hole");
	check(first_triangle_missing(model_sphere(3)), false, "a sphere with a hole");
	check(first_triangle_inverted(model_sphere(3)), false, "a sphere, one triangle inverted");
	check(model_grid(4), false, "a grid");
	check(model_strip(), false, "a strip");
	check(model_fan(), false, "five triangles at an edge");
	check(model_moebius(), false, "a Moebius strip");
	check(model_doubled(false), false, "a cube with double walls");
	check(model_doubled(true), false, "a cube with double walls, one turned over");
}

/* A volume of 0 is not above 0. */
static void nothing_is_not(void **state)
{
	(void)state;
	struct model flat = model_cube();
	for (size_t v = 0; v < flat.vertex_count; v++)
		flat.positions[v][2] = 0.0f;
	check(flat, false, "a flattened cube");
	check(scaled(model_cube(), 0.0f), false, "a cube without size");
}

/* As long as floats tell the vertices apart: at 1e7 they step by 1. */
static void far_from_the_origin(void **state)
{
	(void)state;
	for (float place = 1e3f; place < 1.5e7f; place *= 1.7f) {
		check(moved(model_cube(), place), true, "a far cube");
		check(moved(inverted(model_cube()), place), false, "a far inverted cube");
		check(moved(scaled(model_sphere(3), 100.0f), -place), true, "a far sphere");
		check(moved(scaled(inverted(model_sphere(3)), 100.0f), -place), false,
			"a far inverted sphere");
	}
	check(joined(moved(model_cube(), 1e6f), moved(inverted(model_cube()), -1e6f)), false,
		"cubes far apart, one inverted");
}

/* Volumes are of doubles, and hold for any size a float has; only where vertices fall together, at
 * steps of 1.4e-45, does a sphere lose its shape. */
static void of_any_size(void **state)
{
	(void)state;
	const float scales[] = {1e-42f, 1e-38f, 1e-20f, 1e-10f, 1e-3f, 1e3f, 1e10f, 1e15f, 1e38f};
	for (size_t i = 0; i < sizeof(scales) / sizeof(scales[0]); i++) {
		check(scaled(model_sphere(2), scales[i]), true, "a scaled sphere");
		check(scaled(torus(), scales[i]), true, "a scaled torus");
		check(scaled(inverted(model_sphere(2)), scales[i]), false,
			"a scaled inverted sphere");
	}
	check(scaled(model_cube(), 1.4e-45f), true, "a cube of the smallest size");
	check(scaled(model_sphere(2), 1.4e-45f), false, "a sphere of the smallest size");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(closed_and_outward_is_solid),
		cmocka_unit_test(inside_out_is_not),
		cmocka_unit_test(each_part_counts),
		cmocka_unit_test(a_surface_that_is_not_closed_or_oriented_is_not),
		cmocka_unit_test(nothing_is_not),
		cmocka_unit_test(far_from_the_origin),
		cmocka_unit_test(of_any_size),
	};
	return cmocka_run_group_tests_name("solid", tests, NULL, NULL);
}
