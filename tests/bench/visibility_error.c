/* SPDX-License-Identifier: MIT */
/* Errors of pictures that were made by hand. */
#include "bench/visibility_error.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define CLOSE 1e-6 /* pictures are floats */

/* Lit, umbra, penumbra and not judged pixels, mixed. */
static const float truth[] = {1, 0, .5f, NAN, 1, .25f, 0, .75f, NAN, 1};
static const float seen[] = {.8f, .1f, 1, .3f, 1, 0, 0, .5f, 0, 1};

static void check(const struct error_summary *found, const struct error_summary *wanted)
{
	assert_int_equal(found->pixels, wanted->pixels);
	assert_float_equal(found->rmse, wanted->rmse, CLOSE);
	assert_float_equal(found->bias, wanted->bias, CLOSE);
	assert_float_equal(found->p95, wanted->p95, CLOSE);
	assert_float_equal(found->p99, wanted->p99, CLOSE);
	assert_float_equal(found->max, wanted->max, CLOSE);
}

static void check_nothing(const struct error_summary *found)
{
	assert_int_equal(found->pixels, 0);
	assert_true(isnan(found->rmse) && isnan(found->bias) && isnan(found->p95));
	assert_true(isnan(found->p99) && isnan(found->max));
}

static void test_regions_are_told_apart_by_the_truth(void **state)
{
	(void)state;
	/* Sorted |error|: lit 0 0 .2, umbra 0 .1, penumbra .25 .25 .5. */
	static const struct error_summary wanted[REGIONS] = {
		[REGION_ALL] = {8, .2304886, -.0125, .4125, .4825, .5},
		[REGION_LIT] = {3, .1154701, -.0666667, .18, .196, .2},
		[REGION_UMBRA] = {2, .0707107, .05, .095, .099, .1},
		[REGION_PENUMBRA] = {3, .3535534, 0, .475, .495, .5},
	};
	struct error_summary found[REGIONS];
	assert_true(visibility_error(seen, truth, COUNT(truth), found, NULL));
	for (int region = 0; region < REGIONS; region++)
		check(&found[region], &wanted[region]);
}

static void test_regions_without_pixels_are_not_a_number(void **state)
{
	(void)state;
	static const float lit[] = {1, 1}, none[] = {NAN, NAN}, dark[] = {0, 0};
	struct error_summary found[REGIONS];
	assert_true(visibility_error(dark, lit, 2, found, NULL));
	assert_float_equal(found[REGION_LIT].rmse, 1, 0);
	assert_float_equal(found[REGION_LIT].bias, -1, 0);
	check_nothing(&found[REGION_UMBRA]);
	check_nothing(&found[REGION_PENUMBRA]);
	assert_true(visibility_error(dark, none, 2, found, NULL));
	check_nothing(&found[REGION_ALL]);
	assert_true(visibility_error(dark, none, 0, found, NULL));
	check_nothing(&found[REGION_ALL]);
}

static void test_wrong_pixels_outside_penumbrae_are_counted(void **state)
{
	(void)state;
	static const float outside[] = {1, 0, 1, 0, .5f, NAN};
	static const float drawn[] = {.89f, .11f, .91f, .09f, 0, 0};
	assert_float_equal(visibility_outside_wrong(drawn, outside, COUNT(drawn)), 2, 0);
	assert_float_equal(visibility_outside_wrong(outside, outside, COUNT(outside)), 0, 0);
	assert_float_equal(visibility_outside_wrong(drawn + 4, outside + 4, 2), 0, 0);
	assert_true(isnan(visibility_outside_wrong(drawn + 5, outside + 5, 1)));
}

/* A shadow that moves as the true one does not flicker, however wrong it is. */
static void test_flicker_is_what_the_truth_does_not_do(void **state)
{
	(void)state;
	static const float one[] = {0, .5f, 1, NAN}, other[] = {.25f, .5f, .5f, .5f};
	static const float wrong_one[] = {.5f, .125f, .75f, 0},
			   wrong_other[] = {.75f, .125f, .25f, 1};
	static const float still[] = {.5f, .5f, .5f, .5f};
	static const struct {
		struct visibility_pair before, after;
		size_t count;
		double wanted;
	} cases[] = {
		{{one, one}, {other, other}, 4, 0},
		{{wrong_one, one}, {wrong_other, other}, 4, 0},
		{{still, one}, {still, other}, 4, .25}, /* (.25 + 0 + .5) / 3 */
		{{one, still}, {other, still}, 3, .25},
		{{one, one}, {wrong_other, one}, 3, .625}, /* (.75 + .375 + .75) / 3 */
		{{one, one}, {other, other}, 0, 0},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		double found = visibility_flicker(cases[i].before, cases[i].after, cases[i].count);
		if (fabs(found - cases[i].wanted) > CLOSE)
			fail_msg("case %zu: %g, not %g", i, found, cases[i].wanted);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_regions_are_told_apart_by_the_truth),
		cmocka_unit_test(test_regions_without_pixels_are_not_a_number),
		cmocka_unit_test(test_wrong_pixels_outside_penumbrae_are_counted),
		cmocka_unit_test(test_flicker_is_what_the_truth_does_not_do),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
