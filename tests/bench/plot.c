/* SPDX-License-Identifier: MIT */
/* What a chart shows: points, the front of those that nothing beats, names that stand apart. */
#include "bench/plot.h"
#include "bench/label.h"
#include "bench/pareto.h"
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct {
	const char *name;
	double points[6][2];
	size_t count;
	size_t front[6];
	size_t front_count;
} fronts[] = {
	{"none", {{0}}, 0, {0}, 0},
	{"one", {{1, 1}}, 1, {0}, 1},
	{"sorted by x", {{3, 1}, {1, 3}, {2, 2}}, 3, {1, 2, 0}, 3},
	{"one beaten", {{1, 3}, {2, 4}, {3, 1}}, 3, {0, 2}, 2},
	{"one beats all", {{2, 2}, {1, 1}, {3, 3}}, 3, {1}, 1},
	{"beaten in y alone", {{1, 1}, {1, 2}}, 2, {0}, 1},
	{"beaten in x alone", {{2, 1}, {1, 1}}, 2, {1}, 1},
	{"equal", {{1, 1}, {1, 1}, {1, 1}}, 3, {0}, 1},
	{"equal and another", {{2, 1}, {1, 2}, {2, 1}}, 3, {1, 0}, 2},
};

static void test_the_front_is_what_nothing_beats(void **state)
{
	(void)state;
	for (size_t i = 0; i < COUNT(fronts); i++) {
		size_t found[6];
		print_message("%s\n", fronts[i].name);
		assert_int_equal(pareto_front(fronts[i].points, fronts[i].count, found),
			fronts[i].front_count);
		for (size_t j = 0; j < fronts[i].front_count; j++)
			assert_int_equal(found[j], fronts[i].front[j]);
	}
}

static bool boxes_meet(const struct box *a, const struct box *b)
{
	return fabs(a->center[0] - b->center[0]) < a->half[0] + b->half[0] &&
	       fabs(a->center[1] - b->center[1]) < a->half[1] + b->half[1];
}

static void test_names_stand_apart(void **state)
{
	(void)state;
	static const struct box area = {{450, 300}, {450, 300}};
	struct label labels[12];
	struct box points[12];
	/* a crowd in a corner */
	for (size_t i = 0; i < COUNT(labels); i++) {
		double x = 20 + 25 * (double)(i % 4), y = 20 + 25 * (double)(i / 4);
		labels[i] = (struct label){{x, y}, {.half = {30, 8}}};
		points[i] = (struct box){{x, y}, {7, 7}};
	}
	labels_place(labels, 2, points, 2, &area);
	assert_false(boxes_meet(&labels[0].text, &labels[1].text));
	for (size_t i = 0; i < 4; i++)
		assert_false(boxes_meet(&labels[i / 2].text, &points[i % 2]));
	labels_place(labels, 12, points, 12, &area);
	for (size_t i = 0; i < 12; i++) {
		for (size_t j = 0; j < i; j++)
			assert_false(boxes_meet(&labels[i].text, &labels[j].text));
		for (int axis = 0; axis < 2; axis++)
			assert_true(labels[i].text.center[axis] >= labels[i].text.half[axis]);
	}
}

static struct result make_point(
	const char *scene, const char *technique, double rmse, double ms, double ratio)
{
	struct result result = make_result(scene, technique);
	result.error[REGION_PENUMBRA].rmse = rmse;
	result.time[THREADS_DEFAULT].median = ms;
	result.time[THREADS_DEFAULT].ratio = ratio;
	return result;
}

/* Writes the script of a chart, of the first result's scene or of all. */
static void write_script(struct result *results, size_t count, bool of_scene,
	enum plot_format format, struct text *text)
{
	struct result_list list = {results, count, count};
	struct contents contents;
	struct plot plot;
	assert_true(contents_init(&contents, &list, NULL, ".", NULL));
	contents.has_plots = true;
	assert_true(has_plot(&contents, contents.main, NULL));
	assert_true(plot_init(&plot, &contents, contents.main, of_scene ? results : NULL, NULL));
	assert_true(plot_write_script(&plot, format, text_begin(text), NULL));
	text_end(text);
	plot_finish(&plot);
	contents_finish(&contents);
}

static void assert_contains(const char *text, const char *part)
{
	if (strstr(text, part) == NULL)
		fail_msg("\"%s\" is not in:\n%s", part, text);
}

static void test_a_script_has_points_and_their_front(void **state)
{
	(void)state;
	struct result results[] = {
		make_point("it's", "hard", 0.25, 10, 1),
		make_point("it's", "slow", 0.5, 20, 2),
		make_point("it's", "soft-16", 0.0625, 40, 4),
	};
	struct text text = {0};
	write_script(results, COUNT(results), true, PLOT_SVG, &text);
	assert_contains(text.bytes, "set terminal svg ");
	assert_contains(text.bytes, "$front << END\n1 0.25\n4 0.0625\nEND\n");
	assert_contains(text.bytes, "\n1 0.25 7 0x4c4c4c\n2 0.5 5 0x0072b2\n4 0.0625 9 0xd55e00\n");
	assert_contains(text.bytes, "'it''s: error against time'");
	assert_contains(text.bytes, "'soft-16' at screen ");
	assert_contains(text.bytes, "time of hard shadows");
	write_script(results, COUNT(results), true, PLOT_PNG, &text);
	assert_contains(text.bytes, "set terminal pngcairo ");
	text_finish(&text);
}

static void test_means_are_of_all_scenes(void **state)
{
	(void)state;
	struct result results[] = {
		make_point("a", "hard", 0.25, 10, 1),
		make_point("b", "hard", 0.75, 40, 1),
		make_point("a", "soft", 0.125, 20, 2),
		make_point("b", "soft", 0.375, 320, 8),
		make_point("a", "incomplete", 0.5, 20, 2),
	};
	struct text text = {0};
	write_script(results, COUNT(results), false, PLOT_SVG, &text);
	assert_contains(text.bytes, "'Error against time, mean of 2 scenes'");
	assert_contains(text.bytes, "$front << END\n1 0.5\n4 0.25\nEND\n");
	assert_null(strstr(text.bytes, "incomplete"));
	text_finish(&text);
}

static void test_without_ratios_times_are_milliseconds(void **state)
{
	(void)state;
	struct result results[] = {
		make_point("a", "hard", 0.25, 10, 0),
		make_point("a", "soft", 0.125, 20, 2),
	};
	struct text text = {0};
	write_script(results, COUNT(results), true, PLOT_SVG, &text);
	assert_contains(text.bytes, "'time of a frame, ms'");
	assert_contains(text.bytes, "$front << END\n10 0.25\n20 0.125\nEND\n");
	text_finish(&text);
}

static void test_what_was_not_measured_is_not_shown(void **state)
{
	(void)state;
	struct result results[] = {
		make_point("a", "untimed", 0.25, 0, 0),
		make_point("a", "perfect", 0, 10, 1),
		make_point("a", "unknown", NAN, 10, 1),
		make_point("a", "dark", 0.1, 10, 1),
	};
	results[3].error[REGION_PENUMBRA].pixels = 0;
	struct result_list list = {results, COUNT(results), 0};
	struct contents contents;
	assert_true(contents_init(&contents, &list, NULL, ".", NULL));
	contents.has_plots = true;
	assert_false(has_plot(&contents, contents.main, NULL));
	contents_finish(&contents);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_the_front_is_what_nothing_beats),
		cmocka_unit_test(test_names_stand_apart),
		cmocka_unit_test(test_a_script_has_points_and_their_front),
		cmocka_unit_test(test_means_are_of_all_scenes),
		cmocka_unit_test(test_without_ratios_times_are_milliseconds),
		cmocka_unit_test(test_what_was_not_measured_is_not_shown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
