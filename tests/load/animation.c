/* SPDX-License-Identifier: MIT */
#include "load/animation.h"
#include "model_file.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define IDENTITY                                               \
	{                                                      \
		1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 \
	}

static const float once[] = {0};
static const float half = .70710678f;

/* Two nodes, a long step along x apart; an object hangs on the second. */
static struct rig_node nodes[] = {
	{SM_NONE, IDENTITY},
	{0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}},
};
static uint32_t object_nodes[] = {1};

/* A triangle with normals along z. */
static const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
static const uint32_t indices[] = {0, 1, 2};
static const struct sm_mesh_desc mesh = {.positions = corners,
	.normals = normals,
	.vertex_count = 3,
	.indices = indices,
	.index_count = 3};

static void find(struct pose *pose, const struct rig *rig, const struct clip *clip, double seconds)
{
	struct sm_error error;
	assert_true(pose_init(pose, rig, &mesh, &error));
	pose_find(pose, rig, &mesh, clip, seconds);
}

/* The first node is turned about z in four seconds, from 1 s to 3 s by a half turn each second. */
static void nodes_carry_their_children(void **state)
{
	static const float times[] = {1, 2, 3}, still[] = {0, 0, 0}, size[] = {1, 2, 1};
	const float turns[] = {0, 0, 0, 1, 0, 0, half, half, 0, 0, 1, 0};
	struct channel channel = {
		.node = 0,
		.position = {1, once, still},
		.rotation = {3, times, turns},
		.scale = {1, once, size},
	};
	const struct clip clip = {.duration = 4, .channels = &channel, .channel_count = 1};
	const struct rig rig = {
		.nodes = nodes, .node_count = 2, .object_nodes = object_nodes, .object_count = 1};
	static const struct {
		double seconds, degrees;
	} cases[] = {{0, 0}, {1, 0}, {1.5, 45}, {2, 90}, {2.5, 135}, {3, 180}, {3.9, 180}, {4.5, 0},
		{9.5, 45}, {-2, 90}, {-1, 180}};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct pose pose;
		find(&pose, &rig, &clip, cases[i].seconds);
		double angle = cases[i].degrees * M_PI / 180;
		float c = (float)cos(angle), s = (float)sin(angle);
		check_floats(pose.transforms[0],
			(float[]){
				c, s, 0, 0, -2 * s, 2 * c, 0, 0, 0, 0, 1, 0, 10 * c, 10 * s, 0, 1},
			16);
		pose_finish(&pose, &rig);
	}
}

static void positions_and_scales_are_even(void **state)
{
	static const float times[] = {0, 1, 1, 2}, places[] = {0, 0, 0, 4, 0, 0, 8, 0, 0, 8, 2, 0};
	static const float sizes[] = {1, 1, 1, 3, 1, 1, 3, 1, 1, 3, 1, 5},
			   straight[] = {0, 0, 0, 1};
	struct channel channel = {
		.node = 1,
		.position = {4, times, places},
		.rotation = {1, once, straight},
		.scale = {4, times, sizes},
	};
	const struct clip clip = {.duration = 2, .channels = &channel, .channel_count = 1};
	const struct rig rig = {
		.nodes = nodes, .node_count = 2, .object_nodes = object_nodes, .object_count = 1};
	static const struct {
		double seconds;
		float x, y, width, depth;
	} cases[] = {{0, 0, 0, 1, 1}, {.25, 1, 0, 1.5f, 1}, {1, 8, 0, 3, 1}, {1.5, 8, 1, 3, 3},
		{2, 0, 0, 1, 1}};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct pose pose;
		find(&pose, &rig, &clip, cases[i].seconds);
		check_floats(pose.transforms[0],
			(float[]){cases[i].width, 0, 0, 0, 0, 1, 0, 0, 0, 0, cases[i].depth, 0,
				cases[i].x, cases[i].y, 0, 1},
			16);
		pose_finish(&pose, &rig);
	}
}

/* From 60 degrees to the left to 60 to the right, given with opposite signs. */
static void rotations_take_the_shorter_way(void **state)
{
	static const float times[] = {0, 2}, still[] = {0, 0, 0}, size[] = {1, 1, 1};
	const float turns[] = {0, .5f, 0, .8660254f, 0, .5f, 0, -.8660254f};
	struct channel channel = {
		.node = 0,
		.position = {1, once, still},
		.rotation = {2, times, turns},
		.scale = {1, once, size},
	};
	const struct clip clip = {.duration = 2, .channels = &channel, .channel_count = 1};
	const struct rig rig = {
		.nodes = nodes, .node_count = 2, .object_nodes = object_nodes, .object_count = 1};
	struct pose pose;
	(void)state;
	find(&pose, &rig, &clip, .5);
	check_floats(&pose.transforms[0][12], (float[]){8.660254f, 0, -5}, 3);
	pose_finish(&pose, &rig);
}

static void without_a_clip_all_is_at_rest(void **state)
{
	const struct rig rig = {
		.nodes = nodes, .node_count = 2, .object_nodes = object_nodes, .object_count = 1};
	struct pose pose;
	(void)state;
	find(&pose, &rig, NULL, 5);
	assert_memory_equal(pose.transforms[0], nodes[1].local, sizeof(nodes[1].local));
	pose_finish(&pose, &rig);
}

/* One target lifts the last corner, the other pushes all back and tilts their normals. */
static void targets_add_up(void **state)
{
	static const float lift[] = {0, 0, 0, 0, 0, 0, 0, 2, 0};
	static const float push[] = {0, 0, -1, 0, 0, -1, 0, 0, -1};
	static const float tilt[] = {0, 1, -1, 0, 1, -1, 0, 1, -1};
	static const float rest[] = {0, .5f}, times[] = {0, 1}, weights[] = {0, 0, 1, -2};
	struct morph_target targets[] = {{lift, NULL}, {push, tilt}};
	struct shape shape = {.targets = targets, .weights = rest, .target_count = 2};
	struct rig rig = {
		.nodes = nodes,
		.node_count = 2,
		.object_nodes = object_nodes,
		.object_count = 1,
		.shapes = &shape,
		.shape_count = 1,
	};
	struct blend blend = {.weights = {2, times, weights}};
	const struct clip clip = {.duration = 2, .blends = &blend, .blend_count = 1};
	struct pose pose;
	(void)state;
	find(&pose, &rig, NULL, 0);
	check_floats(pose.shapes[0].positions, (float[]){0, 0, -.5f, 1, 0, -.5f, 0, 1, -.5f}, 9);
	check_floats(pose.shapes[0].normals, (float[]){0, .5f, .5f, 0, .5f, .5f, 0, .5f, .5f}, 9);
	/* The object is where its node is. */
	assert_true(pose.transforms[0][12] == 10);
	pose_find(&pose, &rig, &mesh, &clip, .5);
	check_floats(pose.shapes[0].positions, (float[]){0, 0, 1, 1, 0, 1, 0, 2, 1}, 9);
	pose_find(&pose, &rig, &mesh, &clip, 1.75);
	check_floats(pose.shapes[0].positions, (float[]){0, 0, 2, 1, 0, 2, 0, 3, 2}, 9);
	check_floats(pose.shapes[0].normals, (float[]){0, -2, 3, 0, -2, 3, 0, -2, 3}, 9);
	pose_finish(&pose, &rig);
}

/* The first corner has no bone, the second hangs on one, the third on two by a quarter and three
 * quarters. One bone stands still, the other is turned about z, after it was bound at (0, 1, 0). */
static void bones_take_vertices_along(void **state)
{
	static const float still[] = {0, 1, 0}, size[] = {1, 1, 1};
	const float turn[] = {half, 0, 0, half};
	static struct rig_node bone_nodes[] = {{SM_NONE, IDENTITY},
		{0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}},
		{0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1}}};
	struct channel channel = {
		.node = 2,
		.position = {1, once, still},
		.rotation = {1, once, turn},
		.scale = {1, once, size},
	};
	const struct clip clip = {.channels = &channel, .channel_count = 1};
	struct bone bones[] = {
		{0, IDENTITY}, {2, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}}};
	static const uint32_t first[] = {0, 0, 1, 3};
	static const struct influence influences[] = {{1, 1}, {0, .25f}, {1, .75f}};
	struct shape shape = {
		.bones = bones, .bone_count = 2, .first = first, .influences = influences};
	struct rig rig = {
		.nodes = bone_nodes,
		.node_count = 3,
		.object_nodes = object_nodes,
		.object_count = 1,
		.shapes = &shape,
		.shape_count = 1,
	};
	const float identity[16] = IDENTITY;
	struct pose pose;
	(void)state;
	find(&pose, &rig, &clip, 7);
	/* A quarter turn about the x axis through (0, 1, 0): y goes to z. */
	check_floats(pose.shapes[0].positions, (float[]){10, 0, 0, 1, 1, -1, 0, 1, 0}, 9);
	check_floats(pose.shapes[0].normals, (float[]){0, 0, 1, 0, -1, 0, 0, -.75f, .25f}, 9);
	check_floats(pose.transforms[0], identity, 16);
	pose_find(&pose, &rig, &mesh, NULL, 7);
	check_floats(pose.shapes[0].positions, (float[]){10, 0, 0, 1, 0, 0, 0, 1, 0}, 9);
	pose_finish(&pose, &rig);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nodes_carry_their_children),
		cmocka_unit_test(positions_and_scales_are_even),
		cmocka_unit_test(rotations_take_the_shorter_way),
		cmocka_unit_test(without_a_clip_all_is_at_rest),
		cmocka_unit_test(targets_add_up),
		cmocka_unit_test(bones_take_vertices_along),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
