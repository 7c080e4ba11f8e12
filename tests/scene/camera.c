/* SPDX-License-Identifier: MIT */
#include "scene/camera.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static const struct sm_camera ahead = {.target = {0, 0, -1}, .up = {0, 1, 0}, .fov = 60};

/* A sliver across the z axis from z to z - depth. */
static void add_sliver(struct sm_scene *scene, float z, float depth)
{
	static const uint32_t indices[] = {0, 1, 2};
	float positions[3][3] = {{0, 0, z}, {0, 0.1f, z}, {0, 0, z - depth}};
	struct sm_mesh_desc mesh = {
		.positions = positions[0], .vertex_count = 3, .indices = indices, .index_count = 3};
	struct sm_object_desc object = {
		.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, .image = SM_NONE};
	uint32_t handle;
	assert_true(sm_scene_add_mesh(scene, &mesh, &object.mesh, NULL));
	assert_true(sm_scene_add_object(scene, &object, &handle, NULL));
}

/* Where the matrix has its planes: glm's perspective, entries 10 and 14. */
static void get_range(mat4 matrix, double *near_plane, double *far_plane)
{
	double a = matrix[2][2], b = matrix[3][2];
	*near_plane = b / (a - 1);
	*far_plane = b / (a + 1);
}

static void near_and_far_follow_from_the_scene(void **state)
{
	(void)state;
	static const struct {
		float z, depth; /* of the only object */
		double near, far;
	} cases[] = {
		{-2, 6, 2, 8},                  /* in front */
		{-2e-3f, 6e-3f, 2e-3, 8e-3},    /* the same, tiny */
		{-2e4f, 6e4f, 2e4, 8e4},        /* and huge */
		{-5, 0, 5, 5},                  /* flat */
		{3, 13, 10.0 / 20000, 10},      /* around the eye */
		{-1e-9f, 10, 10.0 / 20000, 10}, /* at the eye */
		{5, 1, 1.0 / 20000, 1},         /* all behind the eye: any range */
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_scene *scene = sm_scene_create();
		assert_non_null(scene);
		add_sliver(scene, cases[i].z, cases[i].depth);
		mat4 matrix;
		double near_plane, far_plane;
		assert_true(camera_world_to_clip(&ahead, scene, 4, 3, matrix, NULL));
		get_range(matrix, &near_plane, &far_plane);
		assert_true(fabs(near_plane / cases[i].near - 1) < 0.002);
		/* Read back from a - 1 and a + 1: near / far of a float step is lost. */
		assert_true(fabs(far_plane / cases[i].far - 1) < 0.01);
		assert_true(near_plane < far_plane);
		sm_scene_destroy(scene);
	}
}

static void near_and_far_may_be_given(void **state)
{
	(void)state;
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	struct sm_camera camera = ahead;
	camera.near = 0.5f;
	camera.far = 50;
	mat4 matrix;
	double near_plane, far_plane;
	add_sliver(scene, -2, 6);
	assert_true(camera_world_to_clip(&camera, scene, 4, 3, matrix, NULL));
	get_range(matrix, &near_plane, &far_plane);
	assert_true(fabs(near_plane - 0.5) < 1e-5 && fabs(far_plane - 50) < 1e-2);
	sm_scene_destroy(scene);
}

static void the_field_of_view_is_vertical(void **state)
{
	(void)state;
	struct sm_scene *scene = sm_scene_create();
	assert_non_null(scene);
	mat4 matrix;
	assert_true(camera_world_to_clip(&ahead, scene, 400, 100, matrix, NULL));
	/* At distance 1, the picture reaches tan 30 degrees up, and four times that aside. */
	float up = tanf(glm_rad(30));
	vec4 corner;
	glm_mat4_mulv(matrix, (vec4){4 * up, up, -1, 1}, corner);
	assert_float_equal(corner[0] / corner[3], 1, 1e-6f);
	assert_float_equal(corner[1] / corner[3], 1, 1e-6f);
	sm_scene_destroy(scene);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(near_and_far_follow_from_the_scene),
		cmocka_unit_test(near_and_far_may_be_given),
		cmocka_unit_test(the_field_of_view_is_vertical),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
