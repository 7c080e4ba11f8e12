/* SPDX-License-Identifier: MIT */
/* What counts as better or worse from one run to another, and what is noise. */
#include "bench/compare.h"
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* A result with all that is compared. */
static struct result make_base(void)
{
	struct result result = make_result("fence", "pcss-16");
	for (int i = 0; i < REGIONS; i++)
		result.error[i] = (struct error_summary){1000, 0.1, 0, 0.2, 0.3, 1};
	for (int i = 0; i < THREAD_CHOICES; i++)
		result.time[i] = (struct time_summary){10, 9.8, 10.2, 20, 2, 1};
	result.flicker = 0.01;
	result.outside_wrong = 1000;
	result.geometry_bytes = result.target_bytes = result.peak_bytes = 100000;
	return result;
}

enum verdict { BETTER, WORSE, ALIKE };

static enum verdict compare_one(const struct result *from, const struct result *to, char *line)
{
	struct result old_one = *from, new_one = *to;
	struct result_list old_list = {&old_one, 1, 1}, new_list = {&new_one, 1, 1};
	struct text text = {0};
	struct comparison found = compare_print(&old_list, &new_list, text_begin(&text));
	snprintf(line, 500, "%s", text_end(&text));
	text_finish(&text);
	assert_int_equal(found.better + found.worse + found.alike, 1);
	assert_int_equal(found.gone + found.added, 0);
	return found.better ? BETTER : found.worse ? WORSE : ALIKE;
}

#define AT(field) offsetof(struct result, field)

static const struct {
	size_t offset; /* of a double in struct result */
	double from, to;
	enum verdict verdict;
} numbers[] = {
	{AT(error[REGION_PENUMBRA].rmse), 0.1, 0.1, ALIKE},
	{AT(error[REGION_PENUMBRA].rmse), 0.1, 0.1009, ALIKE}, /* below 1 % */
	{AT(error[REGION_PENUMBRA].rmse), 0.1, 0.1011, WORSE},
	{AT(error[REGION_PENUMBRA].rmse), 0.1, 0.0989, BETTER},
	{AT(error[REGION_PENUMBRA].rmse), 0.001, 0.00109, ALIKE}, /* below 1e-4 */
	{AT(error[REGION_PENUMBRA].rmse), 0.001, 0.00111, WORSE},
	{AT(error[REGION_PENUMBRA].rmse), 0, 0.5, WORSE},
	{AT(error[REGION_PENUMBRA].p99), 0.3, 0.31, WORSE},
	{AT(error[REGION_ALL].rmse), 0.1, 0.09, BETTER},
	{AT(error[REGION_PENUMBRA].bias), 0.1, 0.3, ALIKE}, /* neither is better */
	{AT(flicker), 0.01, 0.02, WORSE}, {AT(flicker), NAN, 0.02, ALIKE},
	{AT(flicker), 0.02, NAN, ALIKE}, {AT(outside_wrong), 0, 2, ALIKE},
	{AT(outside_wrong), 0, 3, WORSE}, {AT(outside_wrong), 500, 504, ALIKE},
	{AT(outside_wrong), NAN, 9, ALIKE},                /* of an earlier version */
	{AT(time[THREADS_DEFAULT].ratio), 2, 2.09, ALIKE}, /* below 5 % */
	{AT(time[THREADS_DEFAULT].ratio), 2, 2.11, WORSE},
	{AT(time[THREADS_DEFAULT].ratio), 2, 1.89, BETTER},
	{AT(time[THREADS_DEFAULT].ratio), 0, 1.89, ALIKE}, /* not measured */
	{AT(time[THREADS_NONE].ratio), 2, 4, WORSE},
	{AT(time[THREADS_DEFAULT].median), 10, 30, ALIKE}, /* the machine's, not the program's */
};

static void test_numbers_count_beyond_their_noise(void **state)
{
	(void)state;
	for (size_t i = 0; i < COUNT(numbers); i++) {
		struct result from = make_base(), to = make_base();
		char line[500];
		*(double *)((char *)&from + numbers[i].offset) = numbers[i].from;
		*(double *)((char *)&to + numbers[i].offset) = numbers[i].to;
		if (compare_one(&from, &to, line) != numbers[i].verdict)
			fail_msg("case %zu: %g -> %g gave %s", i, numbers[i].from, numbers[i].to,
				line);
	}
}

static void test_times_that_scatter_are_noisier(void **state)
{
	(void)state;
	static const struct {
		double p10, p90, ratio;
		enum verdict verdict;
	} cases[] = {
		{9.8, 10.2, 2.2, WORSE}, {8, 12, 2.2, ALIKE}, /* half the spread is 20 % */
		{8, 12, 2.39, ALIKE}, {8, 12, 2.41, WORSE},
		{12, 8, 2.2, WORSE}, /* no spread at all */
	};
	for (size_t i = 0; i < 2 * COUNT(cases); i++) {
		struct result from = make_base(), to = make_base();
		struct result *noisy = i % 2 == 0 ? &from : &to;
		char line[500];
		noisy->time[THREADS_DEFAULT].p10 = cases[i / 2].p10;
		noisy->time[THREADS_DEFAULT].p90 = cases[i / 2].p90;
		to.time[THREADS_DEFAULT].ratio = cases[i / 2].ratio;
		assert_int_equal(compare_one(&from, &to, line), cases[i / 2].verdict);
	}
}

static void test_memory_counts(void **state)
{
	(void)state;
	struct result from = make_base(), to = make_base();
	char line[500];
	to.peak_bytes = 104000;
	assert_int_equal(compare_one(&from, &to, line), ALIKE);
	to.peak_bytes = 106000;
	assert_int_equal(compare_one(&from, &to, line), WORSE);
	assert_non_null(strstr(line, "peak_bytes 100000 -> 106000 (+6.0 %)"));
	to = make_base();
	to.target_bytes = 98000;
	assert_int_equal(compare_one(&from, &to, line), BETTER);
}

static void test_one_loss_outweighs_gains(void **state)
{
	(void)state;
	struct result from = make_base(), to = make_base();
	char line[500];
	to.error[REGION_PENUMBRA].rmse = 0.05;
	to.time[THREADS_DEFAULT].ratio = 4;
	assert_int_equal(compare_one(&from, &to, line), WORSE);
	assert_string_equal(line,
		"better  fence, pcss-16, highp, radius 0.03, map 512: penumbra_rmse 0.1 -> 0.05 "
		"(-50.0 %)\n"
		"worse   fence, pcss-16, highp, radius 0.03, map 512: ratio 2 -> 4 (+100.0 %)\n"
		"0 better, 1 worse, 0 alike\n");
}

static void test_what_differs_is_not_compared(void **state)
{
	(void)state;
	struct result from = make_base(), to = make_base();
	char line[500];
	to.time[THREADS_DEFAULT].ratio = 4;
	strcpy(to.machine, "Another");
	assert_int_equal(compare_one(&from, &to, line), ALIKE);
	assert_non_null(strstr(line, "machines differ, so times are not compared: A processor, 2 "
				     "cores, a driver -> Another\n"));
	to = make_base();
	to.width = 256;
	to.error[REGION_PENUMBRA].rmse = 1;
	assert_int_equal(compare_one(&from, &to, line), ALIKE);
	assert_non_null(
		strstr(line, "sizes differ, so errors are not compared: 512x384 -> 256x384\n"));
	to = make_base();
	to.time_height = 1080;
	to.target_bytes = 1;
	to.time[THREADS_DEFAULT].ratio = 4;
	assert_int_equal(compare_one(&from, &to, line), ALIKE);
	assert_non_null(strstr(line, "sizes differ, so times and memory are not compared: "
				     "1280x720 -> 1280x1080\n"));
}

static void test_results_belong_together_by_what_they_are_of(void **state)
{
	(void)state;
	struct result base = make_base();
	struct result others[6];
	for (size_t i = 0; i < COUNT(others); i++)
		others[i] = base;
	strcpy(others[1].scene, "knot");
	strcpy(others[2].technique, "pcss-32");
	strcpy(others[3].precision, "mediump");
	others[4].radius = 0.1;
	others[5].map = 1024;
	struct result_list old_list = {&base, 1, 1}, new_list = {others, COUNT(others), 0};
	struct text text = {0};
	struct comparison found = compare_print(&old_list, &new_list, text_begin(&text));
	assert_int_equal(found.alike, 1);
	assert_int_equal(found.added, 5);
	assert_non_null(strstr(text_end(&text), "new     knot, pcss-16, highp, radius 0.03"));
	assert_non_null(strstr(text.bytes, "0 better, 0 worse, 1 alike, 0 gone, 5 new\n"));
	found = compare_print(&new_list, &old_list, text_begin(&text));
	assert_int_equal(found.gone, 5);
	assert_non_null(strstr(text_end(&text), "gone    fence, pcss-16, highp, radius 0.1, map"));
	text_finish(&text);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_numbers_count_beyond_their_noise),
		cmocka_unit_test(test_times_that_scatter_are_noisier),
		cmocka_unit_test(test_memory_counts),
		cmocka_unit_test(test_one_loss_outweighs_gains),
		cmocka_unit_test(test_what_differs_is_not_compared),
		cmocka_unit_test(test_results_belong_together_by_what_they_are_of),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
