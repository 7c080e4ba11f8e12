/* SPDX-License-Identifier: MIT */
#include "geom/solid.h"
#include "changes.h"
#include "geom/mesh.h"
#include "models.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

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

static struct model first_triangle_inverted(struct model model)
{
	struct model one = {.indices = model.indices, .index_count = 3};
	model_inverted(one);
	return model;
}

static void closed_and_outward_is_solid(void **state)
{
	(void)state;
	check(model_tetrahedron(), true, "a tetrahedron");
	check(model_cube(), true, "a cube");
	check(model_sphere(3), true, "a sphere");
	check(model_torus(), true, "a torus");
	check(model_joined(model_sphere(2), model_moved(model_sphere(2), 3.0f)), true,
		"two spheres");
	check(model_joined(model_sphere(2), model_moved(model_sphere(2), 0.5f)), true,
		"two spheres that overlap");
	check(model_joined(model_sphere(2), model_scaled(model_sphere(2), 0.5f)), true,
		"two spheres, one in the other");
}

static void inside_out_is_not(void **state)
{
	(void)state;
	check(model_inverted(model_tetrahedron()), false, "an inverted tetrahedron");
	check(model_inverted(model_sphere(3)), false, "an inverted sphere");
	check(model_inverted(model_torus()), false, "an inverted torus");
	check(model_scaled(model_sphere(2), -1.0f), false, "a mirrored sphere");
}

/* Whichever comes first, and however much more the right one encloses. */
static void each_part_counts(void **state)
{
	(void)state;
	check(model_joined(model_sphere(2), model_moved(model_inverted(model_sphere(2)), 3.0f)),
		false, "a sphere before one inside out");
	check(model_joined(model_moved(model_inverted(model_sphere(2)), 3.0f), model_sphere(2)),
		false, "a sphere after one inside out");
	check(model_joined(model_scaled(model_sphere(2), 1e3f),
		      model_moved(model_inverted(model_sphere(2)), 2e3f)),
		false, "a large sphere beside a small one inside out");
	/* The inner wall is a part that faces its own inside. */
	check(model_joined(model_sphere(2), model_scaled(model_inverted(model_sphere(2)), 0.5f)),
		false, "a hollow sphere");
}

static void a_surface_that_is_not_closed_or_oriented_is_not(void **state)
{
	(void)state;
	check(model_opened(model_cube()), false, "a box with a hole");
	check(model_opened(model_sphere(3)), false, "a sphere with a hole");
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
	check(model_scaled(model_cube(), 0.0f), false, "a cube without size");
}

/* As long as floats tell the vertices apart: at 1e7 they step by 1. */
static void far_from_the_origin(void **state)
{
	(void)state;
	for (float place = 1e3f; place < 1.5e7f; place *= 1.7f) {
		check(model_moved(model_cube(), place), true, "a far cube");
		check(model_moved(model_inverted(model_cube()), place), false,
			"a far inverted cube");
		check(model_moved(model_scaled(model_sphere(3), 100.0f), -place), true,
			"a far sphere");
		check(model_moved(model_scaled(model_inverted(model_sphere(3)), 100.0f), -place),
			false, "a far inverted sphere");
	}
	check(model_joined(model_moved(model_cube(), 1e6f),
		      model_moved(model_inverted(model_cube()), -1e6f)),
		false, "cubes far apart, one inverted");
}

/* Volumes are of doubles, and hold for any size a float has; only where vertices fall together, at
 * steps of 1.4e-45, does a sphere lose its shape. */
static void of_any_size(void **state)
{
	(void)state;
	const float scales[] = {1e-42f, 1e-38f, 1e-20f, 1e-10f, 1e-3f, 1e3f, 1e10f, 1e15f, 1e38f};
	for (size_t i = 0; i < sizeof(scales) / sizeof(scales[0]); i++) {
		check(model_scaled(model_sphere(2), scales[i]), true, "a scaled sphere");
		check(model_scaled(model_torus(), scales[i]), true, "a scaled torus");
		check(model_scaled(model_inverted(model_sphere(2)), scales[i]), false,
			"a scaled inverted sphere");
	}
	check(model_scaled(model_cube(), 1.4e-45f), true, "a cube of the smallest size");
	check(model_scaled(model_sphere(2), 1.4e-45f), false, "a sphere of the smallest size");
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
