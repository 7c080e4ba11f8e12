/* SPDX-License-Identifier: MIT */
/* Numerical stress, as much of it as fits a test; "smoothie bench --stress" runs all. */
#include "bench/stress.h"
#include "bench/stress_base.h"
#include "bench/stress_file.h"
#include "bench/stress_shape.h"
#include "bench/stress_shrink.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static struct platform *platform;
static struct stress_probe probe;
static const struct sm_driver_options all;

static int open_probe(void **state)
{
	struct sm_error error;
	(void)state;
	platform = platform_create("surfaceless", true, &error);
	if (platform == NULL || !stress_probe_init(&probe, platform_get_proc, &all, &error))
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

/* As the driver's limit, texels a side. */
static void maps_are_no_larger_than_the_driver_has(void **state)
{
	const struct stress_listener listener = {NULL, print_fault};
	struct stress_outcome outcome = {0};
	const struct stress_sweep *sweep = stress_sweep_at(0);
	struct sm_error error;
	uint32_t limit = probe.max_texture_size;
	(void)state;
	for (size_t i = 0; strcmp(sweep->name, "largest map") != 0; i++)
		sweep = stress_sweep_at(i);
	assert_true(limit >= 2048); /* of OpenGL ES 3.0 */
	probe.max_texture_size = 40;
	bool run =
		stress_sweep_run(sweep, &probe, "hard", STRESS_FULL, &listener, &outcome, &error);
	probe.max_texture_size = limit;
	assert_true(run);
	assert_int_equal(outcome.failures, 0);
	assert_true(outcome.value == 40);
}

static void bits_of_floats_are_read_as_floats_are(void **state)
{
	static const struct {
		const char *pass;
		GLuint bits[4];
		bool finite;
	} cases[] = {
		{"smoothies", {0, 0x3f800000, 0, 0}, true},
		/* the largest, and the least */
		{"smoothies", {0x7bfffbff, 0xff7fffff, 0x00000001, 0}, true},
		{"smoothies", {0x00007c00, 0, 0, 0}, false},
		{"smoothies", {0xfe000000, 0, 0, 0}, false},
		{"smoothies", {0, 0x7f800000, 0, 0}, false},
		{"smoothies", {0, 0, 0xffc00000, 0}, false},
		{"layers", {0x3f7fffff, 0x7bfffbff, 0, 0}, true},
		{"layers", {0xff800000, 0, 0, 0}, false},
		{"layers", {0, 0x00007c00, 0, 0}, false},
		{"silhouettes", {0xff800000, 0x7c007c00, 0, 0}, true},
	};
	GLuint framebuffer, texture;
	(void)state;
	glGenFramebuffers(1, &framebuffer);
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32UI, 4, 4);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
	glViewport(0, 0, 4, 4);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct stress_fault fault = {0};
		glClearBufferuiv(GL_COLOR, 0, cases[i].bits);
		bool finite = stress_probe_check_targets(&probe, cases[i].pass, &fault);
		assert_int_equal(finite, cases[i].finite);
		assert_true(finite || fault.kind == STRESS_FAULT_FLOAT);
	}
	glDeleteFramebuffers(1, &framebuffer);
	glDeleteTextures(1, &texture);
}

/* And no fault of drawing, so that shrinking does not turn the one into the other. */
static void what_cannot_be_drawn_is_told_as_such(void **state)
{
	struct stress_scene scene;
	struct stress_fault fault;
	(void)state;
	assert_true(stress_base_init(&scene, SM_LIGHT_SPOT, NULL));
	scene.lights[0].radius = -1;
	assert_false(stress_check_scene(&probe, &scene, NULL, &fault));
	assert_int_equal(fault.kind, STRESS_FAULT_INVALID);
	scene.lights[0].radius = 1;
	assert_true(stress_check_scene(&probe, &scene, NULL, &fault));
	scene.camera.fov = 0;
	assert_false(stress_check_scene(&probe, &scene, NULL, &fault));
	assert_int_equal(fault.kind, STRESS_FAULT_INVALID);
	stress_scene_finish(&scene);
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
#define OTHERS 7

int main(void)
{
	struct CMUnitTest tests[SWEEPS_MAX + OTHERS] = {
		cmocka_unit_test(random_scenes_break_no_rule),
		cmocka_unit_test(a_seed_and_a_number_name_a_scene),
		cmocka_unit_test(what_breaks_a_rule_is_shrunk),
		cmocka_unit_test(a_written_scene_looks_the_same),
		cmocka_unit_test(maps_are_no_larger_than_the_driver_has),
		cmocka_unit_test(bits_of_floats_are_read_as_floats_are),
		cmocka_unit_test(what_cannot_be_drawn_is_told_as_such),
	};
	size_t count = OTHERS;
	const struct stress_sweep *sweep;
	for (size_t i = 0; (sweep = stress_sweep_at(i)) != NULL && i < SWEEPS_MAX; i++)
		tests[count++] = (struct CMUnitTest){.name = sweep->name,
			.test_func = sweep_keeps_its_bounds,
			.initial_state = (void *)sweep};
	return _cmocka_run_group_tests("stress", tests, count, open_probe, close_probe);
}
