/* SPDX-License-Identifier: MIT */
/* What is written comes back exactly; what is no results.csv is refused by file and line. */
#include "bench/csv.h"
#include "bench/column.h"
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static bool read_text(struct result_list *list, const char *text, struct sm_error *error)
{
	FILE *file = fmemopen((void *)text, strlen(text), "r");
	assert_non_null(file);
	*list = (struct result_list){0};
	bool read = csv_read(list, file, "results.csv", error);
	fclose(file);
	return read;
}

static void test_rows_come_back_exactly(void **state)
{
	(void)state;
	static const char *const names[] = {"fence", "a,b", "say \"hi\"", "\"", "two\nlines", "",
		" blanks ", "tab\t", "\xc3\xa9t\xc3\xa9"};
	struct result_list list = {0}, back;
	struct text text = {0};
	struct sm_error error;
	for (size_t i = 0; i < COUNT(names); i++) {
		struct result result = make_result(names[i], "pcss-16");
		assert_true(result_list_add(&list, &result, &error));
	}
	csv_write(&list, text_begin(&text));
	assert_true(read_text(&back, text_end(&text), &error));
	assert_int_equal(back.count, list.count);
	for (size_t i = 0; i < list.count; i++)
		assert_memory_equal(&back.items[i], &list.items[i], sizeof(list.items[i]));
	result_list_finish(&back);
	result_list_finish(&list);
	text_finish(&text);
}

static void test_what_is_not_measured_is_empty(void **state)
{
	(void)state;
	struct result_list list = {0}, back;
	struct result result = make_result("fence", "hard");
	struct text text = {0};
	result.flicker = NAN;
	assert_true(result_list_add(&list, &result, NULL));
	csv_write(&list, text_begin(&text));
	assert_non_null(strstr(
		text_end(&text), ",1,100,,1.1,")); /* ...penumbra_max,outside_wrong,flicker,ms */
	assert_true(read_text(&back, text.bytes, NULL));
	assert_true(isnan(back.items[0].flicker));
	result_list_finish(&back);
	result_list_finish(&list);
	text_finish(&text);
}

static void test_numbers_are_as_short_as_exact(void **state)
{
	(void)state;
	static const struct {
		double value;
		const char *text;
	} cases[] = {{0, "0"}, {0.03, "0.03"}, {-0.5, "-0.5"}, {1.0 / 3, "0.3333333333333333"},
		{0.1 + 0.2, "0.30000000000000004"}, {512, "512"}, {100, "100"}, {-20, "-20"},
		{1e100, "1e+100"}, {NAN, ""}};
	for (size_t i = 0; i < COUNT(cases); i++) {
		char text[32];
		column_format_real(cases[i].value, text);
		assert_string_equal(text, cases[i].text);
	}
}

static void test_files_of_other_versions_are_read(void **state)
{
	(void)state;
	static const char *const texts[] = {
		"technique,hue,scene,map\r\nhard,blue,fence,512\r\n",
		"scene,technique,map\nfence,hard,512",
		"\"scene\",\"technique\",\"map\"\n\"fence\",\"hard\",\"512\"\n\n",
		"scene,technique,map,scent,scent\nfence,hard,512,,\n",
	};
	for (size_t i = 0; i < COUNT(texts); i++) {
		struct result_list list;
		assert_true(read_text(&list, texts[i], NULL));
		assert_int_equal(list.count, 1);
		assert_string_equal(list.items[0].scene, "fence");
		assert_string_equal(list.items[0].technique, "hard");
		assert_int_equal(list.items[0].map, 512);
		assert_true(isnan(list.items[0].error[REGION_PENUMBRA].rmse));
		assert_true(isnan(list.items[0].outside_wrong));
		assert_int_equal(list.items[0].peak_bytes, 0);
		result_list_finish(&list);
	}
}

static void test_bad_files_are_refused_by_line(void **state)
{
	(void)state;
	static const struct {
		const char *text, *problem;
	} cases[] = {
		{"\n", "results.csv:1: no column is named \"scene\"; is this a results.csv?"},
		{"scene,map\n", "results.csv:1: no column is named \"technique\"; is this a "
				"results.csv?"},
		{"scene,technique,scene\n", "results.csv:1: two columns are named \"scene\""},
		{"scene,technique\na\n", "results.csv:2: there are fewer values than columns"},
		{"scene,technique\na,b\na,b,c\n",
			"results.csv:3: there are more values than columns"},
		{"scene,technique\n\"a\nb\",c\nd\n",
			"results.csv:4: there are fewer values than columns"},
		{"scene,technique\na,\"b\nc\n", "results.csv:2: a quote is never closed"},
		{"scene,technique\n\"a\"b,c\n", "results.csv:2: text follows a closed quote"},
		{"scene,technique,map\na,b,-1\n",
			"results.csv:2: map \"-1\" is not a whole number"},
		{"scene,technique,map\na,b,\n", "results.csv:2: map \"\" is not a whole number"},
		{"scene,technique,map\na,b,4294967296\n",
			"results.csv:2: map \"4294967296\" is too large"},
		{"scene,technique,peak_bytes\na,b,18446744073709551616\n",
			"results.csv:2: peak_bytes \"18446744073709551616\" is too large"},
		{"scene,technique,ms\na,b,1.5x\n", "results.csv:2: ms \"1.5x\" is not a number"},
		{"scene,technique,ms\na,b, 1\n", "results.csv:2: ms \" 1\" is not a number"},
		{"scene,technique,precision\na,b,12345678901234567\n",
			"results.csv:2: precision \"12345678901234567\" is too long"},
		{"scene,technique,passes\na,b,maps\n",
			"results.csv:2: passes \"maps\" is not NAME=MS;NAME=MS..."},
		{"scene,technique,passes\na,b,a=1;b=x\n",
			"results.csv:2: passes \"a=1;b=x\" is not a number"},
		{"scene,technique,passes\na,b,a=1;b=1;c=1;d=1;e=1;f=1;g=1;h=1;i=1\n",
			"results.csv:2: passes \"a=1;b=1;c=1;d=1;e=1;f=1;g=1;h=1;i=1\" has too "
			"many passes"},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		struct result_list list;
		struct sm_error error;
		assert_false(read_text(&list, cases[i].text, &error));
		assert_string_equal(error.text, cases[i].problem);
		assert_int_equal(error.status, SM_ERROR_INPUT);
		result_list_finish(&list);
	}
}

static void test_what_cannot_be_read_is_the_machines_failure(void **state)
{
	(void)state;
	FILE *folder = fopen("/", "r");
	struct result_list list = {0};
	struct sm_error error;
	assert_non_null(folder);
	assert_false(csv_read(&list, folder, "/", &error));
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_string_equal(error.text, "cannot read / (Is a directory)");
	fclose(folder);
}

static void test_columns_have_names_of_their_own(void **state)
{
	(void)state;
	for (size_t i = 0; column_at(i) != NULL; i++)
		assert_int_equal(column_find(column_at(i)->name), i);
	assert_int_equal(column_find("hue"), SIZE_MAX);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_rows_come_back_exactly),
		cmocka_unit_test(test_what_is_not_measured_is_empty),
		cmocka_unit_test(test_numbers_are_as_short_as_exact),
		cmocka_unit_test(test_files_of_other_versions_are_read),
		cmocka_unit_test(test_bad_files_are_refused_by_line),
		cmocka_unit_test(test_what_cannot_be_read_is_the_machines_failure),
		cmocka_unit_test(test_columns_have_names_of_their_own),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
