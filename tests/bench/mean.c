/* SPDX-License-Identifier: MIT */
/* A technique over scenes: errors where there is something to err in, times everywhere. */
#include "bench/mean.h"
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
/* To assert_float_equal() NAN is near everything. */
#define NEAR(a, b) assert_true(fabs((a) - (b)) < 1e-12)

/* With errors that are multiples of the RMSE. */
static struct result make_row(const char *scene, double rmse, double ratio)
{
	struct result result = make_result(scene, "soft");
	struct error_summary *penumbra = &result.error[REGION_PENUMBRA];
	penumbra->rmse = rmse;
	penumbra->bias = -rmse / 2;
	penumbra->p99 = 2 * rmse;
	result.error[REGION_ALL].rmse = rmse / 8;
	result.outside_wrong = 100 * rmse;
	result.flicker = rmse / 4;
	result.time[THREADS_DEFAULT].ratio = ratio;
	result.time[THREADS_DEFAULT].ratio_pcss = ratio / 2;
	result.time[THREADS_DEFAULT].median = 10 * ratio;
	return result;
}

/* Of the first row's setting and technique. */
static struct mean mean_of_rows(struct result *rows, size_t count, const struct result *scene)
{
	struct result_list list = {rows, count, count};
	return mean_of(&list, rows, rows, scene);
}

static void test_errors_are_added_and_times_multiplied(void **state)
{
	(void)state;
	struct result rows[] = {make_row("a", .1, 2), make_row("b", .3, 8)};
	struct mean mean = mean_of_rows(rows, COUNT(rows), NULL);
	assert_int_equal(mean.scenes, 2);
	NEAR(mean.rmse, .2);
	NEAR(mean.bias, -.1);
	NEAR(mean.p99, .4);
	NEAR(mean.all_rmse, .025);
	NEAR(mean.outside_wrong, 20);
	NEAR(mean.flicker, .05);
	NEAR(mean.ratio, 4);
	NEAR(mean.ratio_pcss, 2);
	NEAR(mean.ms, 40);
	assert_true(mean_is_complete(&mean));
}

static void test_only_what_belongs_together_counts(void **state)
{
	(void)state;
	struct result rows[] = {make_row("a", .1, 2), make_row("b", .3, 8), make_row("c", .7, 9),
		make_result("d", "hard")};
	rows[2].radius = .5;
	assert_int_equal(mean_of_rows(rows, COUNT(rows), NULL).scenes, 2);
	struct mean mean = mean_of_rows(rows, COUNT(rows), &rows[1]);
	assert_int_equal(mean.scenes, 1);
	NEAR(mean.rmse, .3);
	assert_int_equal(mean_of_rows(rows, COUNT(rows), &rows[3]).scenes, 0);
}

static void test_errors_are_of_scenes_with_such_pixels(void **state)
{
	(void)state;
	/* The second has no penumbra, and of the third nothing is judged. */
	struct result rows[] = {make_row("a", .1, 2), make_row("b", NAN, 8), make_row("c", NAN, 4)};
	rows[1].error[REGION_PENUMBRA].pixels = rows[2].error[REGION_PENUMBRA].pixels = 0;
	rows[2].error[REGION_ALL].pixels = 0;
	rows[1].flicker = .075;
	struct mean mean = mean_of_rows(rows, COUNT(rows), NULL);
	assert_int_equal(mean.scenes, 3);
	NEAR(mean.rmse, .1);
	NEAR(mean.bias, -.05);
	NEAR(mean.p99, .2);
	NEAR(mean.flicker, .05);
	NEAR(mean.ratio, 4);
}

static void test_times_need_no_reference(void **state)
{
	(void)state;
	struct result rows[] = {make_row("a", NAN, 2), make_row("b", NAN, 8)};
	for (size_t i = 0; i < COUNT(rows); i++)
		for (int region = 0; region < REGIONS; region++)
			rows[i].error[region].pixels = 0;
	struct mean mean = mean_of_rows(rows, COUNT(rows), NULL);
	assert_int_equal(mean.scenes, 2);
	assert_true(isnan(mean.rmse) && isnan(mean.bias) && isnan(mean.p99));
	assert_true(isnan(mean.flicker));
	NEAR(mean.ratio, 4);
	NEAR(mean.ms, 40);
	assert_false(mean_is_complete(&mean));
}

static void test_what_one_scene_lacks_the_mean_lacks(void **state)
{
	(void)state;
	struct result rows[] = {make_row("a", .1, 2), make_row("b", .3, 0)};
	rows[1].flicker = NAN;
	struct mean mean = mean_of_rows(rows, COUNT(rows), NULL);
	NEAR(mean.rmse, .2);
	assert_true(isnan(mean.flicker) && isnan(mean.ratio) && isnan(mean.ms));
	assert_false(mean_is_complete(&mean));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_errors_are_added_and_times_multiplied),
		cmocka_unit_test(test_only_what_belongs_together_counts),
		cmocka_unit_test(test_errors_are_of_scenes_with_such_pixels),
		cmocka_unit_test(test_times_need_no_reference),
		cmocka_unit_test(test_what_one_scene_lacks_the_mean_lacks),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
