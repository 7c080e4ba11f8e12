/* SPDX-License-Identifier: MIT */
/* The papers' tables from end to end, in little. */
#include "app/bench_paper_part.h"
#include "base/log.h"
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char *argv[] = {(char *)"bench", (char *)"--paper", NULL};

/* How far the run said it was. */
struct watch {
	uint32_t done, total;
	uint32_t end; /* of the device, in steps; 0: it stays */
	char device[16];
};

static void watch(void *data, uint32_t done, uint32_t total)
{
	struct watch *watch = data;
	assert_true(done >= watch->done && done <= total);
	watch->done = done;
	watch->total = total;
	if (watch->end != 0 && done >= watch->end)
		strcpy(watch->device, "/dev/gone");
}

static struct paper_options tiny_options(const char *folder, struct watch *progress)
{
	*progress = (struct watch){.device = "surfaceless"};
	return (struct paper_options){
		.out = folder,
		.device = progress->device,
		.tiny = true,
		.argc = 2,
		.argv = argv,
		.progress = watch,
		.progress_data = progress,
	};
}

static int make_folder(void **state)
{
	char *path = strdup("/tmp/smoothie-paper-XXXXXX");
	*state = path;
	return path != NULL && mkdtemp(path) != NULL ? 0 : -1;
}

static int remove_folder(void **state)
{
	char *folder = *state, path[512];
	DIR *entries = opendir(folder);
	const struct dirent *entry;
	while (entries != NULL && (entry = readdir(entries)) != NULL) {
		snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
		if (entry->d_name[0] != '.')
			unlink(path);
	}
	if (entries != NULL)
		closedir(entries);
	int removed = rmdir(folder);
	free(folder);
	return removed;
}

/* The folder's file, owned; fails the test where it is not there. */
static char *read_file(const char *folder, const char *name)
{
	char path[512];
	snprintf(path, sizeof(path), "%s/%s", folder, name);
	FILE *file = fopen(path, "r");
	if (file == NULL)
		fail_msg("there is no %s", path);
	char *text = calloc(1, 1 << 20);
	assert_non_null(text);
	assert_true(fread(text, 1, (1 << 20) - 1, file) > 0);
	fclose(file);
	return text;
}

/* The value of the one line of a CSV that starts so; fails the test where it is no number. */
static double value_of(const char *csv, const char *start)
{
	const char *line = strstr(csv, start);
	double value = 0;
	if (line == NULL || sscanf(line + strlen(start), "%lf", &value) != 1)
		fail_msg("no line starts with %s", start);
	return value;
}

static void check_numbers(const char *csv)
{
	static const char scene[] = "scenes,\"generated knot, 5.7k\",";
	static const char *const times[] = {"hard,256,,frame,", "smoothie,1024,,frame,",
		"smoothie,512,0.02,frame,", "smoothie,512,0.2,frame,"};
	char start[200];
	snprintf(start, sizeof(start), "%s,,,triangles,", scene);
	double triangles = value_of(csv, start);
	assert_true(triangles > 5700 * .98 && triangles < 5700 * 1.02);
	for (size_t i = 0; i < sizeof(times) / sizeof(times[0]); i++) {
		snprintf(start, sizeof(start), "%s%s", scene, times[i]);
		assert_true(value_of(csv, start) > 0);
	}
	snprintf(start, sizeof(start), "%ssmoothie,,,popping,", scene);
	assert_true(value_of(csv, start) > 0);
	if (strstr(csv, "errors,") != NULL) { /* the build has a reference */
		double fixed12 = value_of(csv,
			"errors,\"study scenes\",smoothie in fixed12,,,difference from floats,");
		assert_true(fixed12 > 0 && fixed12 < .01);
	}
	assert_true(value_of(csv, "maps,\"urchin\",smoothie,512,,buffers,") > 0);
	assert_true(value_of(csv, "edges,\"debris of 1998 edges\",smoothie,,,silhouettes,") > 0);
	assert_true(
		value_of(csv, "snapping,\"knot of few triangles\",smoothie,,0.1,largest change,") >=
		1);
}

static void a_run_writes_tables_and_plots(void **state)
{
	const char *folder = *state;
	struct watch progress;
	struct sm_error error;
	struct paper_options options = tiny_options(folder, &progress);
	if (!paper_run(&options, &error))
		fail_msg("%s", error.text);
	/* Of what ends between two looks, it hears no more. */
	assert_true(progress.total > 0 && progress.done > progress.total / 2);
	char *csv = read_file(folder, "paper.csv"), *markdown = read_file(folder, "paper.md");
	check_numbers(csv);
	assert_non_null(strstr(markdown, "## Claims"));
	assert_non_null(strstr(markdown, "| generated knot, 5.7k |"));
	assert_non_null(strstr(markdown, "- command: smoothie bench --paper\n"));
	assert_non_null(strstr(markdown, "- system: Linux "));
	free(csv);
	free(markdown);
	if (system("command -v gnuplot >/dev/null") == 0) {
		char *svg = read_file(folder, "paper-edges.svg");
		assert_non_null(strstr(svg, "</svg>"));
		free(svg);
		char *png = read_file(folder, "paper-maps.png");
		assert_memory_equal(png, "\x89PNG", 4);
		free(png);
	}
}

static void what_came_before_a_failure_is_kept(void **state)
{
	const char *folder = *state;
	struct watch progress;
	struct sm_error error;
	struct paper_options options = tiny_options(folder, &progress);
	progress.end = paper_time_scene_steps(&options) + 1;
	assert_false(paper_run(&options, &error));
	assert_non_null(strstr(error.text, "/dev/gone"));
	char *csv = read_file(folder, "paper.csv"), *markdown = read_file(folder, "paper.md");
	assert_true(value_of(csv, "scenes,\"generated knot, 5.7k\",hard,256,,frame,") > 0);
	assert_null(strstr(csv, "snapping,"));
	assert_non_null(strstr(markdown, "OpenGL ES"));
	free(csv);
	free(markdown);
}

static char warning[300];

static void keep_warning(void *data, enum sm_log_level level, const char *line)
{
	(void)data;
	assert_int_equal(level, SM_LOG_WARNING);
	snprintf(warning, sizeof(warning), "%s", line);
}

static void a_model_that_is_missing_is_told(void **state)
{
	struct watch progress;
	struct sm_error error;
	struct paper_options options = tiny_options(*state, &progress);
	options.models = "/nowhere";
	options.device = "/dev/gone";
	log_set_sink(keep_warning, NULL);
	assert_false(paper_run(&options, &error));
	log_set_sink(NULL, NULL);
	assert_string_equal(
		warning, "/nowhere/spot.glb is not there: generated knot, 5.7k stands for it");
}

static void a_folder_that_cannot_be_is_refused_at_once(void **state)
{
	struct watch progress;
	struct paper_options options = tiny_options("/dev/null/folder", &progress);
	struct sm_error error;
	(void)state;
	assert_false(paper_run(&options, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_int_equal(progress.done, 0);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
	const struct CMUnitTest tests[] = {
		IN_FOLDER(a_run_writes_tables_and_plots),
		IN_FOLDER(what_came_before_a_failure_is_kept),
		IN_FOLDER(a_model_that_is_missing_is_told),
		cmocka_unit_test(a_folder_that_cannot_be_is_refused_at_once),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
