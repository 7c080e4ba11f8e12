/* SPDX-License-Identifier: MIT */
/* Lists of cases: what GLOBs choose, and how fractions share them out. */
#include "check/case.h"
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <string.h>

static void run(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	(void)item;
	(void)context;
	result->status = CHECK_PASS;
}

static const char *const names[] = {
	"clip.far", "clip.near", "format.rg16f.min", "format.rg16f.rounding", "format.rgba8.min"};
#define COUNT (sizeof(names) / sizeof(names[0]))

static struct check_list make_list(void)
{
	struct check_list list = {0};
	for (size_t i = 0; i < COUNT; i++)
		assert_non_null(check_list_add(&list, run, NULL, "%s", names[i]));
	return list;
}

static void test_globs(void **state)
{
	static const struct {
		const char *globs[3];
		const char *chosen; /* a digit a case */
	} rows[] = {
		{{NULL}, "01234"},
		{{"clip.near"}, "1"},
		{{"clip.*"}, "01"},
		{{"*.min"}, "24"},
		{{"format.rg16f.*", "clip.*"}, "0123"},
		{{"*.min", "*.rg16f.*", "clip.f?r"}, "0234"},
		{{"*[!n]"}, "013"},
	};
	(void)state;
	for (size_t row = 0; row < sizeof(rows) / sizeof(rows[0]); row++) {
		struct check_list list = make_list();
		size_t count = 0;
		while (count < 3 && rows[row].globs[count] != NULL)
			count++;
		assert_true(check_list_select(&list, rows[row].globs, count, NULL));
		assert_int_equal(list.count, strlen(rows[row].chosen));
		for (size_t i = 0; i < list.count; i++)
			assert_string_equal(list.items[i].name, names[rows[row].chosen[i] - '0']);
		check_list_finish(&list);
	}
}

static void test_unknown_globs(void **state)
{
	static const char *const globs[] = {"clip.*", "clip"};
	struct check_list list = make_list();
	struct sm_error error = {0};
	(void)state;
	assert_false(check_list_select(&list, globs, 2, &error));
	assert_int_equal(error.status, SM_ERROR_INPUT);
	assert_non_null(strstr(error.text, "--test clip: "));
	assert_int_equal(list.count, COUNT);
	check_list_finish(&list);
}

static size_t index_of(const char *name)
{
	size_t i = 0;
	while (strcmp(names[i], name) != 0)
		i++;
	return i;
}

/* Each case is in one of the fractions, and in one only. */
static void test_fractions(void **state)
{
	(void)state;
	for (uint32_t fraction = 1; fraction <= COUNT + 2; fraction++) {
		uint32_t seen[COUNT] = {0};
		for (uint32_t start = 1; start <= fraction; start++) {
			struct check_list list = make_list();
			check_list_take_fraction(&list, fraction, start);
			for (size_t i = 0; i < list.count; i++) {
				size_t index = index_of(list.items[i].name);
				assert_int_equal(index % fraction, start - 1);
				seen[index]++;
			}
			check_list_finish(&list);
		}
		for (size_t i = 0; i < COUNT; i++)
			assert_int_equal(seen[i], 1);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_globs),
		cmocka_unit_test(test_unknown_globs),
		cmocka_unit_test(test_fractions),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
