/* SPDX-License-Identifier: MIT */
/* Finished references are kept, and told apart by what they are of. */
#include "edge.h"
#include "scene/scene.h"
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#define BYTES (EDGE_WIDTH * EDGE_HEIGHT * sizeof(float))

static char folder[64];

static void count_call(void *data, double share)
{
	(void)share;
	++*(uint32_t *)data;
}

/* Whether it had to be traced. */
static bool is_traced(struct reference *reference, struct edge *edge)
{
	uint32_t calls = 0;
	edge->request.cache = folder;
	edge->request.progress = count_call;
	edge->request.progress_data = &calls;
	edge_trace(reference, edge);
	return calls > 0;
}

static int folder_init(void **state)
{
	(void)state;
	strcpy(folder, "/tmp/smoothie-reference-XXXXXX");
	return mkdtemp(folder) != NULL ? 0 : -1;
}

/* Calls `each` (may be NULL) for the path of all that is in the folder; the number of files. */
static uint32_t list(void (*each)(const char *path))
{
	uint32_t count = 0;
	DIR *listing = opendir(folder);
	assert_non_null(listing);
	for (struct dirent *entry; (entry = readdir(listing)) != NULL;) {
		char path[400];
		if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
			continue;
		snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
		if (each != NULL)
			each(path);
		count++;
	}
	closedir(listing);
	return count;
}

static void remove_file(const char *path)
{
	assert_int_equal(unlink(path), 0);
}

static int folder_finish(void **state)
{
	(void)state;
	list(remove_file);
	return rmdir(folder);
}

static void a_finished_reference_is_not_traced_again(void **state)
{
	(void)state;
	struct edge edge;
	struct reference first, second;
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	assert_true(is_traced(&first, &edge));
	assert_int_equal(list(NULL), 1);
	edge.request.threads = 3;
	edge.request.samples = 1000; /* rounded up to what it was */
	assert_false(is_traced(&second, &edge));
	assert_true(second.width == EDGE_WIDTH && second.height == EDGE_HEIGHT);
	assert_memory_equal(first.visibility, second.visibility, BYTES);
	reference_finish(&second);
	reference_finish(&first);
	edge_finish(&edge);
}

/* What a process leaves that is killed while it writes. */
static void make_partial(const char *path)
{
	char part[400];
	assert_int_equal(truncate(path, 100000), 0);
	snprintf(part, sizeof(part), "%.*s.part", (int)(strrchr(path, '.') - path), path);
	assert_int_equal(rename(path, part), 0);
}

static void what_was_left_half_written_is_written_over(void **state)
{
	(void)state;
	struct edge edge;
	struct reference reference;
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	is_traced(&reference, &edge);
	reference_finish(&reference);
	list(make_partial);
	for (int again = 0; again < 2; again++) {
		assert_true(is_traced(&reference, &edge) == (again == 0));
		reference_finish(&reference);
		assert_int_equal(list(NULL), 1);
	}
	edge_finish(&edge);
}

static void assert_readable_by_all(const char *path)
{
	struct stat found;
	assert_int_equal(stat(path, &found), 0);
	assert_int_equal(found.st_mode & 0777, 0644);
}

static void the_umask_says_who_may_read(void **state)
{
	(void)state;
	struct edge edge;
	struct reference reference;
	mode_t before = umask(022);
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	is_traced(&reference, &edge);
	umask(before);
	assert_int_equal(list(assert_readable_by_all), 1);
	reference_finish(&reference);
	edge_finish(&edge);
}

static void flip(const char *path, long where)
{
	FILE *file = fopen(path, "r+b");
	assert_non_null(file);
	assert_int_equal(fseek(file, where, where < 0 ? SEEK_END : SEEK_SET), 0);
	int byte = fgetc(file);
	assert_int_equal(fseek(file, -1, SEEK_CUR), 0);
	assert_int_equal(fputc(byte ^ 1, file), byte ^ 1);
	assert_int_equal(fclose(file), 0);
}

static void flip_first(const char *path)
{
	flip(path, 0);
}

static void flip_last(const char *path)
{
	flip(path, -1);
}

static void flip_inside(const char *path)
{
	flip(path, 3000);
}

static void cut(const char *path)
{
	assert_int_equal(truncate(path, 5000), 0);
}

static void empty(const char *path)
{
	assert_int_equal(truncate(path, 0), 0);
}

static void lengthen(const char *path)
{
	FILE *file = fopen(path, "ab");
	assert_int_equal(fputc(0, file), 0);
	assert_int_equal(fclose(file), 0);
}

static void a_damaged_file_is_replaced(void **state)
{
	(void)state;
	static void (*const damages[])(const char *path) = {
		flip_first, flip_inside, flip_last, cut, empty, lengthen};
	struct edge edge;
	struct reference first, second;
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	is_traced(&first, &edge);
	for (size_t i = 0; i < sizeof(damages) / sizeof(damages[0]); i++) {
		list(damages[i]);
		for (int again = 0; again < 2; again++) {
			assert_true(is_traced(&second, &edge) == (again == 0));
			assert_memory_equal(first.visibility, second.visibility, BYTES);
			reference_finish(&second);
		}
		assert_int_equal(list(NULL), 1);
	}
	reference_finish(&first);
	edge_finish(&edge);
}

static void change_light(struct edge *edge)
{
	edge->scene->lights[0].desc.radius *= 1.0001f;
}

static void change_light_place(struct edge *edge)
{
	edge->scene->lights[0].desc.position[2] += 1e-5f;
}

static void change_camera(struct edge *edge)
{
	edge->request.camera.fov *= 1.0001f;
}

static void change_samples(struct edge *edge)
{
	edge->request.samples = 1025;
}

static void change_size(struct edge *edge)
{
	edge->request.height++;
}

static void change_transform(struct edge *edge)
{
	edge->scene->objects[edge->plate].transform[3][1] += 1e-5f;
}

static void change_casting(struct edge *edge)
{
	edge->scene->objects[edge->plate].casts = false;
}

static void change_receiving(struct edge *edge)
{
	edge->scene->objects[edge->plate].receives = false;
}

static void change_sides(struct edge *edge)
{
	edge->scene->objects[edge->plate].single_sided = true;
}

static void change_vertex(struct edge *edge)
{
	edge->scene->meshes[0].positions[0][0] += 1e-5f;
}

static void whatever_counts_makes_another_reference(void **state)
{
	(void)state;
	static void (*const changes[])(struct edge * edge) = {change_light, change_light_place,
		change_camera, change_samples, change_size, change_transform, change_casting,
		change_receiving, change_sides, change_vertex};
	for (size_t i = 0; i < sizeof(changes) / sizeof(changes[0]); i++) {
		struct edge edge;
		struct reference reference;
		edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
		is_traced(&reference, &edge);
		reference_finish(&reference);
		changes[i](&edge);
		if (!is_traced(&reference, &edge))
			fail_msg("change %zu makes no difference", i);
		reference_finish(&reference);
		edge_finish(&edge);
	}
}

static void a_folder_that_cannot_be_is_no_failure(void **state)
{
	(void)state;
	struct edge edge;
	struct reference reference;
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	edge.request.cache = "/dev/null/references";
	edge_trace(&reference, &edge);
	reference_finish(&reference);
	edge_finish(&edge);
}

static void a_full_disk_keeps_nothing(void **state)
{
	(void)state;
	struct edge edge;
	struct reference reference;
	struct rlimit before, full;
	void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
	assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
	full = before;
	full.rlim_cur = 6000;
	edge_init(&edge, SM_LIGHT_SPOT, 0.5f, 1, 0);
	assert_int_equal(setrlimit(RLIMIT_FSIZE, &full), 0);
	bool traced = is_traced(&reference, &edge);
	assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
	signal(SIGXFSZ, handler);
	assert_true(traced);
	assert_int_equal(list(NULL), 0);
	reference_finish(&reference);
	edge_finish(&edge);
}

#define archive_test(test) cmocka_unit_test_setup_teardown(test, folder_init, folder_finish)

int main(void)
{
	const struct CMUnitTest tests[] = {
		archive_test(a_finished_reference_is_not_traced_again),
		archive_test(what_was_left_half_written_is_written_over),
		archive_test(the_umask_says_who_may_read),
		archive_test(a_damaged_file_is_replaced),
		archive_test(whatever_counts_makes_another_reference),
		archive_test(a_folder_that_cannot_be_is_no_failure),
		archive_test(a_full_disk_keeps_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
