/* SPDX-License-Identifier: MIT */
#include "folder.h"
#include "load/stage.h"
#include <ftw.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#define PACKAGED "/usr/share/assimp/models"

static double seconds(void)
{
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool is_one_line(const struct sm_error *error)
{
	return error->status != SM_OK && strpbrk(error->text, "\n\r") == NULL;
}

/* Whatever an animation holds, it shows finite places, or ends in one line. */
static void play(const char *path, struct stage *stage)
{
	static const double times[] = {0.3, 1.7, 1e6, -2, 0};
	for (size_t i = 0; i < sizeof(times) / sizeof(*times); i++) {
		struct sm_error error = {0};
		float min[3], max[3];
		if (!stage_set_time(stage, times[i], &error) && !is_one_line(&error))
			fail_msg("%s at %g s: not a clear error: %s", path, times[i], error.text);
		assert_true(sm_scene_get_bounds(stage->scene, false, min, max));
		for (int axis = 0; axis < 3; axis++)
			if (!(max[axis] - min[axis] < INFINITY))
				fail_msg("%s at %g s: no bounds", path, times[i]);
	}
}

static struct {
	size_t files, stages, moving;
} walked;

/* Whether a file makes a stage. It must make one or give one clear line, in 10 s. */
static bool try_file(const char *path)
{
	struct stage stage;
	struct sm_error error = {0};
	double start = seconds();
	bool ok = stage_load(&stage, path, NULL, 0, &error);
	double spent = seconds() - start;
	if (spent > 10)
		fail_msg("%s took %.1f s", path, spent);
	if (ok && (sm_scene_object_count(stage.scene) == 0 || stage.output.width == 0))
		fail_msg("%s: an empty stage", path);
	if (!ok && (strncmp(error.text, path, strlen(path)) != 0 || !is_one_line(&error)))
		fail_msg("%s: not a clear error: %s", path, error.text);
	if (ok) {
		walked.moving += stage_moves(&stage);
		play(path, &stage);
	}
	stage_finish(&stage);
	return ok;
}

static int try_entry(const char *path, const struct stat *status, int type)
{
	(void)status;
	if (type == FTW_F) {
		walked.files++;
		walked.stages += try_file(path);
	}
	return 0;
}

static void every_packaged_file_ends_well(void **state)
{
	static const char *const folders[] = {
		PACKAGED, "/usr/share/glmark2/models", SMOOTHIE_SHARED "/models"};
	(void)state;
	for (size_t i = 0; i < sizeof(folders) / sizeof(*folders); i++) {
		memset(&walked, 0, sizeof(walked));
		ftw(folders[i], try_entry, 8);
		print_message("%s: %zu files, %zu stages, of which %zu move\n", folders[i],
			walked.files, walked.stages, walked.moving);
		/* Textures and notes lie among the models. */
		if (walked.files > 0)
			assert_true(walked.stages > walked.files / 3);
	}
}

static bool exists(const char *path)
{
	FILE *file = fopen(path, "rb");
	if (file != NULL)
		fclose(file);
	return file != NULL;
}

static void known_files_end_as_they_should(void **state)
{
	static const struct {
		const char *path;
		bool is_good;
	} cases[] = {
		{PACKAGED "/glTF2/BoxTextured-glTF/BoxTextured.gltf", true},
		{PACKAGED "/glTF2/IndexOutOfRange/IndexOutOfRange.gltf", true},
		{PACKAGED "/glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf", false},
		{PACKAGED "/glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", false},
		{PACKAGED "/glTF2/MissingBin/BoxTextured.gltf", false},
		{PACKAGED "/glTF2/RecursiveNodes/RecursiveNodes.gltf", false},
		{PACKAGED "/glTF2/SchemaFailures/sceneWrongType.gltf", false},
		{PACKAGED "/glTF2/wrongTypes/badArray.gltf", false},
		{PACKAGED "/glTF2/wrongTypes/badUint.gltf", false},
		{PACKAGED "/invalid/OutOfMemory.off", false},
		{PACKAGED "/invalid/malformed.obj", false},
		{PACKAGED "/invalid/empty.ply", false},
		{PACKAGED "/OBJ/box.obj", true},
		{PACKAGED "/OBJ/point_cloud.obj", false},
		{PACKAGED "/OpenGEX/camera.ogex", true},
		{PACKAGED "/RAW/WithColor.raw", false}, /* assimp 5.2 crashes */
		{"/usr/share/glmark2/models/horse.3ds", true},
		{"/usr/share/glmark2/models/bunny.obj", true},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++)
		if (exists(cases[i].path) && try_file(cases[i].path) != cases[i].is_good)
			fail_msg("%s ends otherwise", cases[i].path);
}

static void corners_near_infinity_are_refused(void **state)
{
	struct stage stage;
	struct sm_error error;
	(void)state;
	const char *path = folder_write_text("far.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n");
	assert_false(stage_load(&stage, path, NULL, 0, &error));
	assert_non_null(strstr(error.text, "a corner is farther than 1e15 from the origin"));
	stage_finish(&stage);
}

static uint32_t next_random(uint32_t *state)
{
	*state ^= *state << 13;
	*state ^= *state >> 17;
	*state ^= *state << 5;
	return *state;
}

static uint32_t seed(void)
{
	const char *given = getenv("SMOOTHIE_TEST_SEED");
	uint32_t value = given != NULL ? (uint32_t)strtoul(given, NULL, 0) : (uint32_t)time(NULL);
	print_message("SMOOTHIE_TEST_SEED=%u\n", value);
	return value | 1; /* 0 is no seed for xorshift */
}

/* Cuts a file short or flips some of its bits. */
static size_t damage(uint8_t *bytes, size_t size, uint32_t *random)
{
	if (next_random(random) % 3 == 0)
		return next_random(random) % size;
	for (uint32_t flips = 1 + next_random(random) % 8; flips > 0; flips--)
		bytes[next_random(random) % size] ^= (uint8_t)(1 << next_random(random) % 8);
	return size;
}

static void damaged_files_end_well(void **state)
{
	enum { MAX_SIZE = 1 << 18, TRIES = 15 };
	static const char *const names[] = {"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
		"glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", "OBJ/box.obj",
		"PLY/cube_binary.ply", "STL/Spider_binary.stl", "3DS/test1.3ds", "OFF/Cube.off",
		"X/test_cube_binary.x", "Collada/duck.zae"};
	uint8_t *bytes = malloc(MAX_SIZE), *copy = malloc(MAX_SIZE);
	uint32_t random = seed();
	(void)state;
	assert_true(bytes != NULL && copy != NULL);
	for (size_t i = 0; i < sizeof(names) / sizeof(*names); i++) {
		char path[300], name[100];
		snprintf(path, sizeof(path), PACKAGED "/%s", names[i]);
		FILE *file = fopen(path, "rb");
		if (file == NULL)
			continue;
		size_t size = fread(bytes, 1, MAX_SIZE, file);
		fclose(file);
		for (int k = 0; k < TRIES; k++) {
			memcpy(copy, bytes, size);
			size_t left = damage(copy, size, &random);
			snprintf(name, sizeof(name), "%d%s", k, strrchr(path, '.'));
			try_file(folder_write(name, copy, left));
		}
	}
	free(bytes);
	free(copy);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_packaged_file_ends_well),
		cmocka_unit_test(known_files_end_as_they_should),
		cmocka_unit_test(corners_near_infinity_are_refused),
		cmocka_unit_test(damaged_files_end_well),
	};
	return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
