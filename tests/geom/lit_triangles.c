/* SPDX-License-Identifier: MIT */
#include "geom/lit_triangles.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define TEXEL 0.01f

typedef float triangle[3][3];

static const float unchanged[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
/* A perspective: w is z, and depth -1 at z = 1. */
static const float perspective[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 1}, {0, 0, -2, 0}};

/* A texel around, and the slope followed over as much. */
static const struct lit_rule plain = {
	.around = TEXEL, .bias = TEXEL, .limit = {50, 0}, .near_to_far = 1};

static void add(
	struct lit_search *search, uint32_t object, const triangle t, const float to_clip[4][4])
{
	static const uint32_t indices[3] = {0, 1, 2};
	assert_true(lit_search_add(search, object, t, 3, indices, 3, to_clip));
}

static bool is_lit(struct lit_search *search, uint32_t object, const triangle t, bool averted,
	const float to_clip[4][4], const struct lit_rule *rule)
{
	size_t visits = 0;
	bool lit = lit_search_is_lit(search, object, t, averted, to_clip, rule, &visits);
	assert_in_range(visits, 1, LIT_VISITS_MAX + 32); /* a look more */
	return lit;
}

/* Anticlockwise as the light sees it, and level. */
static const triangle level = {{0, 0, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}};

static void what_is_in_front_counts(void **state)
{
	static const struct {
		const char *what;
		triangle shape;
		bool lit;
	} cases[] = {
		{"over it, nearer", {{0, 0, -0.1f}, {0.5f, 0, -0.1f}, {0, 0.5f, -0.1f}}, false},
		{"over a corner of it", {{-1, -1, -0.1f}, {0.1f, -1, -0.1f}, {0.1f, 0.1f, -0.1f}},
			false},
		{"over all of it", {{-1, -1, -0.5f}, {1, -1, -0.5f}, {0, 1, -0.5f}}, false},
		{"amid it", {{0.1f, 0.1f, -0.5f}, {0.11f, 0.1f, -0.5f}, {0.1f, 0.11f, -0.5f}},
			false},
		{"through it", {{0, 0, -0.1f}, {0.5f, 0, 0.1f}, {0, 0.5f, 0.1f}}, false},
		{"farther", {{0, 0, 0.1f}, {0.5f, 0, 0.1f}, {0, 0.5f, 0.1f}}, true},
		{"beside it", {{0.6f, 0, -0.1f}, {0.9f, 0, -0.1f}, {0.6f, 0.5f, -0.1f}}, true},
		{"beside it, amid its box",
			{{0.3f, 0.3f, -0.1f}, {0.5f, 0.5f, -0.1f}, {0.3f, 0.5f, -0.1f}}, true},
		{"less than a texel beside it",
			{{-0.3f, 0, -0.1f}, {-0.3f, 0.5f, -0.1f}, {-0.8f * TEXEL, 0, -0.1f}},
			false},
		{"more than a texel beside it",
			{{-0.3f, 0, -0.1f}, {-0.3f, 0.5f, -0.1f}, {-1.2f * TEXEL, 0, -0.1f}}, true},
		{"in front only where it is beside it",
			{{0, 0.2f, 0.1f}, {0.9f, 0.2f, -0.08f}, {0.9f, 0.25f, -0.08f}}, true},
		{"on edge, in front",
			{{0.1f, 0.1f, -0.1f}, {0.1f, 0.1f, -0.5f}, {0.1f, 0.2f, -0.1f}}, false},
	};
	(void)state;
	struct lit_search search = {0};
	for (size_t i = 0; i < COUNT(cases); i++) {
		for (uint32_t other = 0; other < 2; other++) {
			lit_search_clear(&search);
			add(&search, 7, level, unchanged);
			add(&search, 7 + other, cases[i].shape, unchanged);
			assert_true(lit_search_sort(&search));
			if (is_lit(&search, 7, level, false, unchanged, &plain) != cases[i].lit)
				fail_msg("%s, of %s object", cases[i].what,
					other ? "another" : "the same");
		}
	}
	lit_search_finish(&search);
}

/* As a fin, whose other half is beside the receiver. */
static void fins_count(void **state)
{
	(void)state;
	for (int behind = 0; behind < 2; behind++) {
		float z = behind ? 0.1f : -0.1f;
		const float fin[4][3] = {
			{0.1f, 0.1f, z}, {0.1f, -0.1f, z}, {0.2f, -0.1f, z}, {0.2f, 0.1f, z}};
		struct lit_search search = {0};
		add(&search, 0, level, unchanged);
		assert_true(lit_search_add_fin(&search, fin));
		assert_true(lit_search_sort(&search));
		assert_int_equal(is_lit(&search, 0, level, false, unchanged, &plain), behind);
		lit_search_finish(&search);
	}
}

/* Neighbours of one that slopes by 1: across the side at x = 0, whose far corner is at x = -0.5. */
static void bias_makes_up_for_creases(void **state)
{
	static const triangle sloped = {{0, 0, 0}, {0.5f, 0, 0.5f}, {0, 0.5f, 0}};
	static const struct {
		float depth; /* of the far corner */
		bool lit;
	} cases[] = {
		{-0.5f, true},  /* level with it */
		{0.5f, true},   /* convex */
		{-0.45f, true}, /* nearly level, convex */
		{-0.6f, false}, /* concave, steeper than it is */
		{-5, false},
	};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		const triangle neighbour = {{0, 0, 0}, {0, 0.5f, 0}, {-0.5f, 0, cases[i].depth}};
		struct lit_search search = {0};
		add(&search, 0, sloped, unchanged);
		add(&search, 0, neighbour, unchanged);
		assert_true(lit_search_sort(&search));
		if (is_lit(&search, 0, sloped, false, unchanged, &plain) != cases[i].lit)
			fail_msg("%g", (double)cases[i].depth);
		lit_search_finish(&search);
	}
}

/* A fin at the depth of the receiver's farther side goes on beside it, before the plane that leads
 * away from the light there. */
static void bias_makes_up_for_own_fins(void **state)
{
	static const triangle sloped = {{0, 0, 0}, {0.5f, 0, 0.5f}, {0.5f, 0.5f, 0.5f}};
	static const float fin[4][3] = {
		{0.5f, 0, 0.5f}, {0.5f, 0.5f, 0.5f}, {0.7f, 0.5f, 0.5f}, {0.7f, 0, 0.5f}};
	(void)state;
	struct lit_search search = {0};
	add(&search, 0, sloped, unchanged);
	assert_true(lit_search_add_fin(&search, fin));
	assert_true(lit_search_sort(&search));
	assert_true(is_lit(&search, 0, sloped, false, unchanged, &plain));
	struct lit_rule wide = plain;
	wide.around = 0.1;
	wide.bias = -0.1;
	assert_true(is_lit(&search, 0, level, false, unchanged, &plain));
	assert_false(is_lit(&search, 0, sloped, false, unchanged, &wide));
	lit_search_finish(&search);
}

static void slopes_that_bias_does_not_follow_are_not_lit(void **state)
{
	static const struct {
		triangle receiver;
		double limit[2];
		bool lit;
	} cases[] = {
		{{{0, 0, 0}, {0.1f, 0, 0.5f}, {0, 0.1f, 0}}, {6, 0}, true},
		{{{0, 0, 0}, {0.1f, 0, 0.5f}, {0, 0.1f, 0}}, {5, 0}, false},
		{{{0, 0, 0}, {0.1f, 0, 0.25f}, {0, 0.1f, 0.25f}}, {5, 0}, false},
		/* The limit falls with depth: 6.4 at the farthest corner, 4.8 if that were at 1. */
		{{{0, 0, 0}, {0.1f, 0, 0.5f}, {0, 0.1f, 0}}, {11, -6}, true},
		{{{0, 0, 0}, {0.1f, 0, 0.5f}, {0, 0.1f, 0}}, {11, -8}, false},
		{{{0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0.1f}}, {50, 0}, false}, /* on edge */
	};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct lit_search search = {0};
		struct lit_rule rule = plain;
		memcpy(rule.limit, cases[i].limit, sizeof(rule.limit));
		add(&search, 0, cases[i].receiver, unchanged);
		assert_true(lit_search_sort(&search));
		if (is_lit(&search, 0, cases[i].receiver, false, unchanged, &rule) != cases[i].lit)
			fail_msg("%zu", i);
		lit_search_finish(&search);
	}
}

/* Which of two surfaces at one depth is drawn first shows, within an object. */
static void what_touches_counts(void **state)
{
	static const struct {
		const char *what;
		triangle shape;
		bool touches;
	} cases[] = {
		{"the same again", {{0, 0, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}}, true},
		{"its back", {{0, 0, 0}, {0, 0.5f, 0}, {0.5f, 0, 0}}, true},
		{"a part of it", {{0.1f, 0.1f, 0}, {0.2f, 0.1f, 0}, {0.1f, 0.2f, 0}}, true},
		{"a little farther",
			{{0.1f, 0.1f, 1e-4f}, {0.2f, 0.1f, 1e-4f}, {0.1f, 0.2f, 1e-4f}}, true},
		{"well farther", {{0.1f, 0.1f, 0.01f}, {0.2f, 0.1f, 0.01f}, {0.1f, 0.2f, 0.01f}},
			false},
		{"from behind, with a corner", {{0.1f, 0.1f, 0}, {0.2f, 0.1f, 1}, {0.1f, 0.2f, 1}},
			true},
		{"along half a side", {{0, 0.1f, 0}, {0, 0.4f, 0}, {-0.5f, 0.1f, 0.2f}}, true},
		{"along half a side, but for rounding",
			{{-1e-5f, 0.1f, 0}, {-1e-5f, 0.4f, 0}, {-0.5f, 0.1f, 0.2f}}, true},
		{"beside half a side", {{-1e-3f, 0.1f, 0}, {-1e-3f, 0.4f, 0}, {-0.5f, 0.1f, 0.2f}},
			false},
		{"a neighbour", {{0.5f, 0, 0}, {0, 0, 0}, {0, -0.5f, 0.2f}}, false},
		{"a neighbour in its plane", {{0.5f, 0, 0}, {0, 0, 0}, {0, -0.5f, 0}}, false},
		{"a neighbour that is turned", {{0, 0, 0}, {0.5f, 0, 0}, {0, -0.5f, 0.2f}}, true},
		{"a neighbour that is folded over it", {{0.5f, 0, 0}, {0, 0, 0}, {0.1f, 0.2f, 0}},
			true},
		{"a neighbour behind it", {{0.5f, 0, 0}, {0, 0, 0}, {0.1f, 0.2f, 0.2f}}, false},
		{"with a corner at a corner", {{0, 0, 0}, {-0.5f, 0, 0.2f}, {0, -0.5f, 0.2f}},
			false},
	};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		for (int averted = 0; averted < 2; averted++) {
			struct lit_search search = {0};
			add(&search, 7, level, unchanged);
			add(&search, 7, cases[i].shape, unchanged);
			assert_true(lit_search_sort(&search));
			if (is_lit(&search, 7, level, averted, unchanged, &plain) ==
				cases[i].touches)
				fail_msg("%s%s", cases[i].what, averted ? ", averted" : "");
			lit_search_finish(&search);
			/* Of another object it does not matter. */
			add(&search, 7, level, unchanged);
			add(&search, 8, cases[i].shape, unchanged);
			assert_true(lit_search_sort(&search));
			assert_true(is_lit(&search, 7, level, averted, unchanged, &plain));
			lit_search_finish(&search);
		}
	}
}

static void nothing_is_in_front_of_what_is_averted(void **state)
{
	static const triangle roof = {{-1, -1, -0.5f}, {1, -1, -0.5f}, {0, 1, -0.5f}};
	static const triangle blade = {
		{0.1f, 0.1f, -0.5f}, {0.2f, 0.1f, -0.5f}, {0.1f, 0.1f, 0.5f}};
	static const triangle steep = {{0, 0, 0}, {0.1f, 0, 9}, {0, 0.1f, 0}};
	(void)state;
	struct lit_search search = {0};
	add(&search, 0, level, unchanged);
	add(&search, 0, roof, unchanged);
	assert_true(lit_search_sort(&search));
	assert_true(is_lit(&search, 0, level, true, unchanged, &plain));
	assert_true(is_lit(&search, 0, steep, true, unchanged, &plain));
	add(&search, 0, blade, unchanged);
	assert_true(lit_search_sort(&search));
	assert_false(is_lit(&search, 0, level, true, unchanged, &plain));
	lit_search_finish(&search);
}

/* Places are x / z, y / z; the receiver is at z = 4. */
static void what_reaches_behind_the_eye_counts(void **state)
{
	static const triangle receiver = {{0, 0, 4}, {1, 0, 4}, {0, 1, 4}};
	static const struct {
		const char *what;
		triangle shape;
		bool lit;
	} cases[] = {
		{"from behind the eye, in front", {{0, 0, 2}, {1, 0, 2}, {0, 0, -2}}, false},
		{"from behind the eye, a floor below all", {{0, -9, 9}, {9, -9, 9}, {0, -9, -9}},
			false},
		{"as a whole behind the eye", {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, true},
		{"farther", {{0, 0, 5}, {5, 0, 5}, {0, 5, 5}}, true},
		{"nearer", {{0, 0, 3}, {3, 0, 3}, {0, 3, 3}}, false},
		{"nearer, beside the screen", {{9, 0, 3}, {12, 0, 3}, {9, 3, 3}}, true},
		{"nearer, over the screen and beyond any number",
			{{-3e38f, -1, 1e-3f}, {3e38f, -1, 1e-3f}, {0, 3e38f, 1e-3f}}, false},
	};
	(void)state;
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct lit_search search = {0};
		struct lit_rule rule = plain;
		rule.near_to_far = 0.01;
		add(&search, 0, receiver, perspective);
		add(&search, 1, cases[i].shape, perspective);
		assert_true(lit_search_sort(&search));
		if (is_lit(&search, 0, receiver, false, perspective, &rule) != cases[i].lit)
			fail_msg("%s", cases[i].what);
		lit_search_finish(&search);
	}
	struct lit_search empty = {0};
	const triangle around = {{0, 0, 4}, {1, 0, 4}, {0, 1, -4}};
	assert_true(lit_search_sort(&empty));
	assert_false(is_lit(&empty, 0, around, false, perspective, &plain));
	lit_search_finish(&empty);
}

/* All beside it, and amid its box. */
static void among_too_many_nothing_is_lit(void **state)
{
	static const triangle wide = {{0.9f, 0.9f, 0}, {-0.8f, 0.9f, 0}, {0.9f, -0.8f, 0}};
	static const triangle small = {{0.8f, 0.8f, 0}, {0.81f, 0.8f, 0}, {0.8f, 0.81f, 0}};
	(void)state;
	struct lit_search search = {0};
	for (uint32_t i = 1; i <= 20000; i++) {
		float x = 0.007f * (float)(i % 100) - 0.75f, y = 0.0035f * (float)(i / 100) - 0.75f;
		const triangle beside = {
			{x, y, -0.5f}, {x + 0.001f, y, -0.5f}, {x, y + 0.001f, -0.5f}};
		add(&search, i, beside, unchanged);
		if (i % 1000 != 0)
			continue;
		assert_true(lit_search_sort(&search));
		if (i == 1000 || i == 20000)
			assert_int_equal(
				is_lit(&search, 0, wide, false, unchanged, &plain), i == 1000);
		assert_true(is_lit(&search, 0, small, false, unchanged, &plain));
	}
	lit_search_finish(&search);
}

#define SOUPS 60
#define SOUP 24
#define SAMPLES 400

/* xorshift (Marsaglia 2003). */
static float between(uint32_t *random, float low, float high)
{
	*random ^= *random << 13;
	*random ^= *random >> 17;
	*random ^= *random << 5;
	return low + (high - low) * (float)(*random >> 8) / (float)(1 << 24);
}

/* Where a triangle is at a place, as depth; false: nowhere. */
static bool depth_at(const triangle t, double x, double y, double *depth)
{
	double w[3], area = 0;
	for (int i = 0; i < 3; i++) {
		const float *a = t[(i + 1) % 3], *b = t[(i + 2) % 3];
		w[i] = (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
		area += w[i];
	}
	*depth = 0;
	for (int i = 0; i < 3; i++) {
		if (w[i] * area <= 0)
			return false;
		*depth += w[i] / area * t[i][2];
	}
	return true;
}

static double slope_of(const triangle t)
{
	double u[3], v[3];
	for (int axis = 0; axis < 3; axis++) {
		u[axis] = t[1][axis] - t[0][axis];
		v[axis] = t[2][axis] - t[0][axis];
	}
	double area = u[0] * v[1] - u[1] * v[0];
	return (fabs(u[2] * v[1] - u[1] * v[2]) + fabs(u[0] * v[2] - u[2] * v[0])) / fabs(area);
}

/* Of what is lit, no look-up around any of its points finds anything in front of the biased one. */
static void check_soup(struct lit_search *search, const triangle *soup, uint32_t *random,
	size_t *lit, size_t *found)
{
	for (size_t i = 0; i < SOUP; i++) {
		if (!is_lit(search, (uint32_t)i, soup[i], false, unchanged, &plain))
			continue;
		++*lit;
		double biased = slope_of(soup[i]) * plain.bias + 1e-6;
		for (int sample = 0; sample < SAMPLES; sample++) {
			float a = between(random, 0, 1), b = between(random, 0, 1 - a);
			double p[3], depth;
			for (int axis = 0; axis < 3; axis++)
				p[axis] = soup[i][0][axis] +
					  a * (soup[i][1][axis] - soup[i][0][axis]) +
					  b * (soup[i][2][axis] - soup[i][0][axis]);
			double x = p[0] + between(random, -TEXEL, TEXEL);
			double y = p[1] + between(random, -TEXEL, TEXEL);
			for (size_t j = 0; j < SOUP; j++) {
				if (j == i || !depth_at(soup[j], x, y, &depth))
					continue;
				++*found;
				assert_true(depth >= p[2] - biased);
			}
		}
	}
}

static void what_is_lit_has_nothing_in_front(void **state)
{
	uint32_t random = 0x2545f491;
	size_t lit = 0, found = 0;
	(void)state;
	for (int i = 0; i < SOUPS; i++) {
		struct lit_search search = {0};
		triangle soup[SOUP];
		for (uint32_t j = 0; j < SOUP; j++) {
			float x = between(&random, -1.1f, 0.9f), y = between(&random, -1.1f, 0.9f);
			for (int corner = 0; corner < 3; corner++) {
				soup[j][corner][0] = x + between(&random, 0, 0.4f);
				soup[j][corner][1] = y + between(&random, 0, 0.4f);
				soup[j][corner][2] = between(&random, -0.5f, 0.5f);
			}
			add(&search, j, soup[j], unchanged);
		}
		assert_true(lit_search_sort(&search));
		check_soup(&search, (const triangle *)soup, &random, &lit, &found);
		lit_search_finish(&search);
	}
	print_message("%zu lit, %zu shapes found around them\n", lit, found);
	assert_true(lit > SOUPS && found > 1000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_is_in_front_counts),
		cmocka_unit_test(fins_count),
		cmocka_unit_test(bias_makes_up_for_creases),
		cmocka_unit_test(bias_makes_up_for_own_fins),
		cmocka_unit_test(slopes_that_bias_does_not_follow_are_not_lit),
		cmocka_unit_test(what_touches_counts),
		cmocka_unit_test(nothing_is_in_front_of_what_is_averted),
		cmocka_unit_test(what_reaches_behind_the_eye_counts),
		cmocka_unit_test(among_too_many_nothing_is_lit),
		cmocka_unit_test(what_is_lit_has_nothing_in_front),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
