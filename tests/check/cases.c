/* SPDX-License-Identifier: MIT */
/* The list of all cases: named once each, as baselines and reports take names. */
#include "check/cases.h"
#include "check/context.h"
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <string.h>

static int make_list(void **state)
{
	static struct check_list list;
	check_cases_build(&list);
	*state = &list;
	return list.failed ? -1 : 0;
}

static int finish_list(void **state)
{
	check_list_finish(*state);
	return 0;
}

static void test_names_are_unique(void **state)
{
	const struct check_list *list = *state;
	for (size_t i = 0; i < list->count; i++)
		for (size_t j = 0; j < i; j++)
			if (strcmp(list->items[i].name, list->items[j].name) == 0)
				fail_msg("%s stands twice", list->items[i].name);
}

static void test_names_are_well_formed(void **state)
{
	static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789._=-";
	const struct check_list *list = *state;
	for (size_t i = 0; i < list->count; i++) {
		const char *name = list->items[i].name;
		assert_non_null(strchr(name, '.'));
		assert_true(strlen(name) < CHECK_NAME_SIZE - 1);
		assert_int_equal(strspn(name, letters), strlen(name));
	}
}

static void test_there_are_many(void **state)
{
	const struct check_list *list = *state;
	assert_true(list->count >= 300);
}

static void test_drivers_are_told_apart(void **state)
{
	static const struct {
		const char *renderer, *class;
	} rows[] = {
		{"llvmpipe (LLVM 15.0.6, 256 bits)", "llvmpipe"},
		{"softpipe", "softpipe"},
		{"zink (llvmpipe (LLVM 15.0.6, 256 bits))", "zink"},
		{"ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (LLVM 10.0.0) (0x0000C0DE)))",
			"swiftshader"},
		{"V3D 4.2", "hardware"},
		{"", "hardware"},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		assert_string_equal(
			check_class_name(check_class_find(rows[i].renderer)), rows[i].class);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_names_are_unique),
		cmocka_unit_test(test_names_are_well_formed),
		cmocka_unit_test(test_there_are_many),
		cmocka_unit_test(test_drivers_are_told_apart),
	};
	return cmocka_run_group_tests(tests, make_list, finish_list);
}
