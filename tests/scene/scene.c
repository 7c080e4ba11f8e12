/* SPDX-License-Identifier: MIT */
#include "scene/scene.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* A triangle in the box from (-1, 0, 2) to (3, 1, 4). */
static const float positions[][3] = {{-1, 0, 2}, {3, 0, 4}, {0, 1, 2}};
static const uint32_t indices[] = {0, 1, 2};
static const struct sm_mesh_desc triangle = {
	.positions = positions[0], .vertex_count = 3, .indices = indices, .index_count = 3};

static const struct sm_object_desc still = {
	.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
	.base_color = {1, 1, 1, 1},
	.image = SM_NONE,
	.casts = true,
	.receives = true,
};

static const struct sm_light_desc lamp = {
	.type = SM_LIGHT_SPOT,
	.position = {0, 4, 0},
	.radius = 0.1f,
	.angle = 60,
	.color = {1, 1, 1},
	.intensity = 1,
};

static int set_up(void **state)
{
	*state = sm_scene_create();
	return *state == NULL ? -1 : 0;
}

static int tear_down(void **state)
{
	sm_scene_destroy(*state);
	return 0;
}

#define scene_test(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

static void handles_count_from_zero(void **state)
{
	struct sm_scene *scene = *state;
	static const uint8_t texel[4] = {0};
	for (uint32_t i = 0; i < 100; i++) {
		uint32_t mesh, image, object, light;
		assert_true(sm_scene_add_mesh(scene, &triangle, &mesh, NULL));
		assert_true(sm_scene_add_image(scene, 1, 1, texel, &image, NULL));
		assert_true(sm_scene_add_light(scene, &lamp, &light, NULL));
		struct sm_object_desc desc = still;
		desc.mesh = mesh;
		desc.image = image;
		assert_true(sm_scene_add_object(scene, &desc, &object, NULL));
		assert_true(mesh == i && image == i && object == i && light == i);
		assert_int_equal(sm_scene_mesh_count(scene), i + 1);
		assert_int_equal(sm_scene_object_count(scene), i + 1);
		assert_int_equal(sm_scene_light_count(scene), i + 1);
	}
}

static void what_is_given_is_copied(void **state)
{
	struct sm_scene *scene = *state;
	char name[] = "lantern";
	uint8_t texel[4] = {1, 2, 3, 4};
	uint32_t handle;
	struct sm_light_desc light = lamp;
	light.name = name;
	assert_true(sm_scene_add_light(scene, &light, &handle, NULL));
	assert_true(sm_scene_add_image(scene, 1, 1, texel, &handle, NULL));
	memset(name, 'x', sizeof(name) - 1);
	memset(texel, 9, sizeof(texel));
	assert_string_equal(scene->lights[0].desc.name, "lantern");
	assert_memory_equal(scene->images[0].rgba, ((uint8_t[]){1, 2, 3, 4}), 4);
}

static void mesh_stats_are_those_of_the_mesh(void **state)
{
	struct sm_scene *scene = *state;
	struct sm_mesh_stats stats;
	uint32_t mesh;
	assert_true(sm_scene_add_mesh(scene, &triangle, &mesh, NULL));
	sm_scene_get_mesh_stats(scene, mesh, &stats);
	assert_int_equal(stats.triangles, 1);
	assert_int_equal(stats.open_edges, 3);
}

static void scenes_have_ids_of_their_own(void **state)
{
	struct sm_scene *scene = *state, *other = sm_scene_create();
	assert_non_null(other);
	assert_true(scene->id != 0 && other->id != 0 && scene->id != other->id);
	sm_scene_destroy(other);
	sm_scene_destroy(NULL);
}

static void assert_input_error(const struct sm_error *error, const char *text)
{
	assert_int_equal(error->status, SM_ERROR_INPUT);
	if (strstr(error->text, text) == NULL)
		fail_msg("\"%s\" says nothing of \"%s\"", error->text, text);
}

static void meshes_that_are_none_are_refused(void **state)
{
	struct sm_scene *scene = *state;
	static const float infinite[][3] = {{-1, 0, 2}, {(float)INFINITY, 0, 4}, {0, 1, 2}};
	static const uint32_t beyond[] = {0, 1, 3};
	struct sm_mesh_desc cases[] = {triangle, triangle, triangle};
	cases[0].indices = beyond;
	cases[1].positions = infinite[0];
	cases[2].index_count = 0;
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		uint32_t mesh = 7;
		struct sm_error error = {0};
		cases[i].name = "stone";
		assert_false(sm_scene_add_mesh(scene, &cases[i], &mesh, &error));
		assert_input_error(&error, "stone");
		assert_false(sm_scene_add_mesh(scene, &cases[i], &mesh, NULL));
		assert_int_equal(sm_scene_mesh_count(scene), 0);
		assert_int_equal(mesh, 7);
	}
}

static void images_without_or_beyond_size_are_refused(void **state)
{
	struct sm_scene *scene = *state;
	static const uint32_t sizes[][2] = {
		{0, 1}, {1, 0}, {16385, 1}, {1, 16385}, {UINT32_MAX, UINT32_MAX}};
	for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
		uint32_t image;
		struct sm_error error = {0};
		static const uint8_t texel[4];
		assert_false(
			sm_scene_add_image(scene, sizes[i][0], sizes[i][1], texel, &image, &error));
		assert_input_error(&error, "sizes go from 1 to 16384");
	}
}

static void objects_of_nothing_or_nowhere_are_refused(void **state)
{
	struct sm_scene *scene = *state;
	uint32_t handle;
	assert_true(sm_scene_add_mesh(scene, &triangle, &handle, NULL));
	struct {
		struct sm_object_desc desc;
		const char *text;
	} cases[] = {
		{still, "object hill: no mesh 1"},
		{still, "object without a name: no mesh 1"},
		{still, "object hill: no image 0"},
		{still, "object hill: its transform is not finite and affine"},
		{still, "object hill: its transform is not finite and affine"},
		{still, "object hill: its transform is not finite and affine"},
		{still, "object hill: its colour is not finite"},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		cases[i].desc.name = "hill";
	cases[0].desc.mesh = 1;
	cases[1].desc.mesh = 1;
	cases[1].desc.name = NULL;
	cases[2].desc.image = 0;
	cases[3].desc.transform[12] = (float)NAN;
	cases[4].desc.transform[3] = 1;
	cases[5].desc.transform[15] = 2;
	cases[6].desc.base_color[1] = (float)INFINITY;
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_error error = {0};
		assert_false(sm_scene_add_object(scene, &cases[i].desc, &handle, &error));
		assert_input_error(&error, cases[i].text);
	}
	assert_int_equal(sm_scene_object_count(scene), 0);
}

static void transforms_are_set_on_objects_that_are_there(void **state)
{
	struct sm_scene *scene = *state;
	struct sm_error error = {0};
	uint32_t handle;
	float min[3], max[3], skewed[16];
	assert_false(sm_scene_set_transform(scene, 0, still.transform, &error));
	assert_input_error(&error, "no object 0");

	struct sm_object_desc desc = still;
	desc.name = "hill";
	assert_true(sm_scene_add_mesh(scene, &triangle, &handle, NULL));
	assert_true(sm_scene_add_object(scene, &desc, &handle, NULL));
	memcpy(skewed, still.transform, sizeof(skewed));
	skewed[7] = 0.5f;
	assert_false(sm_scene_set_transform(scene, handle, skewed, &error));
	assert_input_error(&error, "object hill: its transform is not finite and affine");
	/* Finite in all that is given, yet not where it comes to lie. */
	memcpy(skewed, still.transform, sizeof(skewed));
	skewed[5] = skewed[13] = 3e38f;
	assert_false(sm_scene_set_transform(scene, handle, skewed, &error));
	assert_input_error(&error, "object hill: it reaches too far for numbers");
	/* The refused ones have changed nothing. */
	assert_true(sm_scene_get_bounds(scene, false, min, max));
	assert_true(max[1] == 1);
}

static void moved_vertices_move_the_objects(void **state)
{
	struct sm_scene *scene = *state;
	struct sm_error error = {0};
	struct sm_object_desc desc = still;
	static const float moved[][3] = {{-1, 0, 2}, {3, 0, 4}, {0, 7, 2}};
	static const float broken[][3] = {{-1, 0, 2}, {3, 0, 4}, {0, (float)NAN, 2}};
	static const float endless[][3] = {{-1, 0, 2}, {3, 0, 4}, {0, (float)INFINITY, 2}};
	static const float distant[][3] = {{-1, 0, 2}, {3, 0, 4}, {0, 3e38f, 2}};
	uint32_t meshes[2], objects[3];
	float min[3], max[3];
	assert_false(sm_scene_set_vertices(scene, 0, moved[0], NULL, &error));
	assert_input_error(&error, "no mesh 0");
	assert_true(sm_scene_add_mesh(scene, &triangle, &meshes[0], NULL));
	assert_true(sm_scene_add_mesh(scene, &triangle, &meshes[1], NULL));
	for (uint32_t i = 0; i < 3; i++) {
		desc.mesh = i / 2;
		desc.transform[5] = i == 1 ? 2 : 1;
		assert_true(sm_scene_add_object(scene, &desc, &objects[i], NULL));
	}
	uint64_t before = scene->version;
	assert_true(sm_scene_set_vertices(scene, 0, positions[0], NULL, NULL));
	assert_false(sm_scene_set_vertices(scene, 0, broken[0], NULL, &error));
	assert_input_error(&error, "vertex 2 is not finite");
	assert_false(sm_scene_set_vertices(scene, 0, endless[0], NULL, &error));
	assert_input_error(&error, "vertex 2 is not finite");
	assert_false(sm_scene_set_vertices(scene, 0, distant[0], NULL, &error));
	assert_input_error(&error, "it reaches too far for numbers");
	assert_true(scene->version == before && scene->meshes[0].max[1] == 1);

	assert_true(sm_scene_set_vertices(scene, 0, moved[0], NULL, NULL));
	assert_true(scene->meshes[0].version > before && scene->meshes[1].version <= before);
	assert_true(scene->objects[0].version > before && scene->objects[1].version > before &&
		    scene->objects[2].version <= before);
	assert_true(sm_scene_get_bounds(scene, false, min, max));
	assert_true(scene->objects[0].max[1] == 7 && max[1] == 14);
	assert_true(scene->objects[2].max[1] == 1);
}

static void lights_that_are_none_are_refused(void **state)
{
	struct sm_scene *scene = *state;
	const float nan = (float)NAN, infinity = (float)INFINITY;
	struct {
		struct sm_light_desc desc;
		const char *text;
	} cases[] = {
		{lamp, "position or target is not finite"},
		{lamp, "position or target is not finite"},
		{lamp, "its target is its position"},
		{lamp, "its radius is not a length"},
		{lamp, "its radius is not a length"},
		{lamp, "not above 0 and up to 170"},
		{lamp, "not above 0 and up to 170"},
		{lamp, "not above 0 and up to 170"},
		{lamp, "softness is not from 0 to 1"},
		{lamp, "softness is not from 0 to 1"},
		{lamp, "colour or intensity is not finite"},
		{lamp, "colour or intensity is not finite"},
	};
	cases[0].desc.position[2] = infinity;
	cases[1].desc.target[0] = nan;
	memcpy(cases[2].desc.target, lamp.position, sizeof(lamp.position));
	cases[3].desc.radius = -1;
	cases[4].desc.radius = infinity;
	cases[5].desc.angle = 0;
	cases[6].desc.angle = 171;
	cases[7].desc.angle = nan;
	cases[8].desc.softness = 1.5f;
	cases[9].desc.softness = nan;
	cases[10].desc.color[0] = nan;
	cases[11].desc.intensity = infinity;
	uint32_t light;
	assert_true(sm_scene_add_light(scene, &lamp, &light, NULL));
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct sm_error error = {0};
		cases[i].desc.name = "moon";
		assert_false(sm_scene_add_light(scene, &cases[i].desc, &light, &error));
		assert_input_error(&error, "light moon: ");
		assert_input_error(&error, cases[i].text);
		assert_false(sm_scene_set_light(scene, 0, &cases[i].desc, NULL));
	}
	assert_int_equal(sm_scene_light_count(scene), 1);
	assert_memory_equal(scene->lights[0].desc.position, lamp.position, sizeof(lamp.position));
	struct sm_error error = {0};
	assert_false(sm_scene_set_light(scene, 1, &lamp, &error));
	assert_input_error(&error, "no light 1");
}

static void a_directional_light_has_no_cone(void **state)
{
	struct sm_light_desc sun = lamp;
	uint32_t light;
	sun.type = SM_LIGHT_DIRECTIONAL;
	sun.angle = 0;
	assert_true(sm_scene_add_light(*state, &sun, &light, NULL));
}

static void bounds_enclose_objects_or_casters(void **state)
{
	struct sm_scene *scene = *state;
	float min[3], max[3];
	uint32_t handle;
	struct sm_object_desc desc = still;
	assert_true(sm_scene_add_mesh(scene, &triangle, &handle, NULL));
	assert_false(sm_scene_get_bounds(scene, false, min, max));

	desc.casts = false;
	assert_true(sm_scene_add_object(scene, &desc, &handle, NULL));
	assert_false(sm_scene_get_bounds(scene, true, min, max));
	assert_true(sm_scene_get_bounds(scene, false, min, max));
	assert_memory_equal(min, ((float[]){-1, 0, 2}), sizeof(min));
	assert_memory_equal(max, ((float[]){3, 1, 4}), sizeof(max));

	/* A caster, turned by 90 degrees about z (x to y, y to -x), doubled and moved. */
	static const float turned[16] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1};
	desc.casts = true;
	memcpy(desc.transform, turned, sizeof(turned));
	assert_true(sm_scene_add_object(scene, &desc, &handle, NULL));
	assert_true(sm_scene_get_bounds(scene, true, min, max));
	assert_memory_equal(min, ((float[]){8, 18, 34}), sizeof(min));
	assert_memory_equal(max, ((float[]){10, 26, 38}), sizeof(max));
	assert_true(sm_scene_get_bounds(scene, false, min, max));
	assert_memory_equal(min, ((float[]){-1, 0, 2}), sizeof(min));
	assert_memory_equal(max, ((float[]){10, 26, 38}), sizeof(max));

	assert_true(sm_scene_set_transform(scene, handle, still.transform, NULL));
	assert_true(sm_scene_get_bounds(scene, true, min, max));
	assert_memory_equal(max, ((float[]){3, 1, 4}), sizeof(max));
}

/* A tetrahedron counts on one side as long as the near plane does not cut its mesh, of which a
 * triangle is left over. */
static void closed_parts_count_on_one_side(void **state)
{
	struct sm_scene *scene = *state;
	static const float corners[][3] = {{0.5f, 0.5f, 0.5f}, {0.5f, -0.5f, -0.5f},
		{-0.5f, 0.5f, -0.5f}, {-0.5f, -0.5f, 0.5f}, {0, 0, 0.7f}, {0.1f, 0, 0.8f},
		{0, 0.1f, 0.8f}};
	static const uint32_t faces[] = {4, 5, 6, 0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
	const struct sm_mesh_desc desc = {
		.positions = corners[0], .vertex_count = 7, .indices = faces, .index_count = 15};
	uint32_t handle;
	assert_true(sm_scene_add_mesh(scene, &desc, &handle, NULL));
	const struct mesh *mesh = &scene->meshes[handle];
	assert_false(mesh->solid);

	mat4 transform = GLM_MAT4_IDENTITY_INIT, to_clip = GLM_MAT4_IDENTITY_INIT;
	struct sheet_rule rule = mesh_sheet_rule(mesh, transform, to_clip);
	assert_true(rule.one_sided == 4 && !rule.mirrored);
	transform[1][1] = -1.0f;
	rule = mesh_sheet_rule(mesh, transform, to_clip);
	assert_true(rule.one_sided == 4 && rule.mirrored);
	to_clip[3][2] = -0.6f;
	rule = mesh_sheet_rule(mesh, transform, to_clip);
	assert_true(rule.one_sided == 0 && rule.mirrored);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		scene_test(handles_count_from_zero),
		scene_test(what_is_given_is_copied),
		scene_test(mesh_stats_are_those_of_the_mesh),
		scene_test(scenes_have_ids_of_their_own),
		scene_test(meshes_that_are_none_are_refused),
		scene_test(images_without_or_beyond_size_are_refused),
		scene_test(objects_of_nothing_or_nowhere_are_refused),
		scene_test(transforms_are_set_on_objects_that_are_there),
		scene_test(moved_vertices_move_the_objects),
		scene_test(lights_that_are_none_are_refused),
		scene_test(a_directional_light_has_no_cone),
		scene_test(bounds_enclose_objects_or_casters),
		scene_test(closed_parts_count_on_one_side),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
