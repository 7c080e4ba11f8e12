/* SPDX-License-Identifier: MIT */
#include "load/builtin.h"
#include "load/model.h"
#include "load/stage.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Triangles over distinct vertices, each turned so that its least index comes first, sorted. */
struct soup {
	float (*vertices)[3];
	uint32_t (*triangles)[3];
	size_t vertex_count, triangle_count;
};

static void soup_finish(struct soup *soup)
{
	free(soup->vertices);
	free(soup->triangles);
}

static int compare_triangles(const void *a, const void *b)
{
	const uint32_t *first = a, *second = b;
	for (int i = 0; i < 3; i++)
		if (first[i] != second[i])
			return first[i] < second[i] ? -1 : 1;
	return 0;
}

static void soup_sort(struct soup *soup)
{
	for (size_t i = 0; i < soup->triangle_count; i++) {
		uint32_t *t = soup->triangles[i];
		while (t[0] > t[1] || t[0] > t[2]) {
			uint32_t first = t[0];
			t[0] = t[1];
			t[1] = t[2];
			t[2] = first;
		}
	}
	qsort(soup->triangles, soup->triangle_count, sizeof(*soup->triangles), compare_triangles);
}

/* An OBJ file's vertices and triangles without those of its first object, the ground. */
static struct soup soup_read(const char *path)
{
	struct soup soup = {
		.vertices = calloc(20000, sizeof(*soup.vertices)),
		.triangles = calloc(30000, sizeof(*soup.triangles)),
	};
	FILE *file = fopen(path, "r");
	assert_non_null(file);
	char line[200];
	int objects = 0;
	while (fgets(line, sizeof(line), file) != NULL) {
		float *v = soup.vertices[soup.vertex_count];
		uint32_t *t = soup.triangles[soup.triangle_count];
		objects += line[0] == 'o';
		if (sscanf(line, "v %f %f %f", &v[0], &v[1], &v[2]) == 3)
			soup.vertex_count++;
		else if (objects > 1 && sscanf(line, "f %u %u %u", &t[0], &t[1], &t[2]) == 3)
			soup.triangle_count++;
	}
	fclose(file);
	for (size_t i = 0; i < soup.triangle_count; i++)
		for (int k = 0; k < 3; k++)
			soup.triangles[i][k]--;
	soup_sort(&soup);
	return soup;
}

static bool is_near(const float a[3], const float b[3])
{
	return fabsf(a[0] - b[0]) <= 1e-5f && fabsf(a[1] - b[1]) <= 1e-5f &&
	       fabsf(a[2] - b[2]) <= 1e-5f;
}

static uint32_t nearest(const struct soup *soup, const float position[3])
{
	for (size_t i = 0; i < soup->vertex_count; i++)
		if (is_near(soup->vertices[i], position))
			return (uint32_t)i;
	fail_msg("no vertex of the file is at %g %g %g", (double)position[0], (double)position[1],
		(double)position[2]);
	return 0;
}

/* A model's triangles in terms of the file's vertices; its objects stand where they are. */
static struct soup soup_generate(const struct model *model, const struct soup *file)
{
	struct soup soup = {.triangles = calloc(30000, sizeof(*soup.triangles))};
	for (size_t m = 0; m < model->mesh_count; m++) {
		const struct sm_mesh_desc *mesh = &model->meshes[m];
		uint32_t *names = calloc(mesh->vertex_count, sizeof(*names));
		for (size_t i = 0; i < mesh->vertex_count; i++)
			names[i] = nearest(file, mesh->positions + 3 * i);
		for (size_t i = 0; i < mesh->index_count; i += 3, soup.triangle_count++)
			for (int k = 0; k < 3; k++)
				soup.triangles[soup.triangle_count][k] =
					names[mesh->indices[i + k]];
		free(names);
	}
	soup_sort(&soup);
	return soup;
}

static void study_scenes_equal_their_files(void **state)
{
	static const char *const names[] = {
		"cylinder", "boxes", "fence", "knot", "urchin", "debris"};
	(void)state;
	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++) {
		char path[4096];
		snprintf(path, sizeof(path), SMOOTHIE_SHARED "/scenes/%s.obj", names[i]);
		FILE *file = fopen(path, "r");
		if (file == NULL)
			skip();
		fclose(file);
		struct soup expected = soup_read(path);
		struct model *model = model_create(NULL);
		assert_true(builtin_build(names[i], model, NULL));
		struct soup got = soup_generate(model, &expected);
		assert_int_equal(got.triangle_count, expected.triangle_count);
		assert_memory_equal(got.triangles, expected.triangles,
			got.triangle_count * sizeof(*got.triangles));
		soup_finish(&got);
		soup_finish(&expected);
		model_destroy(model);
	}
}

static void triangle(const struct sm_mesh_desc *mesh, size_t index, const float *corners[3])
{
	for (int k = 0; k < 3; k++)
		corners[k] = mesh->positions + 3 * mesh->indices[index + k];
}

static void face_normal(const float *const corners[3], float normal[3])
{
	float a[3], b[3];
	for (int k = 0; k < 3; k++) {
		a[k] = corners[1][k] - corners[0][k];
		b[k] = corners[2][k] - corners[0][k];
	}
	normal[0] = a[1] * b[2] - a[2] * b[1];
	normal[1] = a[2] * b[0] - a[0] * b[2];
	normal[2] = a[0] * b[1] - a[1] * b[0];
}

static float dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The volume inside is positive only if faces look outwards; a normal that looks inwards would
 * shade the wrong side. */
static void check_surface(const char *name, const struct sm_mesh_desc *mesh)
{
	double volume = 0;
	for (size_t i = 0; i < mesh->index_count; i += 3) {
		const float *corners[3];
		float normal[3];
		triangle(mesh, i, corners);
		face_normal(corners, normal);
		volume += (double)dot(corners[0], normal) / 6;
		assert_true(dot(normal, normal) > 0);
		for (int k = 0; mesh->normals != NULL && k < 3; k++) {
			const float *smooth = mesh->normals + 3 * mesh->indices[i + k];
			assert_float_equal(dot(smooth, smooth), 1, 1e-4);
			if (dot(smooth, normal) <= 0)
				fail_msg("%s: a normal looks inwards", name);
		}
	}
	assert_true(volume > 0);
}

static void surfaces_look_outwards(void **state)
{
	(void)state;
	for (size_t i = 0; builtin_name(i) != NULL; i++) {
		struct model *model = model_create(NULL);
		assert_true(builtin_build(builtin_name(i), model, NULL));
		assert_true(model->mesh_count > 0);
		for (size_t m = 0; m < model->mesh_count; m++)
			check_surface(builtin_name(i), &model->meshes[m]);
		model_destroy(model);
	}
}

static void solids_stand_in_a_unit_cube(void **state)
{
	(void)state;
	for (size_t i = 0; builtin_name(i) != NULL; i++) {
		struct model *model = model_create(NULL);
		assert_true(builtin_build(builtin_name(i), model, NULL));
		const struct sm_mesh_desc *mesh = &model->meshes[0];
		for (size_t v = 0; !model->has_camera && v < mesh->vertex_count; v++) {
			const float *p = mesh->positions + 3 * v;
			assert_true(fabsf(p[0]) <= .50001f && fabsf(p[2]) <= .50001f);
			assert_true(p[1] >= -1e-5f && p[1] <= 1.00001f);
		}
		model_destroy(model);
	}
}

static void all_but_the_ground_is_closed(void **state)
{
	(void)state;
	for (size_t i = 0; builtin_name(i) != NULL; i++) {
		char source[64];
		struct stage stage;
		struct sm_error error;
		snprintf(source, sizeof(source), "builtin:%s", builtin_name(i));
		if (!stage_load(&stage, source, NULL, 0, &error))
			fail_msg("%s", error.text);
		uint32_t open_meshes = 0;
		for (uint32_t m = 0; m < sm_scene_mesh_count(stage.scene); m++) {
			struct sm_mesh_stats stats;
			sm_scene_get_mesh_stats(stage.scene, m, &stats);
			assert_int_equal(stats.degenerate_triangles, 0);
			assert_int_equal(stats.non_manifold_edges + stats.inverted_edges, 0);
			assert_true(stats.open_edges == 0 || stats.triangles == 2);
			open_meshes += stats.open_edges > 0;
		}
		assert_int_equal(open_meshes, 1);
		stage_finish(&stage);
	}
}

static size_t count_triangles(const struct model *model)
{
	size_t indices = 0;
	for (size_t i = 0; i < model->mesh_count; i++)
		indices += model->meshes[i].index_count;
	return indices / 3;
}

static void primitives_have_their_size(void **state)
{
	(void)state;
	struct model *model = model_create(NULL);
	assert_true(builtin_build("primitives", model, NULL));
	assert_in_range(count_triangles(model), 9300, 9500);
	model_destroy(model);
}

static void sized_scenes_have_their_size_and_are_closed(void **state)
{
	static const char *const names[] = {"knot", "urchin", "debris"};
	static const uint32_t sizes[] = {100, 1000, 26000, 51000, 300000};
	(void)state;
	for (size_t i = 0; i < 3 * sizeof(sizes) / sizeof(*sizes); i++) {
		static const char *const settings[] = {"ground.show=no"};
		uint32_t size = sizes[i / 3];
		struct stage stage;
		struct sm_error error;
		struct sm_mesh_stats stats;
		char source[64];
		snprintf(source, sizeof(source), "builtin:%s:%u", names[i % 3], size);
		if (!stage_load(&stage, source, settings, 1, &error))
			fail_msg("%s", error.text);
		assert_int_equal(sm_scene_mesh_count(stage.scene), 1);
		sm_scene_get_mesh_stats(stage.scene, 0, &stats);
		/* Rounded splits and sides are coarse for few triangles. */
		double allowed = size >= 20000 ? .02 : .3;
		if (fabs((double)stats.triangles / size - 1) > allowed)
			fail_msg("%s has %zu triangles", source, stats.triangles);
		assert_int_equal(stats.open_edges + stats.non_manifold_edges, 0);
		assert_int_equal(stats.inverted_edges + stats.degenerate_triangles, 0);
		assert_int_equal(2 * stats.edges, 3 * stats.triangles);
		stage_finish(&stage);
	}
}

static void sized_surfaces_look_outwards(void **state)
{
	static const char *const names[] = {"knot:1000", "urchin:26000", "debris:1000"};
	(void)state;
	for (size_t i = 0; i < 3; i++) {
		struct model *model = model_create(NULL);
		assert_true(builtin_build(names[i], model, NULL));
		check_surface(names[i], &model->meshes[0]);
		model_destroy(model);
	}
}

static void sizes_that_are_none_are_refused(void **state)
{
	static const struct {
		const char *name, *text;
	} cases[] = {
		{"cube:500", "builtin:cube: it has one size"},
		{"knot:99", "builtin:knot:99: a number of triangles from 100 to 4000000 is wanted"},
		{"knot:4000001", "builtin:knot:4000001: a number of triangles from 100 to 4000000 "
				 "is wanted"},
		{"urchin:", "builtin:urchin:: a number of triangles from 100 to 4000000 is wanted"},
		{"debris:-500",
			"builtin:debris:-500: a number of triangles from 100 to 4000000 is wanted"},
		{"debris:500k",
			"builtin:debris:500k: a number of triangles from 100 to 4000000 is wanted"},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		struct model *model = model_create(NULL);
		struct sm_error error;
		assert_false(builtin_build(cases[i].name, model, &error));
		assert_int_equal(error.status, SM_ERROR_INPUT);
		assert_string_equal(error.text, cases[i].text);
		model_destroy(model);
	}
}

static void an_unknown_name_lists_the_known(void **state)
{
	(void)state;
	struct model *model = model_create(NULL);
	struct sm_error error;
	assert_false(builtin_build("teapot", model, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_string_equal(error.text,
		"builtin:teapot: no such scene; there are cylinder, boxes, fence, knot, urchin, "
		"debris, primitives, cube, sphere, icosahedron, pillar, cone, torus, vase");
	model_destroy(model);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(study_scenes_equal_their_files),
		cmocka_unit_test(surfaces_look_outwards),
		cmocka_unit_test(solids_stand_in_a_unit_cube),
		cmocka_unit_test(all_but_the_ground_is_closed),
		cmocka_unit_test(primitives_have_their_size),
		cmocka_unit_test(sized_scenes_have_their_size_and_are_closed),
		cmocka_unit_test(sized_surfaces_look_outwards),
		cmocka_unit_test(sizes_that_are_none_are_refused),
		cmocka_unit_test(an_unknown_name_lists_the_known),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
