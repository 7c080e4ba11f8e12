/* SPDX-License-Identifier: MIT */
/* Compiled programs in a folder: which one, and what is done to it. */
#define _GNU_SOURCE /* nftw() */
#include "app/program_store.h"
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define NAME "0123456789abcdef0123456789abcdef"
#define FILE_OF_NAME NAME ".program"

static void set(const char *variable, const char *value)
{
	assert_int_equal(value != NULL ? setenv(variable, value, 1) : unsetenv(variable), 0);
}

static int remove_entry(const char *path, const struct stat *file, int type, struct FTW *place)
{
	(void)file, (void)type;
	return place->level > 0 ? remove(path) : 0;
}

static int empty_and_leave_scratch(void **state)
{
	assert_int_equal(nftw(".", remove_entry, 8, FTW_DEPTH | FTW_PHYS), 0);
	return leave_scratch(state);
}

static const char *const variables[] = {
	"SMOOTHIE_CACHE_DIR", "STATE_DIRECTORY", "XDG_CACHE_HOME", "HOME"};
#define VARIABLE_COUNT 4

static void assert_folder(const struct program_store *store, const char *path)
{
	struct stat folder;
	if (path == NULL) {
		assert_null(store->folder);
		assert_true(store->calls.load == NULL && store->calls.save == NULL);
		return;
	}
	assert_non_null(store->folder);
	assert_string_equal(store->folder, path);
	assert_int_equal(stat(path, &folder), 0);
	assert_int_equal(folder.st_mode, S_IFDIR | 0700);
}

/* "/a" below the working folder; the rest as it is. To be freed. */
static char *below(const char *here, const char *path)
{
	char *whole;
	if (path == NULL)
		return NULL;
	assert_true(asprintf(&whole, "%s%s", path[0] == '/' ? here : "", path) >= 0);
	return whole;
}

static void the_folder_is_the_first_that_can_be_had(void **state)
{
	/* The variables, and the folder. NULL: unset, none. */
	static const struct {
		const char *values[VARIABLE_COUNT], *folder;
	} cases[] = {
		{{"/own/deep", "/s", "/c", "/h"}, "/own/deep"},
		{{"own", "/s", "/c", "/h"}, "own"},
		{{"", "/s", "/c", "/h"}, NULL},
		{{"/file/x", "/s", "/c", "/h"}, NULL},
		{{NULL, "/s", "/c", "/h"}, "/s/programs"},
		{{NULL, "/s:/other", "/c", "/h"}, "/s/programs"},
		{{NULL, NULL, "/c", "/h"}, "/c/smoothie/programs"},
		{{NULL, "/file", "/c", "/h"}, "/c/smoothie/programs"},
		{{NULL, "", "", "/h"}, "/h/.cache/smoothie/programs"},
		{{NULL, NULL, "relative", "/h"}, "/h/.cache/smoothie/programs"},
		{{NULL, NULL, NULL, "/file"}, NULL},
		{{NULL, NULL, NULL, NULL}, NULL},
	};
	char *before[VARIABLE_COUNT];
	for (size_t j = 0; j < VARIABLE_COUNT; j++)
		before[j] = getenv(variables[j]) != NULL ? strdup(getenv(variables[j])) : NULL;
	write_text("file", "");
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		for (size_t j = 0; j < VARIABLE_COUNT; j++) {
			char *value = below(*state, cases[i].values[j]);
			set(variables[j], value);
			free(value);
		}
		struct program_store store;
		char *folder = below(*state, cases[i].folder);
		program_store_init(&store);
		assert_folder(&store, folder);
		program_store_finish(&store);
		free(folder);
	}
	for (size_t j = 0; j < VARIABLE_COUNT; j++) {
		set(variables[j], before[j]);
		free(before[j]);
	}
}

static void open_here(struct program_store *store)
{
	set("SMOOTHIE_CACHE_DIR", ".");
	program_store_init(store);
	assert_non_null(store->folder);
}

static void save(struct program_store *store, const void *bytes, size_t size)
{
	store->calls.save(store, NAME, bytes, size);
}

static size_t load(struct program_store *store, void *bytes, size_t capacity)
{
	return store->calls.load(store, NAME, bytes, capacity);
}

static void what_is_saved_is_loaded(void **state)
{
	(void)state;
	struct program_store store;
	char bytes[8] = "unread";
	struct stat file;
	open_here(&store);
	assert_int_equal(load(&store, NULL, 0), 0);
	save(&store, "first one", 9);
	save(&store, "second", 6);
	assert_int_equal(load(&store, NULL, 0), 6);
	assert_int_equal(load(&store, bytes, 5), 6);
	assert_string_equal(bytes, "unread");
	assert_int_equal(load(&store, bytes, sizeof(bytes)), 6);
	assert_string_equal(bytes, "second");
	assert_int_equal(stat(FILE_OF_NAME, &file), 0);
	assert_int_equal(file.st_mode, S_IFREG | 0600);
	assert_int_equal(count_entries(""), 1);
	program_store_finish(&store);
}

static void files_of_others_are_not_loaded(void **state)
{
	(void)state;
	struct program_store store;
	open_here(&store);
	save(&store, "bytes", 5);
	assert_int_equal(chmod(FILE_OF_NAME, 0602), 0);
	assert_int_equal(load(&store, NULL, 0), 0);
	assert_int_equal(chmod(FILE_OF_NAME, 0620), 0);
	assert_int_equal(load(&store, NULL, 0), 0);
	assert_int_equal(chmod(FILE_OF_NAME, 0644), 0);
	assert_int_equal(load(&store, NULL, 0), 5);

	assert_int_equal(rename(FILE_OF_NAME, "elsewhere"), 0);
	assert_int_equal(symlink("elsewhere", FILE_OF_NAME), 0);
	assert_int_equal(load(&store, NULL, 0), 0);
	assert_int_equal(unlink(FILE_OF_NAME), 0);
	assert_int_equal(mkfifo(FILE_OF_NAME, 0600), 0);
	assert_int_equal(load(&store, NULL, 0), 0);
	program_store_finish(&store);
}

static void large_entries_are_not_kept(void **state)
{
	(void)state;
	enum { MOST = 4 << 20 };
	struct program_store store;
	char *bytes = calloc(1, MOST + 1);
	open_here(&store);
	assert_non_null(bytes);
	save(&store, bytes, MOST + 1);
	assert_int_equal(count_entries(""), 0);
	save(&store, bytes, MOST);
	assert_int_equal(load(&store, NULL, 0), MOST);
	assert_int_equal(truncate(FILE_OF_NAME, MOST + 1), 0);
	assert_int_equal(load(&store, NULL, 0), 0);
	free(bytes);
	program_store_finish(&store);
}

static void the_oldest_go_when_there_are_too_many(void **state)
{
	(void)state;
	for (int i = 0; i < 230; i++) {
		char name[40];
		snprintf(name, sizeof(name), i % 50 == 0 ? ".smoothie-%d" : "%d.program", i);
		write_text(name, "");
		/* The higher the number, the older. */
		const struct timespec times[2] = {{1000 - i, 0}, {1000 - i, 0}};
		assert_int_equal(utimensat(AT_FDCWD, name, times, 0), 0);
	}
	write_text("other", "");
	struct program_store store;
	open_here(&store);
	program_store_finish(&store);
	assert_int_equal(count_entries(""), 200 + 1);
	assert_int_equal(count_entries("other"), 1);
	assert_int_equal(count_entries("199.program"), 1);
	assert_int_equal(count_entries(".smoothie-200"), 0);
	assert_int_equal(count_entries("201.program"), 0);
}

/* A failure to save is no failure; the program itself is tested below. */
static void a_folder_that_goes_away_is_no_error(void **state)
{
	(void)state;
	struct program_store store;
	set("SMOOTHIE_CACHE_DIR", "folder");
	program_store_init(&store);
	assert_int_equal(rmdir("folder"), 0);
	save(&store, "bytes", 5);
	assert_int_equal(load(&store, NULL, 0), 0);
	program_store_finish(&store);
	program_store_finish(&store);
}

/* Renders, and returns what --stats says of `key`. */
static int render(const char *environment, const char *output, const char *key)
{
	struct outcome outcome =
		run_program(&(struct run){.arguments = {"render", "builtin:boxes", "--size",
						  "32x24", "--stats", "-o", output},
			.environment = environment});
	assert_output(&outcome, &key, 1);
	int value = atoi(strstr(outcome.out, key) + strlen(key));
	outcome_finish(&outcome);
	return value;
}

static void assert_same_file(const char *a, const char *b)
{
	char bytes[2][20000];
	size_t sizes[2];
	const char *const names[2] = {a, b};
	for (int i = 0; i < 2; i++) {
		FILE *file = fopen(names[i], "r");
		assert_non_null(file);
		sizes[i] = fread(bytes[i], 1, sizeof(bytes[i]), file);
		fclose(file);
	}
	assert_true(sizes[0] > 0 && sizes[0] < sizeof(bytes[0]));
	assert_int_equal(sizes[0], sizes[1]);
	assert_memory_equal(bytes[0], bytes[1], sizes[0]);
}

static const char compiled[] = "\nprograms compiled: ", loaded[] = "\nprograms loaded: ";

/* Skips where the driver has no binaries, as Mesa without its own cache. */
static void need_binaries(void)
{
	struct outcome outcome = RUN("info", "--device", "surfaceless");
	assert_int_equal(outcome.status, 0);
	bool kept = strstr(outcome.out, "\ncompiled programs: can be kept\n") != NULL;
	outcome_finish(&outcome);
	if (!kept) {
		print_message("this driver has no program binaries\n");
		skip();
	}
}

static void a_second_run_compiles_nothing(void **state)
{
	(void)state;
	need_binaries();
	int all = render("SMOOTHIE_CACHE_DIR=.", "first.png", compiled);
	assert_true(all > 0);
	assert_int_equal(render("SMOOTHIE_CACHE_DIR=.", "second.png", compiled), 0);
	assert_same_file("first.png", "second.png");
	assert_int_equal(render("SMOOTHIE_CACHE_DIR=.", "third.png", loaded), all);

	DIR *folder = opendir(".");
	for (struct dirent *file; (file = readdir(folder)) != NULL;)
		if (strstr(file->d_name, ".program") != NULL)
			write_text(file->d_name, "damaged");
	closedir(folder);
	assert_int_equal(render("SMOOTHIE_CACHE_DIR=.", "second.png", compiled), all);
	assert_same_file("first.png", "second.png");
	assert_int_equal(render("SMOOTHIE_CACHE_DIR=.", "second.png", compiled), 0);
	assert_int_equal(render("SMOOTHIE_CACHE_DIR=", "second.png", compiled), all);
}

static void without_a_folder_that_serves_it_renders_too(void **state)
{
	(void)state;
	static const char *const cases[] = {
		"SMOOTHIE_CACHE_DIR=/proc/missing/folder", /* cannot be made */
		"SMOOTHIE_CACHE_DIR=/proc/self",           /* cannot be written, by root either */
		"SMOOTHIE_CACHE_DIR=/dev/null",
	};
	int all = render("SMOOTHIE_CACHE_DIR=", "none.png", compiled);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		assert_int_equal(render(cases[i], "some.png", compiled), all);
		assert_same_file("none.png", "some.png");
	}
}

#define scratch_test(test) \
	cmocka_unit_test_setup_teardown(test, enter_scratch, empty_and_leave_scratch)

int main(void)
{
	const struct CMUnitTest tests[] = {
		scratch_test(the_folder_is_the_first_that_can_be_had),
		scratch_test(what_is_saved_is_loaded),
		scratch_test(files_of_others_are_not_loaded),
		scratch_test(large_entries_are_not_kept),
		scratch_test(the_oldest_go_when_there_are_too_many),
		scratch_test(a_folder_that_goes_away_is_no_error),
		scratch_test(a_second_run_compiles_nothing),
		scratch_test(without_a_folder_that_serves_it_renders_too),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
