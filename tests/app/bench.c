/* SPDX-License-Identifier: MIT */
/* What `smoothie bench` measures, where it leaves it, and what it leaves when it is stopped. */
#include "bench/csv.h"
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define CYLINDER "--scene=builtin:cylinder"
/* As little as can be measured. */
#define TINY "--size=48x32", "--error-size=64x64", "--rounds=2", "--samples=64", "--map=64"

static struct outcome bench(const char *const *arguments, size_t file_limit)
{
	struct run run = {.arguments = {"bench", CYLINDER, TINY}, .file_limit = file_limit};
	size_t count = 7;
	for (; *arguments != NULL && count < MAX_ARGUMENTS; arguments++)
		run.arguments[count++] = *arguments;
	assert_null(*arguments);
	return run_program(&run);
}
#define BENCH(...) bench((const char *const[]){__VA_ARGS__, NULL}, 0)

static struct result_list read_results(const char *path)
{
	struct result_list results = {0};
	struct sm_error error;
	FILE *file = fopen(path, "r");
	assert_non_null(file);
	if (!csv_read(&results, file, path, &error))
		fail_msg("%s", error.text);
	fclose(file);
	return results;
}

static void assert_success(const struct outcome *outcome)
{
	if (outcome->status != 0)
		fail_msg("status %d and:\n%s", outcome->status, outcome->error);
}

static void remove_folder(const char *path)
{
	char name[PATH_MAX];
	DIR *folder = opendir(path);
	if (folder == NULL)
		return;
	for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
		if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
			continue;
		snprintf(name, sizeof(name), "%s/%s", path, entry->d_name);
		if (remove(name) != 0)
			remove_folder(name);
	}
	closedir(folder);
	rmdir(path);
}

static int leave_bench_scratch(void **state)
{
	remove_folder("bench-results");
	remove_folder("out");
	return leave_scratch(state);
}

static void check_error(const struct error_summary *error)
{
	assert_true(error->pixels > 0);
	assert_true(error->rmse > 0 && error->rmse < 1);
	assert_true(fabs(error->bias) <= error->rmse);
	assert_true(error->p95 <= error->p99 && error->p99 <= error->max && error->max <= 1);
}

static void check_errors(const struct result *result)
{
	const struct error_summary *error = result->error;
	assert_int_equal(error[REGION_ALL].pixels, error[REGION_LIT].pixels +
							   error[REGION_UMBRA].pixels +
							   error[REGION_PENUMBRA].pixels);
	check_error(&error[REGION_ALL]);
	check_error(&error[REGION_PENUMBRA]);
	assert_true(result->outside_wrong >= 0 && result->outside_wrong < 64 * 64);
	assert_true(result->flicker > 0 && result->flicker < .1);
}

static void check_time(const struct time_summary *time)
{
	assert_true(time->p10 > 0 && time->p10 <= time->median && time->median <= time->p90);
	assert_true(time->cpu > 0 && time->ratio > 0);
}

static bool has_pass(const struct result *result, const char *name)
{
	for (size_t i = 0; i < PASSES_MAX && result->passes[i].name[0] != '\0'; i++)
		if (strcmp(result->passes[i].name, name) == 0)
			return result->passes[i].ms > 0;
	return false;
}

static void check_result(const struct result *result, const char *technique)
{
	assert_string_equal(result->scene, "cylinder");
	assert_string_equal(result->technique, technique);
	assert_string_equal(result->precision, "float");
	assert_float_equal(result->radius, .1, 1e-12);
	assert_int_equal(result->map, 64);
	assert_true(result->width == 64 && result->height == 64);
	assert_true(result->time_width == 48 && result->time_height == 32);
	assert_int_equal(result->triangles, 258);
	check_time(&result->time[THREADS_DEFAULT]);
	check_time(&result->time[THREADS_NONE]);
	assert_true(has_pass(result, "shadow map") && has_pass(result, "surfaces"));
	assert_true(result->geometry_bytes > 0);
	assert_non_null(strstr(result->memory, "GL: shadow maps="));
	assert_non_null(strstr(result->memory, ";processor: casters: edges="));
	assert_true(result->target_bytes >= 64 * 64 * 2);
	assert_true(result->peak_bytes > result->target_bytes);
	assert_true(result->machine[0] != '\0');
}

static void check_files(void)
{
	static const char *const names[] = {
		"out/results.csv", "out/results.json", "out/report.html", "out/results.md"};
	static const char *const pictures[] = {"out/differences/cylinder-hard-r0.1-m64-float.png",
		"out/differences/cylinder-smoothie-r0.1-m64-float.png",
		"out/sheets/cylinder-r0.1-m64.png"};
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		if (access(names[i], R_OK) != 0)
			fail_msg("there is no %s", names[i]);
	for (size_t i = 0; i < sizeof(pictures) / sizeof(pictures[0]); i++)
		assert_int_equal(access(pictures[i], R_OK), SMOOTHIE_HAS_REFERENCE ? 0 : -1);
}

static void test_a_run_leaves_a_row_for_each_technique(void **state)
{
	(void)state;
	struct outcome outcome =
		BENCH("--technique=hard", "--technique=smoothie", "--radius=.1", "--out=out");
	assert_success(&outcome);
	struct result_list results = read_results("out/results.csv");
	assert_int_equal(results.count, 2);
	check_result(&results.items[0], "hard");
	check_result(&results.items[1], "smoothie");
	assert_float_equal(results.items[0].time[THREADS_DEFAULT].ratio, 1, 0);
	assert_float_equal(results.items[0].time[THREADS_NONE].ratio, 1, 0);
	if (SMOOTHIE_HAS_REFERENCE) {
		assert_string_equal(outcome.error, "");
		check_errors(&results.items[0]);
		check_errors(&results.items[1]);
	} else {
		assert_non_null(strstr(outcome.error, "no reference (Embree)"));
		assert_int_equal(results.items[0].error[REGION_ALL].pixels, 0);
		assert_true(isnan(results.items[0].flicker));
	}
	assert_non_null(strstr(outcome.out, "penumbra"));
	assert_non_null(
		strstr(outcome.out, "\ncylinder       0.1    64 smoothie             float "));
	check_files();
	result_list_finish(&results);
	outcome_finish(&outcome);
}

static void test_hard_is_timed_unasked(void **state)
{
	(void)state;
	struct outcome outcome = BENCH("--technique=smoothie", "--radius=0", "--quick");
	assert_success(&outcome);
	struct result_list results = read_results("bench-results/results.csv");
	assert_int_equal(results.count, 1);
	assert_string_equal(results.items[0].technique, "smoothie");
	assert_true(results.items[0].time[THREADS_DEFAULT].ratio != 1);
	assert_true(results.items[0].time[THREADS_NONE].median == 0);
	result_list_finish(&results);
	outcome_finish(&outcome);
}

static void test_errors_alone_take_no_times(void **state)
{
	(void)state;
	struct outcome outcome = BENCH("--technique=hard", "--radius=.1", "--errors");
	assert_success(&outcome);
	struct result_list results = read_results("bench-results/results.csv");
	assert_int_equal(results.count, 1);
	if (SMOOTHIE_HAS_REFERENCE)
		check_errors(&results.items[0]);
	for (int threads = 0; threads < THREAD_CHOICES; threads++)
		assert_float_equal(results.items[0].time[threads].median, 0, 0);
	assert_int_equal(results.items[0].peak_bytes, 0);
	result_list_finish(&results);
	outcome_finish(&outcome);
}

static void test_rows_go_through_scenes_radii_and_maps(void **state)
{
	(void)state;
	static const double radii[] = {.01, .01, .2, .2};
	static const uint32_t maps[] = {64, 32, 64, 32};
	struct outcome outcome =
		BENCH("--technique=hard", "--radius=.01", "--radius=.2", "--map=32", "--quick");
	assert_success(&outcome);
	struct result_list results = read_results("bench-results/results.csv");
	assert_int_equal(results.count, 4);
	for (size_t i = 0; i < results.count; i++) {
		assert_float_equal(results.items[i].radius, radii[i], 1e-12);
		assert_int_equal(results.items[i].map, maps[i]);
	}
	result_list_finish(&results);
	outcome_finish(&outcome);
}

static void test_choices_of_samples_are_techniques_of_their_own(void **state)
{
	(void)state;
	static const char *const names[] = {"pcss-32", "hard", "pcss-16"};
	struct outcome outcome = BENCH("--technique=pcss-32", "--technique=hard",
		"--technique=pcss", "--radius=.1", "--quick");
	assert_success(&outcome);
	struct result_list results = read_results("bench-results/results.csv");
	assert_int_equal(results.count, 3);
	for (size_t i = 0; i < results.count; i++) {
		const struct time_summary *time = &results.items[i].time[THREADS_DEFAULT];
		assert_string_equal(results.items[i].technique, names[i]);
		assert_float_equal(time->ratio_pcss,
			time->median / results.items[2].time[THREADS_DEFAULT].median, 1e-12);
	}
	result_list_finish(&results);
	outcome_finish(&outcome);
}

/* The second is in float, and what comes after it the same in others: near to that, and not it. */
static void check_precision_errors(const struct result *results, size_t count)
{
	const struct error_summary *base = &results[1].error[REGION_PENUMBRA];
	for (size_t i = 2; i < count; i++) {
		const struct error_summary *error = &results[i].error[REGION_PENUMBRA];
		assert_float_equal(error->rmse, base->rmse, .01);
		assert_true(error->rmse != base->rmse);
	}
}

static void check_precisions(
	const char *const (*rows)[2], size_t count, const struct outcome *outcome)
{
	assert_success(outcome);
	struct result_list results = read_results("bench-results/results.csv");
	assert_int_equal(results.count, count);
	for (size_t i = 0; i < count; i++) {
		assert_string_equal(results.items[i].technique, rows[i][0]);
		assert_string_equal(results.items[i].precision, rows[i][1]);
	}
	if (SMOOTHIE_HAS_REFERENCE && count > 1)
		check_precision_errors(results.items, count);
	result_list_finish(&results);
}

/* Techniques that were not named are left out where they lack it. */
static void test_precisions_are_rows_of_their_own(void **state)
{
	(void)state;
	static const char *const rows[][2] = {{"hard", "float"}, {"smoothie", "float"},
		{"smoothie", "half"}, {"smoothie", "fixed12"}};
	struct outcome outcome =
		BENCH("--technique=hard", "--technique=smoothie", "--precision=fixed12",
			"--precision=float", "--precision=half", "--radius=.1", "--quick");
	check_precisions(rows, 4, &outcome);
	outcome_finish(&outcome);
	outcome = BENCH("--precision=half", "--radius=.1", "--quick");
	check_precisions(&rows[2], 1, &outcome);
	outcome_finish(&outcome);
}

/* The file that is compared with is the one that the run writes anew. Times may have changed,
 * errors not. */
static void test_a_run_is_compared_with_an_earlier_one(void **state)
{
	(void)state;
	unsigned better, worse, alike, added;
	struct outcome outcome = BENCH("--technique=hard", "--radius=.1", "--quick", "--out=out");
	assert_success(&outcome);
	assert_null(strstr(outcome.out, " alike"));
	outcome_finish(&outcome);
	outcome = BENCH("--technique=hard", "--technique=smoothie", "--radius=.1", "--quick",
		"--out=out", "--compare=out/results.csv");
	assert_success(&outcome);
	const char *added_line =
		strstr(outcome.out, "\nnew     cylinder, smoothie, float, radius 0.1, map 64\n");
	assert_non_null(added_line);
	assert_int_equal(sscanf(strchr(added_line + 1, '\n'),
				 " %u better, %u worse, %u alike, 0 gone, %u new", &better, &worse,
				 &alike, &added),
		4);
	assert_int_equal(better + worse + alike, 1);
	assert_int_equal(added, 1);
	assert_null(strstr(outcome.out, "_rmse"));
	outcome_finish(&outcome);
}

/* Where a disk is full, so that no file can be longer than that. */
static void test_a_full_disk_is_an_error_and_keeps_what_was_there(void **state)
{
	(void)state;
	assert_int_equal(mkdir("out", 0777), 0);
	write_text("out/results.csv", "old");
	struct outcome outcome = bench((const char *const[]){"--technique=hard", "--radius=.1",
					       "--quick", "--out=out", "-q", NULL},
		200);
	assert_failure(&outcome, 1, "cannot write out/");
	char kept[8] = "";
	FILE *file = fopen("out/results.csv", "r");
	assert_int_equal(fread(kept, 1, 7, file), 3);
	fclose(file);
	assert_string_equal(kept, "old");
	outcome_finish(&outcome);
}

static void test_stress_prints_a_line_for_each_sweep(void **state)
{
	(void)state;
	static const char *const lines[] = {"degenerate ", "error at worst ",
		"random scenes     3 of seed 7\n", "random scenes     0 break a rule\n"};
	struct outcome outcome = RUN("bench", "--stress=degenerate", "--quick", "--random=3",
		"--seed=7", "--technique=hard", "--out=out");
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
	outcome = RUN("bench", "--stress=nothing", "--out=out");
	assert_failure(&outcome, 2, "no sweep \"nothing\"");
	outcome_finish(&outcome);
}

/* As in /proc/PID/stat: 'T' stopped, 'Z' ended and not waited for, 'X' gone. */
static char find_state(pid_t pid)
{
	char path[64], state = 'X';
	snprintf(path, sizeof(path), "/proc/%d/stat", (int)pid);
	FILE *file = fopen(path, "r");
	if (file == NULL)
		return 'X';
	if (fscanf(file, "%*d %*s %c", &state) != 1)
		state = 'X';
	fclose(file);
	return state;
}

static bool is_alive(pid_t pid)
{
	char state = find_state(pid);
	return state != 'X' && state != 'Z';
}

/* A child of that process, or 0. */
static pid_t find_child(pid_t parent)
{
	char path[64];
	int child = 0;
	snprintf(path, sizeof(path), "/proc/%d/task/%d/children", (int)parent, (int)parent);
	FILE *file = fopen(path, "r");
	if (file == NULL)
		return 0;
	if (fscanf(file, "%d", &child) != 1)
		child = 0;
	fclose(file);
	return child;
}

static void pause_ms(long ms)
{
	const struct timespec pause = {.tv_nsec = ms * 1000000};
	nanosleep(&pause, NULL);
}

static void test_signals_end_it_and_its_children(void **state)
{
	(void)state;
	static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
	for (size_t i = 0; i < 3; i++) {
		pid_t child = 0,
		      pid = start_program(&(struct run){
			      .arguments = {"bench", CYLINDER, "--rounds=10000", "--out=out"}});
		pause_ms(300 + 300 * (long)i);
		for (int wait = 0; wait < 1000 && (child = find_child(pid)) == 0; wait++)
			pause_ms(1);
		assert_true(child > 0);
		assert_int_equal(kill(pid, signals[i]), 0);
		assert_int_equal(await_program(pid), 128 + signals[i]);
		for (int wait = 0; wait < 3000 && is_alive(child); wait++)
			pause_ms(1);
		assert_false(is_alive(child));
		assert_int_equal(access("out/results.csv", F_OK), -1);
	}
}

/*
 * By SIGABRT, since a sanitizer handles other crashes itself and may deadlock in that. A child that
 * stands still cannot have ended by itself meanwhile, as some do. Just one: the children of a
 * program that ends may be its leak checker's.
 */
static bool crash_a_child(pid_t parent)
{
	for (int wait = 0; wait < 5000 && is_alive(parent); wait++) {
		pid_t child = find_child(parent);
		if (child > 0 && find_state(child) == 'T')
			return kill(child, SIGABRT) == 0 && kill(child, SIGCONT) == 0;
		if (child > 0)
			kill(child, SIGSTOP);
		pause_ms(1);
	}
	return false;
}

/* A driver that crashes must not take the run's message with it. */
static void test_a_crash_is_one_line(void **state)
{
	(void)state;
	FILE *error = tmpfile();
	assert_non_null(error);
	fflush(stdout);
	pid_t pid = fork();
	if (pid == 0) {
		dup2(fileno(error), STDERR_FILENO);
		execl(SMOOTHIE_PROGRAM, SMOOTHIE_PROGRAM, "bench", CYLINDER, "--rounds=10000",
			"--out=out", NULL);
		_exit(127);
	}
	assert_true(crash_a_child(pid));
	assert_int_equal(await_program(pid), 1);
	char line[512] = "";
	rewind(error);
	assert_true(fread(line, 1, sizeof(line) - 1, error) > 0);
	fclose(error);
	assert_non_null(strstr(line, "builtin:cylinder: "));
	assert_non_null(strstr(line, "crashed (Aborted)\n"));
	assert_ptr_equal(strchr(line, '\n') + 1, line + strlen(line));
}

static const struct {
	const char *text;
	const char *arguments[4];
} refused[] = {
	{"--technique shiny: there is none of that name", {"--technique", "shiny"}},
	{"--technique hard-16: there is none", {"--technique", "hard-16"}},
	{"--radius wide: a share of the light's distance", {"--radius", "wide"}},
	{"--radius -1: ", {"--radius", "-1"}},
	{"--radius nan: ", {"--radius", "nan"}},
	{"--radius 0x1: ", {"--radius", "0x1"}},
	{"--map 0: ", {"--map", "0"}},
	{"a shadow map of 999999 texels", {"--map", "999999"}},
	{"--precision double: float, half or fixed12 is wanted", {"--precision", "double"}},
	{"--technique pcss-16: only smoothie has other precisions",
		{"--precision", "half", "--technique", "pcss-16"}},
	{"a shadow map of 2048 texels a side; with the precision \"half\"",
		{"--precision", "half", "--map", "2048"}},
	{"--size 2048x9: at most 2047 pixels", {"--precision", "half", "--size", "2048x9"}},
	{"--error-size 9x2048: at most 2047 pixels",
		{"--precision", "fixed12", "--error-size", "9x2048"}},
	{"--precision does nothing with --paper", {"--paper", "--precision", "half"}},
	{"--rounds 0: ", {"--rounds", "0"}},
	{"--samples 65537: a number from 1 to 65536", {"--samples", "65537"}},
	{"--size 64: ", {"--size", "64"}},
	{"this driver draws 1x1 to ", {"--size", "1x999999"}},
	{"--error-size x: ", {"--error-size", "x"}},
	{"this driver draws 1x1 to ", {"--error-size", "1x999999"}},
	{"missing.obj: No such file", {"--scene", "missing.obj"}},
	{"builtin:nothing: no such scene", {"--scene", "builtin:nothing"}},
	{"--models does nothing without --stress or --paper", {"--models", "."}},
	{"--map does nothing with --paper", {"--paper", "--map", "512"}},
	{"--seed does nothing without --stress", {"--seed", "3"}},
	{"--radius does nothing with --stress", {"--stress", "--radius", ".1"}},
	{"--paper does nothing with --stress", {"--paper", "--stress"}},
	{"--rounds does nothing with --paper", {"--paper", "--rounds", "3"}},
	{"--errors does nothing with --stress", {"--stress", "--errors"}},
	{"--quick does nothing with --paper", {"--paper", "--quick"}},
	{"there are: auto, smoothie, ", {"--technique", "shiny"}},
	{"--scene b/room.ini: results would", {"--scene", "a/room.ini", "--scene", "b/room.ini"}},
	{"cannot read missing.csv", {"--compare", "missing.csv"}},
	{"scene.ini: name scenes by --scene", {"scene.ini"}},
	{"missing/out (No such file", {"--out", "missing/out"}},
	{"cannot make the folder /dev/null", {"--out", "/dev/null"}},
};

static void test_refusals_are_one_line_and_leave_nothing(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++) {
		struct run run = {.arguments = {"bench"}};
		memcpy(run.arguments + 1, refused[i].arguments, sizeof(refused[i].arguments));
		struct outcome outcome = run_program(&run);
		assert_failure(&outcome, 2, refused[i].text);
		assert_string_equal(outcome.out, "");
		assert_int_equal(count_entries(""), 0);
		outcome_finish(&outcome);
	}
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_bench_scratch)

int main(void)
{
	const struct CMUnitTest tests[] = {
		IN_SCRATCH(test_a_run_leaves_a_row_for_each_technique),
		IN_SCRATCH(test_hard_is_timed_unasked),
		IN_SCRATCH(test_errors_alone_take_no_times),
		IN_SCRATCH(test_rows_go_through_scenes_radii_and_maps),
		IN_SCRATCH(test_choices_of_samples_are_techniques_of_their_own),
		IN_SCRATCH(test_precisions_are_rows_of_their_own),
		IN_SCRATCH(test_a_run_is_compared_with_an_earlier_one),
		IN_SCRATCH(test_a_full_disk_is_an_error_and_keeps_what_was_there),
		IN_SCRATCH(test_stress_prints_a_line_for_each_sweep),
		IN_SCRATCH(test_signals_end_it_and_its_children),
		IN_SCRATCH(test_a_crash_is_one_line),
		IN_SCRATCH(test_refusals_are_one_line_and_leave_nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
