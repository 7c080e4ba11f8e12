/* SPDX-License-Identifier: MIT */
/* Everything that a run leaves: which files, that pages are well formed whatever scenes are called,
 * and what happens without gnuplot or without room. */
#include "bench/report.h"
#include "base/log.h"
#include "bench/contents.h"
#include "bench/gnuplot.h"
#include "bench/html.h"
#include "bench/markdown.h"
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Before it is changed to hide gnuplot or to show another one. */
static char original_path[4096];

static const char evil[] = "<b>&\"|`*'\n";

static struct result results[6];
static const struct result_list list = {results, COUNT(results), 0};
static const struct result_list no_results;
static struct run_facts facts;

/* Files that were written, and how many of them there is room for. */
static char written[2000];
static size_t written_count, room;
/* Those of them that are pictures indeed. */
static size_t svg_count, png_count;

static bool write_file(const char *path, const void *bytes, size_t size, struct sm_error *error)
{
	assert_non_null(bytes);
	assert_true(size > 0);
	if (written_count >= room)
		return error_set(error, SM_ERROR_MACHINE, "cannot write %s (disk full)", path);
	/* Memory streams end their text with a 0. */
	const char *text = bytes;
	size_t length = strlen(path);
	if (strcmp(path + length - 4, ".svg") == 0)
		svg_count += strstr(text, "</svg>") != NULL;
	if (strcmp(path + length - 4, ".png") == 0)
		png_count += size > 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0;
	strcat(strcat(written, path), "\n");
	written_count++;
	return true;
}

static char folder[] = "/tmp/smoothie-report-XXXXXX";
static char tools[64];

static int set_up(void **state)
{
	(void)state;
	static char *const arguments[] = {"bench", "--scene", "<script>"};
	static const char *const scenes[] = {"fence", evil};
	static const char *const techniques[] = {"hard", "pcss-16", "pcss-32"};
	for (size_t i = 0; i < COUNT(results); i++)
		results[i] = make_result(scenes[i / 3], techniques[i % 3]);
	results[2].radius = 0.1;
	run_facts_init(&facts, 3, arguments);
	run_facts_add(&facts, "odd", "%s", evil);
	return mkdtemp(folder) == NULL;
}

static int tear_down(void **state)
{
	(void)state;
	char command[128];
	run_facts_finish(&facts);
	snprintf(command, sizeof(command), "rm -r %s", folder);
	return system(command);
}

/* A gnuplot that prints its script, first in PATH. */
static void install_gnuplot(void)
{
	char path[128];
	snprintf(tools, sizeof(tools), "%s/tools", folder);
	snprintf(path, sizeof(path), "%s/gnuplot", tools);
	assert_true(report_make_folder(tools, NULL));
	FILE *file = fopen(path, "w");
	assert_non_null(file);
	fputs("#!/bin/sh\nexec /bin/cat\n", file);
	fclose(file);
	assert_int_equal(chmod(path, 0755), 0);
	assert_int_equal(setenv("PATH", tools, 1), 0);
}

static bool write_report(
	const struct result_list *written_list, size_t files, struct sm_error *error)
{
	struct report report = {folder, written_list, &facts, write_file};
	written[0] = '\0';
	written_count = svg_count = png_count = 0;
	room = files;
	return report_write(&report, error);
}

static void assert_contains(const char *text, const char *part)
{
	if (strstr(text, part) == NULL)
		fail_msg("\"%s\" is not in:\n%s", part, text);
}

static void assert_wrote(const char *name)
{
	char line[256];
	snprintf(line, sizeof(line), "%s/%s\n", folder, name);
	assert_contains(written, line);
}

static void test_all_files_are_written(void **state)
{
	(void)state;
	static const char *const names[] = {"results.csv", "results.json", "plots/overall.svg",
		"plots/overall.png", "plots/overall-2.svg", "plots/overall-2.png",
		"plots/scene-fence.svg", "plots/scene-fence.png",
		"plots/scene-_3cb_3e_26_22_7c_60_2a_27_0a.svg",
		"plots/scene-_3cb_3e_26_22_7c_60_2a_27_0a.png", "report.html", "results.md"};
	struct sm_error error;
	install_gnuplot();
	assert_true(write_report(&list, SIZE_MAX, &error));
	for (size_t i = 0; i < COUNT(names); i++)
		assert_wrote(names[i]);
	assert_int_equal(written_count, COUNT(names));
}

static void test_no_room_for_any_file_is_one_error(void **state)
{
	(void)state;
	install_gnuplot();
	for (size_t files = 0; files < 12; files++) {
		struct sm_error error = {0};
		assert_false(write_report(&list, files, &error));
		assert_int_equal(error.status, SM_ERROR_MACHINE);
		assert_contains(error.text, "(disk full)");
		assert_int_equal(written_count, files);
	}
}

static void test_gnuplot_understands_scripts(void **state)
{
	(void)state;
	struct sm_error error;
	FILE *script = tmpfile(), *output;
	assert_non_null(script);
	assert_int_equal(setenv("PATH", original_path, 1), 0);
	bool there = gnuplot_run(script, &output, &error);
	fclose(script);
	if (!there)
		skip();
	fclose(output);
	assert_true(write_report(&list, SIZE_MAX, &error));
	assert_int_equal(svg_count, 4);
	assert_int_equal(png_count, 4);
}

static void test_data_alone_can_be_written(void **state)
{
	(void)state;
	struct sm_error error;
	const struct report report = {folder, &list, &facts, write_file};
	written[0] = '\0';
	written_count = 0;
	room = SIZE_MAX;
	assert_true(report_write_data(&report, &error));
	assert_int_equal(written_count, 2);
	assert_wrote("results.csv");
	assert_wrote("results.json");
}

static char warning[500];
static int warning_count;

static void keep_warning(void *data, enum sm_log_level level, const char *line)
{
	(void)data;
	assert_int_equal(level, SM_LOG_WARNING);
	snprintf(warning, sizeof(warning), "%s", line);
	warning_count++;
}

static void test_without_gnuplot_there_are_no_charts(void **state)
{
	(void)state;
	struct sm_error error;
	assert_int_equal(setenv("PATH", "/nowhere", 1), 0);
	log_set_sink(keep_warning, NULL);
	assert_true(write_report(&list, SIZE_MAX, &error));
	log_set_sink(NULL, NULL);
	assert_int_equal(warning_count, 1);
	assert_string_equal(
		warning, "going on without charts: cannot run gnuplot (No such file or directory)");
	assert_int_equal(written_count, 4);
	assert_wrote("report.html");
}

static void test_nothing_measured_is_a_report_too(void **state)
{
	(void)state;
	struct sm_error error;
	assert_true(write_report(&no_results, SIZE_MAX, &error));
	assert_int_equal(written_count, 4);
}

static void test_a_folder_that_cannot_be_made(void **state)
{
	(void)state;
	struct sm_error error;
	assert_false(report_make_folder("/nowhere/at/all", &error));
	assert_string_equal(
		error.text, "cannot make the folder /nowhere/at/all (No such file or directory)");
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_false(report_make_folder("/dev/null", &error));
	assert_string_equal(error.text, "cannot make the folder /dev/null (Not a directory)");
	assert_true(report_make_folder(folder, &error));
}

/* Fails unless each start tag has its end tag, in order, and no other "<" is in the text. */
static void assert_well_formed(const char *html)
{
	static const char *const empty[] = {"meta", "img", "!DOCTYPE"};
	char open[32][16];
	size_t depth = 0;
	for (const char *at = strchr(html, '<'); at != NULL; at = strchr(at, '<')) {
		char name[16] = "";
		bool is_empty = false;
		at += 1 + (at[1] == '/');
		size_t length = strspn(at, "abcdefghijklmnopqrstuvwxyzDOCTYPE!1234");
		assert_in_range(length, 1, sizeof(name) - 1);
		memcpy(name, at, length);
		for (size_t i = 0; i < COUNT(empty); i++)
			is_empty |= strcmp(name, empty[i]) == 0;
		if (at[-1] == '/') {
			assert_true(depth > 0);
			assert_string_equal(open[--depth], name);
		} else if (!is_empty) {
			assert_true(depth < COUNT(open));
			strcpy(open[depth++], name);
		}
	}
	assert_int_equal(depth, 0);
}

static void write_pages(
	const struct result_list *of, bool plots, struct text *html, struct text *markdown)
{
	struct contents contents;
	assert_true(contents_init(&contents, of, &facts, folder, NULL));
	contents.has_plots = plots;
	html_write(&contents, text_begin(html));
	text_end(html);
	markdown_write(&contents, text_begin(markdown));
	text_end(markdown);
	contents_finish(&contents);
}

static void test_pages_are_well_formed(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	for (int i = 0; i < 4; i++) {
		write_pages(i / 2 == 0 ? &list : &no_results, i % 2 == 0, &html, &markdown);
		assert_well_formed(html.bytes);
		assert_contains(html.bytes, "smoothie bench --scene '&lt;script&gt;'");
		assert_contains(markdown.bytes, "\tsmoothie bench --scene '<script>'\n");
	}
	text_finish(&html);
	text_finish(&markdown);
}

static void test_names_are_no_markup(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	write_pages(&list, true, &html, &markdown);
	assert_contains(html.bytes, "<h3>&lt;b&gt;&amp;&quot;|`*' </h3>");
	assert_null(strstr(html.bytes, "<b>"));
	assert_contains(markdown.bytes, "## \\<b\\>\\&\"\\|\\`\\*' \n");
	text_finish(&html);
	text_finish(&markdown);
}

static void test_best_values_are_marked(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	struct result pair[2] = {make_result("fence", "hard"), make_result("fence", "soft")};
	struct result_list two = {pair, 2, 2};
	pair[1].error[REGION_PENUMBRA].rmse = 0.05;
	pair[0].time[THREADS_DEFAULT].ratio = 1;
	pair[1].time[THREADS_DEFAULT].ratio = 2.5;
	pair[0].peak_bytes = 1000;
	pair[1].peak_bytes = 0;
	write_pages(&two, true, &html, &markdown);
	assert_contains(html.bytes, "<td class=\"best\"><strong>0.0500</strong></td>");
	assert_contains(html.bytes, "<td class=\"best\"><strong>1.00</strong></td>");
	assert_contains(html.bytes, "<td>2.50</td>");
	assert_contains(markdown.bytes, "| soft | **0.0500** | -0.0167 |");
	assert_contains(markdown.bytes, " | - |\n"); /* no peak */
	text_finish(&html);
	text_finish(&markdown);
}

static void test_columns_that_nothing_was_measured_in_are_left_out(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	struct result result = make_result("fence", "hard");
	struct result_list one = {&result, 1, 1};
	write_pages(&one, true, &html, &markdown);
	assert_contains(html.bytes, ">ms single</th>");
	assert_contains(markdown.bytes, "| ms single |");
	result.time[THREADS_NONE] = (struct time_summary){0};
	write_pages(&one, true, &html, &markdown);
	assert_null(strstr(html.bytes, ">ms single</th>"));
	assert_null(strstr(markdown.bytes, "| ms single |"));
	text_finish(&html);
	text_finish(&markdown);
}

static void test_means_of_times_need_no_errors(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	struct result result = make_result("fence", "hard");
	struct result_list one = {&result, 1, 1};
	result.time[THREADS_DEFAULT].median = 20;
	result.time[THREADS_DEFAULT].ratio = 2;
	result.time[THREADS_DEFAULT].ratio_pcss = 0; /* not timed */
	result.error[REGION_ALL].pixels = result.error[REGION_PENUMBRA].pixels = 0;
	write_pages(&one, true, &html, &markdown);
	assert_contains(html.bytes, "<td>1</td><td>-</td><td>-</td><td>-</td><td>-</td><td>-</td>"
				    "<td>-</td><td>20.00</td><td>2.00</td><td>-</td>");
	assert_contains(markdown.bytes,
		"| technique | scenes | RMSE | bias | p99 | RMSE of all | wrong outside | flicker "
		"| ms | ms / hard | ms / pcss-16 |\n"
		"|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
		"| hard | 1 | - | - | - | - | - | - | 20.00 | 2.00 | - |\n");
	text_finish(&html);
	text_finish(&markdown);
}

static struct result at(const char *scene, const char *technique, double ms, double rmse)
{
	struct result result = make_result(scene, technique);
	result.time[THREADS_DEFAULT].median = ms;
	result.error[REGION_PENUMBRA].rmse = rmse;
	return result;
}

static void test_the_frontier_is_told(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	struct result points[] = {at("fence", "hard", 10, .3), at("fence", "quick", 20, .05),
		at("fence", "near", 30, .01), at("fence", "slow", 40, .01),
		at("knot", "hard", 10, .3), at("knot", "quick", 20, .049),
		at("knot", "near", 30, .01), at("boxes", "hard", 10, .3),
		at("boxes", "near", 0, .01)};
	const struct result_list all = {points, COUNT(points), 0}, untimed = {points + 8, 1, 0};
	write_pages(&all, false, &html, &markdown);
	static const char *const told[] = {"in both time and error: near.",
		"in both time and error: quick, near.", "in both time and error: none.",
		("one alone that none beats in both time and error: near in 1 of 3 scenes and "
		 "settings.")};
	for (size_t i = 0; i < COUNT(told); i++) {
		assert_contains(html.bytes, told[i]);
		assert_contains(markdown.bytes, told[i]);
	}
	points[2].error[REGION_PENUMBRA].rmse = points[3].error[REGION_PENUMBRA].rmse = .05;
	write_pages(&all, false, &html, &markdown);
	assert_contains(
		markdown.bytes, "in both time and error: in none of 3 scenes and settings.");
	write_pages(&untimed, false, &html, &markdown);
	assert_null(strstr(markdown.bytes, "in both time and error"));
	text_finish(&html);
	text_finish(&markdown);
}

static struct result in_precision(const char *technique, const char *precision, double rmse)
{
	struct result result = make_result("fence", technique);
	snprintf(result.precision, sizeof(result.precision), "%s", precision);
	result.error[REGION_PENUMBRA].rmse = rmse;
	return result;
}

static void test_precisions_are_held_against_float(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	struct result mixed[] = {in_precision("hard", "float", .3),
		in_precision("smoothie", "float", .2), in_precision("smoothie", "half", .21),
		in_precision("smoothie", "fixed12", .25), in_precision("smoothie", "half", .22)};
	const struct result_list all = {mixed, COUNT(mixed), 0}, floats = {mixed, 2, 0};
	mixed[2].time[THREADS_DEFAULT].median *= 1.5;
	mixed[3].time[THREADS_DEFAULT].median = 0;
	mixed[4].map = 1024; /* without one in float */
	write_pages(&all, true, &html, &markdown);
	assert_contains(markdown.bytes,
		"| fence | 0.03 | 512 | smoothie | float | 0.2000 | +0.0000 | -0.0167 | 0.0000 | "
		"0.33333 | 1.10 | 1.00 |\n"
		"| fence | 0.03 | 512 | smoothie | half | 0.2100 | +0.0100 | -0.0167 | 0.0000 | "
		"0.33333 | 1.65 | 1.50 |\n"
		"| fence | 0.03 | 512 | smoothie | fixed12 | 0.2500 | +0.0500 | -0.0167 | 0.0000 | "
		"0.33333 | - | - |\n\n");
	write_pages(&floats, true, &html, &markdown);
	assert_null(strstr(markdown.bytes, "precision costs"));
	text_finish(&html);
	text_finish(&markdown);
}

static void test_names_of_files_differ_as_scenes_do(void **state)
{
	(void)state;
	char scenes[6][128] = {"a b", "a_20b", "A b", "a,b"};
	char names[6][FILE_NAME_MAX];
	memset(scenes[4], '\xe9', sizeof(scenes[4]) - 1);
	memset(scenes[5], '\xe9', sizeof(scenes[5]) - 2);
	for (size_t i = 0; i < COUNT(scenes); i++) {
		struct result result = make_result(scenes[i], scenes[i]);
		difference_file_name(&result, names[i]);
		assert_true(strlen(names[i]) < 255);
		for (size_t j = 0; j < i; j++)
			assert_string_not_equal(names[i], names[j]);
	}
}

static void leave_file(const char *name)
{
	char path[FILE_NAME_MAX + 64];
	snprintf(path, sizeof(path), "%s/%s", folder, name);
	FILE *file = fopen(path, "w");
	assert_non_null(file);
	fclose(file);
}

static void test_sheets_are_shown_where_they_are(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	char name[FILE_NAME_MAX], sheets[128];
	sheet_file_name(&results[1], name);
	assert_string_equal(name, "sheets/fence-r0.03-m512.png");
	snprintf(sheets, sizeof(sheets), "%s/sheets", folder);
	assert_true(report_make_folder(sheets, NULL));
	write_pages(&list, true, &html, &markdown);
	assert_null(strstr(html.bytes, "Side by side"));
	leave_file(name);
	write_pages(&list, true, &html, &markdown);
	assert_contains(html.bytes, "<a href=\"sheets/fence-r0.03-m512.png\">");
	assert_well_formed(html.bytes);
	text_finish(&html);
	text_finish(&markdown);
}

static void test_difference_pictures_are_shown_where_they_are(void **state)
{
	(void)state;
	struct text html = {0}, markdown = {0};
	char name[FILE_NAME_MAX], path[128];
	write_pages(&list, true, &html, &markdown);
	assert_null(strstr(html.bytes, "class=\"differences\""));
	difference_file_name(&results[1], name);
	assert_string_equal(name, "differences/fence-pcss-16-r0.03-m512-highp.png");
	snprintf(path, sizeof(path), "%s/differences", folder);
	assert_true(report_make_folder(path, NULL));
	leave_file(name);
	write_pages(&list, true, &html, &markdown);
	assert_contains(html.bytes, "<a href=\"differences/fence-pcss-16-r0.03-m512-highp.png\">");
	assert_well_formed(html.bytes);
	text_finish(&html);
	text_finish(&markdown);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_all_files_are_written),
		cmocka_unit_test(test_no_room_for_any_file_is_one_error),
		cmocka_unit_test(test_gnuplot_understands_scripts),
		cmocka_unit_test(test_data_alone_can_be_written),
		cmocka_unit_test(test_without_gnuplot_there_are_no_charts),
		cmocka_unit_test(test_nothing_measured_is_a_report_too),
		cmocka_unit_test(test_a_folder_that_cannot_be_made),
		cmocka_unit_test(test_pages_are_well_formed),
		cmocka_unit_test(test_names_are_no_markup),
		cmocka_unit_test(test_best_values_are_marked),
		cmocka_unit_test(test_columns_that_nothing_was_measured_in_are_left_out),
		cmocka_unit_test(test_means_of_times_need_no_errors),
		cmocka_unit_test(test_the_frontier_is_told),
		cmocka_unit_test(test_precisions_are_held_against_float),
		cmocka_unit_test(test_names_of_files_differ_as_scenes_do),
		cmocka_unit_test(test_sheets_are_shown_where_they_are),
		cmocka_unit_test(test_difference_pictures_are_shown_where_they_are),
	};
	const char *path = getenv("PATH");
	snprintf(original_path, sizeof(original_path), "%s", path != NULL ? path : "");
	int failed = cmocka_run_group_tests(tests, set_up, NULL);
	setenv("PATH", original_path, 1);
	return tear_down(NULL) != 0 || failed;
}
