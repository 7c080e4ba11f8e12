/* SPDX-License-Identifier: MIT */
/* What a run leaves: each status in each format, pictures that hold what was drawn, and whole files
 * or none. */
#include "check/report.h"
#include "app/output.h"
#include "synthetic.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <fcntl.h>
#include <math.h>
#include <png.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static char folder[] = "/tmp/smoothie-check-XXXXXX";

static int set_up(void **state)
{
	(void)state;
	strcpy(folder + strlen(folder) - 6, "XXXXXX");
	return mkdtemp(folder) == NULL;
}

static int tear_down(void **state)
{
	(void)state;
	char command[64];
	snprintf(command, sizeof(command), "rm -r %s", folder);
	return system(command);
}

static const char *path_of(const char *name)
{
	static char path[512];
	snprintf(path, sizeof(path), "%s/%s", folder, name);
	return path;
}

/* What is printed of a run; free() it. */
static char *print(void (*part)(FILE *file, const void *data), struct check_run *run)
{
	const struct check_report report = {folder, run, output_write};
	char *text = NULL;
	size_t size;
	FILE *file = open_memstream(&text, &size);
	assert_non_null(file);
	part(file, &report);
	assert_int_equal(fclose(file), 0);
	return text;
}

static void assert_contains(const char *text, const char *part)
{
	if (strstr(text, part) == NULL)
		fail_msg("\"%s\" is not in:\n%s", part, text);
}

static void assert_prints(
	void (*part)(FILE *file, const void *data), struct check_run *run, const char *expected)
{
	char *text = print(part, run);
	assert_contains(text, expected);
	free(text);
}

/* A case of that status, which failed in its first attempt where it can have. */
static struct check_result result_of(enum check_status status)
{
	struct check_result result = {
		.name = "group.case",
		.status = status,
		.first_status = status == CHECK_EXPECTED_FAIL ? CHECK_TIMEOUT : status,
		.attempts = 1,
		.seconds = 1.5,
		.message = "why",
	};
	return result;
}

static const struct status_case {
	enum check_status status;
	const char *results, *failures, *junit, *tap, *html;
} status_cases[] = {
	{CHECK_PASS, "group.case,Pass,1.500000\n", "", "time=\"1.500\">\n<system-out>",
		"ok 1 - group.case\n", "<span class=\"tag good\">Pass</span>"},
	{CHECK_FAIL, "group.case,Fail,1.500000\n", "group.case,Fail\n",
		"<failure type=\"Fail\" message=\"Fail: why\"></failure>",
		"not ok 1 - group.case\n  ---\n  status: Fail\n", ">Fail</span> <code>group.case<"},
	{CHECK_SKIP, "group.case,Skip,1.500000\n", "", "<skipped message=\"Skip: why\"></skipped>",
		"ok 1 - group.case # SKIP why\n", "<span class=\"tag idle\">Skip</span>"},
	{CHECK_CRASH, "group.case,Crash,1.500000\n", "group.case,Crash\n",
		"<error type=\"Crash\" message=\"Crash: why\"></error>",
		"not ok 1 - group.case\n  ---\n  status: Crash\n",
		">Crash</span> <code>group.case<"},
	{CHECK_TIMEOUT, "group.case,Timeout,1.500000\n", "group.case,Timeout\n",
		"<error type=\"Timeout\" message=\"Timeout: why\"></error>",
		"not ok 1 - group.case\n  ---\n  status: Timeout\n",
		">Timeout</span> <code>group.case<"},
	{CHECK_FLAKE, "group.case,Flake,1.500000\n", "", "\"1.500\">\n<system-out>Flake: why\n",
		"ok 1 - group.case\n  ---\n  status: Flake\n", ">Flake</span> <code>group.case<"},
	{CHECK_EXPECTED_FAIL, "group.case,ExpectedFail,1.500000\n", "group.case,Timeout\n",
		"<skipped message=\"ExpectedFail: why\"></skipped>",
		"not ok 1 - group.case # TODO why\n  ---\n  status: ExpectedFail\n",
		", at first Timeout</p>"},
	{CHECK_UNEXPECTED_PASS, "group.case,UnexpectedPass,1.500000\n", "",
		"<failure type=\"UnexpectedPass\" message=\"UnexpectedPass: why\"></failure>",
		"not ok 1 - group.case\n  ---\n  status: UnexpectedPass\n",
		">UnexpectedPass</span> <code>group.case<"},
};

static void print_tap(FILE *file, const void *data)
{
	const struct check_report *report = data;
	check_tap_result(file, 1, &report->run->results[0]);
}

static void test_statuses_in_each_format(void **state)
{
	(void)state;
	assert_int_equal(COUNT(status_cases), CHECK_STATUS_COUNT);
	for (size_t i = 0; i < COUNT(status_cases); i++) {
		const struct status_case *expected = &status_cases[i];
		struct check_result result = result_of(expected->status);
		struct check_run run = {.results = &result, .count = 1, .complete = true};
		char *results = print(check_print_results, &run);
		char *failures = print(check_print_failures, &run);
		char *tap = print(print_tap, &run);
		assert_string_equal(results, expected->results);
		assert_string_equal(failures, expected->failures);
		assert_memory_equal(tap, expected->tap, strlen(expected->tap));
		assert_prints(check_print_junit, &run, expected->junit);
		assert_prints(check_print_page, &run, expected->html);
		free(results);
		free(failures);
		free(tap);
	}
}

static void test_verdicts(void **state)
{
	(void)state;
	struct check_result results[] = {result_of(CHECK_PASS), result_of(CHECK_FLAKE)};
	struct check_run run = {.results = results, .count = 2, .complete = true};
	assert_prints(check_print_page, &run, "<span class=\"tag good\">2 as expected</span>");
	run.complete = false;
	assert_prints(check_print_page, &run, "<span class=\"tag odd\">2 as expected</span>");
	assert_prints(check_print_page, &run, "The run ended before all cases had.");
	results[1].status = CHECK_UNEXPECTED_PASS;
	assert_prints(check_print_page, &run, "<span class=\"tag bad\">1 of 2 unexpected</span>");
}

static void print_plan(FILE *file, const void *data)
{
	(void)data;
	check_tap_begin(file, 12);
	check_tap_bail_out(file, "no #room\nleft \xe9");
}

static void test_tap_begins_and_bails_out(void **state)
{
	(void)state;
	struct check_run run = {0};
	assert_prints(print_plan, &run,
		"TAP version 13\n1..12\nBail out! no \\#room left \xef\xbf\xbd\n");
}

static void test_tap_tells_differences(void **state)
{
	(void)state;
	struct check_result result = result_of(CHECK_FAIL);
	struct check_run run = {.results = &result, .count = 1};
	result.difference = (struct check_difference){100, 7, 2, .25, .125, .5};
	result.pictures = (struct check_pictures){"a.png", "b.png", "c.png"};
	assert_prints(print_tap, &run,
		"not ok 1 - group.case\n  ---\n  status: Fail\n  attempts: 1\n  seconds: 1.500\n"
		"  message: \"why\"\n  difference:\n    pixels: 100\n    failing: 7\n    budget: "
		"2\n"
		"    tolerance: 0.25\n    mean: 0.125\n    max: 0.5\n  pictures:\n"
		"    result: \"a.png\"\n    reference: \"b.png\"\n    difference: \"c.png\"\n  "
		"...\n");
}

static void test_pictures_are_attached(void **state)
{
	(void)state;
	struct check_result result = result_of(CHECK_FAIL);
	struct check_run run = {.results = &result, .count = 1};
	char expected[256];
	result.difference = (struct check_difference){100, 7, 2, .25, .125, .3};
	result.pictures = (struct check_pictures){"a.png", "b.png", "c.png"};
	snprintf(expected, sizeof(expected),
		"[[ATTACHMENT|%s/c.png]]\n[[ATTACHMENT|%s/a.png]]\n[[ATTACHMENT|%s/b.png]]\n"
		"c.png has the full red where the result is too bright by 0.5 or more\n",
		folder, folder, folder);
	assert_prints(check_print_junit, &run, expected);
	assert_prints(check_print_junit, &run,
		"7 of 100 pixels differ by more than 0.25 (2 may); mean 0.125, largest 0.3\n");
}

static void test_the_end_of_the_scale(void **state)
{
	(void)state;
	static const double cases[][2] = {{0, 1e-4}, {1e-4, 1e-4}, {1.01e-4, 2e-4}, {.003, .005},
		{.005, .005}, {.17, .2}, {.51, 1}, {1, 1}, {7, 1}, {NAN, 1e-4}};
	for (size_t i = 0; i < COUNT(cases); i++)
		assert_float_equal(check_difference_full(cases[i][0]), cases[i][1], 1e-12);
}

enum { WIDTH = 3, HEIGHT = 2 };

static const uint16_t drawn[HEIGHT * WIDTH] = {0, 1, 256, 32768, 65534, 65535};
static const uint16_t expected[HEIGHT * WIDTH] = {0, 1, 256, 32768, 65534, 0};
static const struct check_pair pair = {drawn, expected, WIDTH, HEIGHT};

/* Rows from the top; the picture has that size and format. */
static void read_png(const char *name, uint32_t format, void *pixels)
{
	png_image image = {.version = PNG_IMAGE_VERSION};
	assert_true(png_image_begin_read_from_file(&image, path_of(name)));
	assert_int_equal(image.width, WIDTH);
	assert_int_equal(image.height, HEIGHT);
	assert_int_equal(image.format, format);
	assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
}

static void test_pictures_hold_what_was_drawn(void **state)
{
	(void)state;
	struct check_result result = result_of(CHECK_FAIL);
	uint16_t values[HEIGHT * WIDTH];
	uint8_t rgb[HEIGHT * WIDTH][3];
	assert_true(check_pictures_write(folder, &pair, output_write, &result, NULL));
	assert_string_equal(result.pictures.result, "pictures/group.case-result.png");
	assert_string_equal(result.pictures.reference, "pictures/group.case-reference.png");
	assert_string_equal(result.pictures.difference, "pictures/group.case-difference.png");
	read_png(result.pictures.result, PNG_FORMAT_LINEAR_Y, values);
	assert_memory_equal(values, drawn, sizeof(drawn));
	read_png(result.pictures.reference, PNG_FORMAT_LINEAR_Y, values);
	assert_memory_equal(values, expected, sizeof(expected));
	read_png(result.pictures.difference, PNG_FORMAT_RGB, rgb);
	for (size_t i = 0; i + 1 < COUNT(rgb); i++) {
		assert_int_equal(rgb[i][0], rgb[i][2]);
		assert_memory_equal(rgb[i], rgb[0], 3);
	}
	assert_true(rgb[COUNT(rgb) - 1][0] > rgb[COUNT(rgb) - 1][2] + 100);
}

static void test_pictures_without_a_place(void **state)
{
	(void)state;
	struct check_result result = result_of(CHECK_FAIL);
	struct sm_error error = {0};
	result.pictures = (struct check_pictures){"a", "b", "c"};
	assert_false(
		check_pictures_write(path_of("missing"), &pair, output_write, &result, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_contains(error.text, "missing/pictures (No such file or directory)");
	assert_string_equal(result.pictures.result, "");
	assert_string_equal(result.pictures.difference, "");
}

static void test_pictures_that_are_gone(void **state)
{
	(void)state;
	struct check_result result = result_of(CHECK_FAIL);
	struct check_run run = {.results = &result, .count = 1};
	assert_true(check_pictures_write(folder, &pair, output_write, &result, NULL));
	assert_prints(check_print_page, &run, "<img class=\"over\" width=\"3\" height=\"2\"");
	assert_prints(check_print_page, &run, "<img class=\"heat\" width=\"3\" height=\"2\"");
	assert_true(output_write(path_of(result.pictures.difference), "no PNG", 6, NULL));
	assert_prints(check_print_page, &run, "Pictures are missing from the folder.");
	assert_prints(check_print_page, &run, "<img class=\"over\"");
	assert_int_equal(unlink(path_of(result.pictures.reference)), 0);
	char *page = print(check_print_page, &run);
	assert_null(strstr(page, "<img "));
	free(page);
}

/* Names of files that were written, and how many there is room for. */
static char written[256];
static size_t written_count, room;

static bool write_name(const char *path, const void *bytes, size_t size, struct sm_error *error)
{
	assert_non_null(bytes);
	assert_true(size > 0);
	if (written_count >= room)
		return error_set(error, SM_ERROR_MACHINE, "cannot write %s (disk full)", path);
	strcat(strcat(written, strrchr(path, '/') + 1), " ");
	written_count++;
	return true;
}

static void test_no_room_for_any_file_is_one_error(void **state)
{
	(void)state;
	static const char *const names[] = {
		"results.csv ", "failures.csv ", "junit.xml ", "report.html "};
	struct check_result result = result_of(CHECK_FAIL);
	struct check_run run = {.results = &result, .count = 1};
	const struct check_report report = {folder, &run, write_name};
	char so_far[256] = "";
	for (room = 0; room <= COUNT(names); room++) {
		struct sm_error error = {0};
		written[0] = '\0';
		written_count = 0;
		assert_int_equal(check_report_write(&report, &error), room == COUNT(names));
		assert_int_equal(error.status, room == COUNT(names) ? SM_OK : SM_ERROR_MACHINE);
		assert_string_equal(written, so_far);
		if (room < COUNT(names))
			strcat(so_far, names[room]);
	}
}

static void test_a_folder_that_is_missing(void **state)
{
	(void)state;
	struct check_run run = {0};
	struct sm_error error = {0};
	const struct check_report report = {"/dev/null", &run, output_write};
	assert_false(check_report_write(&report, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_string_equal(error.text, "cannot write /dev/null/results.csv (Not a directory)");
}

static char *read_file(const char *name)
{
	struct stat found;
	int fd = open(path_of(name), O_RDONLY | O_CLOEXEC);
	assert_true(fd >= 0 && fstat(fd, &found) == 0);
	char *text = calloc(1, (size_t)found.st_size + 1);
	assert_non_null(text);
	assert_int_equal(read(fd, text, (size_t)found.st_size), found.st_size);
	close(fd);
	return text;
}

/* In a child whose files cannot grow beyond a limit, which fails where a full disk does. */
static int write_limited(const struct check_report *report, rlim_t limit)
{
	int status = 0;
	pid_t child = fork();
	if (child == 0) {
		struct sm_error error = {0};
		signal(SIGXFSZ, SIG_IGN);
		setrlimit(RLIMIT_FSIZE, &(struct rlimit){limit, limit});
		bool whole = check_report_write(report, &error);
		_exit(whole ? 0 : strstr(error.text, "(File too large)") != NULL ? 1 : 2);
	}
	assert_int_equal(waitpid(child, &status, 0), child);
	assert_true(WIFEXITED(status));
	return WEXITSTATUS(status);
}

static void test_a_full_disk_keeps_earlier_files(void **state)
{
	(void)state;
	static const char *const names[] = {
		"results.csv", "failures.csv", "junit.xml", "report.html"};
	struct check_run run;
	char *before[COUNT(names)];
	const struct check_report report = {folder, &run, output_write};
	assert_true(synthetic_run(&run, folder, output_write, NULL));
	assert_true(check_report_write(&report, NULL));
	for (size_t i = 0; i < COUNT(names); i++)
		before[i] = read_file(names[i]);
	run.results[0].seconds = 7;
	run.count--;
	/* room for results.csv and failures.csv alone */
	assert_int_equal(write_limited(&report, 2 * strlen(before[0])), 1);
	for (size_t i = 0; i < COUNT(names); i++) {
		char *after = read_file(names[i]);
		assert_int_equal(strcmp(before[i], after) == 0, i > 0);
		free(after);
		free(before[i]);
	}
	assert_int_equal(write_limited(&report, RLIM_INFINITY), 0);
	check_run_finish(&run);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_statuses_in_each_format),
		cmocka_unit_test(test_verdicts),
		cmocka_unit_test(test_tap_begins_and_bails_out),
		cmocka_unit_test(test_tap_tells_differences),
		cmocka_unit_test(test_pictures_are_attached),
		cmocka_unit_test(test_the_end_of_the_scale),
		IN_FOLDER(test_pictures_hold_what_was_drawn),
		IN_FOLDER(test_pictures_without_a_place),
		IN_FOLDER(test_pictures_that_are_gone),
		cmocka_unit_test(test_no_room_for_any_file_is_one_error),
		cmocka_unit_test(test_a_folder_that_is_missing),
		IN_FOLDER(test_a_full_disk_keeps_earlier_files),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
