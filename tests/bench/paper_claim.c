/* SPDX-License-Identifier: MIT */
#include "bench/paper_claim.h"
#include "paper_results.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Changes of numbers with which all claims hold. */

static void slow_in_one_scene(struct paper_result *result)
{
	result->scenes[0].ms[PAPER_SMOOTHIE][2] = 51;
}

static void faster_than_hard(struct paper_result *result)
{
	for (size_t i = 0; i < result->scene_count; i++)
		for (int map = 0; map < PAPER_MAPS; map++)
			result->scenes[i].ms[PAPER_SMOOTHIE][map] = 9;
}

static void faster_than_hard_once(struct paper_result *result)
{
	result->scenes[1].ms[PAPER_SMOOTHIE][0] = 9;
}

static void slower_than_bicubic(struct paper_result *result)
{
	for (size_t i = 0; i < result->scene_count; i++)
		for (int map = 0; map < PAPER_MAPS; map++)
			result->scenes[i].ms[PAPER_BICUBIC][map] = 9;
}

static void no_bicubic(struct paper_result *result)
{
	for (size_t i = 0; i < result->scene_count; i++)
		for (int map = 0; map < PAPER_MAPS; map++)
			result->scenes[i].ms[PAPER_BICUBIC][map] = NAN;
}

static void wide_is_slow(struct paper_result *result)
{
	for (size_t i = 0; i < result->scene_count; i++)
		result->scenes[i].width_ms[3] = 11.6;
}

static void middling_is_slow_once(struct paper_result *result)
{
	result->scenes[2].width_ms[1] = 20;
}

static void time_goes_with_triangles(struct paper_result *result)
{
	for (size_t i = 0; i < result->scene_count; i++) {
		double extra = (double)result->scenes[i].triangles / 10000;
		result->scenes[i].ms[PAPER_SMOOTHIE][2] = 10 + extra;
		result->scenes[i].penumbra_map_ms = 10 + extra;
	}
}

static void few_maps_are_cheap(struct paper_result *result)
{
	for (size_t i = 0; i < result->scene_count; i++)
		result->scenes[i].many_maps_ms = 15;
}

static void aliased(struct paper_result *result)
{
	for (size_t i = 0; i < result->scene_count; i++)
		result->scenes[i].aliasing.smoothie = .021;
}

static void pops_once(struct paper_result *result)
{
	result->scenes[3].popping.smoothie = .021;
}

static void one_without_fins(struct paper_result *result)
{
	result->scenes[0].fins = 0;
}

static void hard_is_nearer(struct paper_result *result)
{
	result->hard.rmse = .2;
}

static void linear_is_nearer(struct paper_result *result)
{
	result->linear.rmse = .2;
}

static void twelve_bits_are_far(struct paper_result *result)
{
	result->fixed12.error.rmse = .233;
}

static void twelve_bits_show(struct paper_result *result)
{
	result->fixed12.difference = .002;
}

static void twelve_bits_are_far_and_show(struct paper_result *result)
{
	twelve_bits_are_far(result);
	twelve_bits_show(result);
}

static void time_is_square(struct paper_result *result)
{
	for (size_t i = 0; i < result->mesh_count; i++)
		result->meshes[i].ms =
			(double)result->meshes[i].edges * (double)result->meshes[i].edges * 1e-6;
}

static void debris_is_square(struct paper_result *result)
{
	for (size_t i = 4; i < result->mesh_count; i++)
		result->meshes[i].ms =
			(double)result->meshes[i].edges * (double)result->meshes[i].edges * 1e-6;
}

/* What a frame costs at least is no matter of edges. */
static void least_mesh_is_slow(struct paper_result *result)
{
	result->meshes[0].ms = 100;
}

static void buffers_cost_much_everywhere(struct paper_result *result)
{
	for (size_t i = 0; i < result->size_count; i++)
		result->sizes[i].buffers = 9;
}

static void fine_snaps_as_much(struct paper_result *result)
{
	result->snapping_fine = 4;
}

static void fine_snaps_nearly_as_much(struct paper_result *result)
{
	result->snapping_fine = 3;
}

static void thick_is_nearer(struct paper_result *result)
{
	result->thick.rmse = .1;
}

static void thick_is_brighter(struct paper_result *result)
{
	result->thick.bias = .1;
}

static const struct {
	void (*change)(struct paper_result *result);
	const char *claim; /* how it begins */
	enum verdict verdict;
} cases[] = {
	{slow_in_one_scene, "Smoothies are drawn in real time", VERDICT_PARTLY},
	{faster_than_hard, "They cost more than the shadow map", VERDICT_FAILS},
	{faster_than_hard_once, "They cost more than the shadow map", VERDICT_PARTLY},
	{slower_than_bicubic, "They are faster than bicubic", VERDICT_FAILS},
	{no_bicubic, "They are faster than bicubic", VERDICT_UNMEASURED},
	{wide_is_slow, "The width t costs little", VERDICT_FAILS},
	{middling_is_slow_once, "The width t costs little", VERDICT_PARTLY},
	{time_goes_with_triangles, "What they cost goes with the silhouette", VERDICT_FAILS},
	{few_maps_are_cheap, "They do without the cost of sampling", VERDICT_FAILS},
	{aliased, "Their soft edges hide the aliasing", VERDICT_FAILS},
	{pops_once, "They move smoothly", VERDICT_PARTLY},
	{one_without_fins, "Any edge-manifold mesh", VERDICT_PARTLY},
	{hard_is_nearer, "Their shadows look like soft ones", VERDICT_FAILS},
	{linear_is_nearer, "A sinusoid looks better", VERDICT_FAILS},
	{twelve_bits_are_far, "Fixed point of 12 bits", VERDICT_PARTLY},
	{twelve_bits_show, "Fixed point of 12 bits", VERDICT_PARTLY},
	{twelve_bits_are_far_and_show, "Fixed point of 12 bits", VERDICT_FAILS},
	{time_is_square, "The time for silhouettes and fins is linear", VERDICT_FAILS},
	{debris_is_square, "The time for silhouettes and fins is linear", VERDICT_PARTLY},
	{least_mesh_is_slow, "The time for silhouettes and fins is linear", VERDICT_HOLDS},
	{buffers_cost_much_everywhere, "Smoothie buffers add little", VERDICT_PARTLY},
	{fine_snaps_as_much, "Thick smoothies of meshes with few", VERDICT_FAILS},
	{fine_snaps_nearly_as_much, "Thick smoothies of meshes with few", VERDICT_PARTLY},
	{thick_is_nearer, "Before small openings", VERDICT_FAILS},
	{thick_is_brighter, "Before small openings", VERDICT_FAILS},
};

static bool begins(const char *text, const char *start)
{
	return strncmp(text, start, strlen(start)) == 0;
}

static void without_numbers_nothing_is_judged(void **state)
{
	struct paper_result nothing = paper_nothing();
	struct paper_claim claims[PAPER_CLAIMS_MAX];
	size_t count = paper_claims_judge(&nothing, claims);
	(void)state;
	assert_true(count > 10);
	for (size_t i = 0; i < count; i++) {
		assert_int_equal(claims[i].verdict, VERDICT_UNMEASURED);
		assert_true(claims[i].evidence[0] != '\0');
	}
}

static void ideal_numbers_let_each_claim_hold(void **state)
{
	struct paper_result ideal = paper_ideal();
	struct paper_claim claims[PAPER_CLAIMS_MAX];
	size_t count = paper_claims_judge(&ideal, claims);
	(void)state;
	for (size_t i = 0; i < count; i++)
		if (claims[i].verdict != VERDICT_HOLDS)
			fail_msg("%s %s: %s", claims[i].text, verdict_name(claims[i].verdict),
				claims[i].evidence);
}

static void each_change_of_a_number_tells(void **state)
{
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct paper_result result = paper_ideal();
		struct paper_claim claims[PAPER_CLAIMS_MAX];
		cases[i].change(&result);
		size_t count = paper_claims_judge(&result, claims), found = 0;
		for (size_t k = 0; k < count; k++) {
			if (!begins(claims[k].text, cases[i].claim))
				continue;
			found++;
			if (claims[k].verdict != cases[i].verdict)
				fail_msg("case %zu: %s %s: %s", i, claims[k].text,
					verdict_name(claims[k].verdict), claims[k].evidence);
		}
		assert_true(found > 0);
	}
}

static void the_numbers_stand_beside_the_verdict(void **state)
{
	struct paper_result ideal = paper_ideal();
	struct paper_claim claims[PAPER_CLAIMS_MAX];
	size_t count = paper_claims_judge(&ideal, claims);
	(void)state;
	for (size_t i = 0; i < count; i++)
		if (begins(claims[i].text, "They are faster than bicubic"))
			assert_string_equal(claims[i].evidence,
				"bicubic / smoothie 1.43 to 1.82, median 1.6; above 1 in 12 of "
				"12");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(without_numbers_nothing_is_judged),
		cmocka_unit_test(ideal_numbers_let_each_claim_hold),
		cmocka_unit_test(each_change_of_a_number_tells),
		cmocka_unit_test(the_numbers_stand_beside_the_verdict),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
