/* SPDX-License-Identifier: MIT */
/* Numerical stress, as much of it as fits a test; "smoothie bench --stress" runs all. */
#include "bench/stress.h"
#include "bench/stress_file.h"
#include "bench/stress_shape.h"
#include "bench/stress_shrink.h"
#include "platform.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static struct platform *platform;
static struct stress_probe probe;

static int open_probe(void **state)
{
	struct sm_error error;
	(void)state;
	platform = platform_create("surfaceless", true, &error);
	if (platform == NULL || !stress_probe_init(&probe, platform_get_proc, &error))
		fail_msg("%s", error.text);
	return 0;
}

static int close_probe(void **state)
{
	(void)state;
	stress_probe_finish(&probe);
	platform_destroy(platform);
	return 0;
}

static void print_fault(void *data, const char *place, const struct stress_scene *scene,
	const struct stress_fault *fault)
{
	(void)data;
	(void)scene;
	print_error("%s: %s\n", place, fault->text);
}

static void sweep_keeps_its_bounds(void **state)
{
	const struct stress_sweep *sweep = *state;
	const struct stress_listener listener = {NULL, print_fault};
	struct stress_outcome outcome = {0};
	struct sm_error error;
	if (!stress_sweep_run(sweep, &probe, NULL, STRESS_QUICK, &listener, &outcome, &error))
		fail_msg("%s", error.text);
	assert_int_equal(outcome.failures, 0);
	assert_true(outcome.checks > 0 || sweep->quick == 0);
}

#define SEED 20031

static void random_scenes_break_no_rule(void **state)
{
	(void)state;
	print_message("seed %d, %d scenes\n", SEED, RANDOM_SCENES);
	for (uint32_t i = 0; i < RANDOM_SCENES; i++) {
		struct stress_scene scene;
		struct stress_fault fault;
		assert_true(stress_random_scene(&scene, SEED, i, NULL, &probe, NULL));
		assert_true(stress_file_can_say(&scene));
		if (!stress_random_check(&probe, &scene, NULL, &fault))
			fail_msg("scene %u: %s", i, fault.text);
		stress_scene_finish(&scene);
	}
}

/* The same scene, wherever and whenever it is made. */
static void a_seed_and_a_number_name_a_scene(void **state)
{
	struct stress_scene a, b, c;
	(void)state;
	assert_true(stress_random_scene(&a, 1, 7, NULL, &probe, NULL));
	assert_true(stress_random_scene(&b, 1, 7, NULL, &probe, NULL));
	assert_true(stress_random_scene(&c, 1, 8, NULL, &probe, NULL));
	assert_memory_equal(&a.camera, &b.camera, sizeof(a.camera));
	assert_int_equal(a.object_count, b.object_count);
	assert_memory_not_equal(&a.camera, &c.camera, sizeof(a.camera));
	stress_scene_finish(&a);
	stress_scene_finish(&b);
	stress_scene_finish(&c);
}

/* A rule that scenes break which have, somewhere, a long triangle of a caster, and a light with a
 * radius. */
static bool has_no_long_triangle(const struct stress_scene *scene)
{
	bool radius = false, is_long = false;
	for (size_t i = 0; i < scene->light_count; i++)
		radius = radius || scene->lights[i].radius > 0;
	for (size_t i = 0; i < scene->object_count; i++) {
		const struct stress_mesh *mesh = &scene->objects[i].mesh;
		for (size_t j = 0; j < mesh->index_count && scene->objects[i].casts; j++)
			is_long = is_long || mesh->positions[mesh->indices[j]][0] > .5f;
	}
	return !radius || !is_long;
}

static size_t triangles_of(const struct stress_scene *scene)
{
	size_t count = 0;
	for (size_t i = 0; i < scene->object_count; i++)
		count += scene->objects[i].mesh.index_count / 3;
	return count;
}

static void find_breaking_scene(struct stress_scene *scene, struct stress_fault *fault)
{
	for (uint32_t i = 0;; i++) {
		assert_true(stress_random_scene(scene, SEED, i, "hard", &probe, NULL));
		if (scene->object_count > 2 && scene->light_count > 1 &&
			!stress_random_check(&probe, scene, has_no_long_triangle, fault))
			return;
		stress_scene_finish(scene);
	}
}

static void what_breaks_a_rule_is_shrunk(void **state)
{
	struct stress_scene scene;
	struct stress_fault fault;
	(void)state;
	find_breaking_scene(&scene, &fault);
	stress_shrink(&scene, &probe, has_no_long_triangle, &fault);
	assert_false(has_no_long_triangle(&scene));
	assert_int_equal(scene.object_count, 1);
	assert_int_equal(scene.light_count, 1);
	assert_int_equal(triangles_of(&scene), 1);
	assert_int_equal(scene.width * scene.height, 1);
	assert_true(scene.lights[0].radius == 1 || scene.lights[0].radius < 1e-2f);
	assert_true(stress_file_can_say(&scene));
	stress_scene_finish(&scene);
}

/* In the mean. */
static double change_between(const struct stress_picture *a, const struct stress_picture *b)
{
	size_t count = (size_t)a->width * a->height;
	double sum = 0;
	for (size_t i = 0; i < count; i++)
		sum += fabs((double)a->values[i] - (double)b->values[i]);
	return sum / (double)count;
}

static void a_written_scene_looks_the_same(void **state)
{
	char folder[] = "/tmp/stress-XXXXXX", path[200], command[64];
	(void)state;
	assert_non_null(mkdtemp(folder));
	for (uint32_t i = 0; i < 8; i++) {
		struct stress_scene scene;
		struct stress_picture drawn, loaded;
		struct stress_fault fault;
		struct sm_error error;
		assert_true(stress_random_scene(&scene, SEED, i, NULL, &probe, NULL));
		assert_true(stress_check_scene(&probe, &scene, &drawn, &fault));
		if (!stress_file_write(&scene, folder, "scene", path, sizeof(path), &error) ||
			!stress_file_check(path, &probe, &loaded, &fault, &error))
			fail_msg("%s", error.text);
		assert_string_equal(fault.text, "");
		assert_int_equal(loaded.width, drawn.width);
		assert_int_equal(loaded.height, drawn.height);
		if (change_between(&drawn, &loaded) > 1e-3)
			fail_msg("scene %u changes by %g", i, change_between(&drawn, &loaded));
		stress_picture_finish(&drawn);
		stress_picture_finish(&loaded);
		stress_scene_finish(&scene);
	}
	snprintf(command, sizeof(command), "rm -r %s", folder);
	assert_int_equal(system(command), 0);
}

#define SWEEPS_MAX 64
#define OTHERS 4

int main(void)
{
	struct CMUnitTest tests[SWEEPS_MAX + OTHERS] = {
		cmocka_unit_test(random_scenes_break_no_rule),
		cmocka_unit_test(a_seed_and_a_number_name_a_scene),
		cmocka_unit_test(what_breaks_a_rule_is_shrunk),
		cmocka_unit_test(a_written_scene_looks_the_same),
	};
	size_t count = OTHERS;
	const struct stress_sweep *sweep;
	for (size_t i = 0; (sweep = stress_sweep_at(i)) != NULL && i < SWEEPS_MAX; i++)
		tests[count++] = (struct CMUnitTest){.name = sweep->name,
			.test_func = sweep_keeps_its_bounds,
			.initial_state = (void *)sweep};
	return _cmocka_run_group_tests("stress", tests, count, open_probe, close_probe);
}
