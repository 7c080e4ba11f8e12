/* SPDX-License-Identifier: MIT */
/* The small texts that the program reads and writes: numbers, sizes, names of frames, facts. */
#include "app/facts.h"
#include "app/options.h"
#include "app/sequence.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static void test_numbers(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		bool valid;
		uint32_t value;
	} cases[] = {
		{"5", true, 5},
		{"005", true, 5},
		{"4294967294", true, UINT32_MAX - 1},
		{"4294967295", false, 0},
		{"18446744073709551621", false, 0},
		{"4", false, 0},
		{"", false, 0},
		{"-5", false, 0},
		{"+5", false, 0},
		{" 5", false, 0},
		{"5 ", false, 0},
		{"5.0", false, 0},
		{"0x5", false, 0},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		uint32_t value;
		bool valid = options_number(cases[i].text, 5, UINT32_MAX - 1, &value);
		if (valid != cases[i].valid || (valid && value != cases[i].value))
			fail_msg("\"%s\"", cases[i].text);
	}
}

static void test_reals(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		bool valid;
		double value;
	} cases[] = {
		{".03", true, .03},
		{"3e-2", true, .03},
		{"0", true, 0},
		{"-0.0", true, 0},
		{"10", true, 10},
		{"10.001", false, 0},
		{"-1", false, 0},
		{"", false, 0},
		{".", false, 0},
		{" 1", false, 0},
		{"1 ", false, 0},
		{"1x", false, 0},
		{"0x1", false, 0},
		{"nan", false, 0},
		{"inf", false, 0},
		{"1e999", false, 0},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		double value;
		bool valid = options_real(cases[i].text, 0, 10, &value);
		if (valid != cases[i].valid || (valid && value != cases[i].value))
			fail_msg("\"%s\"", cases[i].text);
	}
}

static void test_ranges(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		bool valid;
		uint32_t first, last;
	} cases[] = {
		{"1", true, 1, 1},
		{"12", true, 1, 12},
		{"3:5", true, 3, 5},
		{"12:12", true, 12, 12},
		{"0", false, 0, 0},
		{"13", false, 0, 0},
		{"0:5", false, 0, 0},
		{"5:3", false, 0, 0},
		{"5:13", false, 0, 0},
		{"13:13", false, 0, 0},
		{":5", false, 0, 0},
		{"5:", false, 0, 0},
		{"1:2:3", false, 0, 0},
		{"-1:2", false, 0, 0},
		{"1: 2", false, 0, 0},
		{"", false, 0, 0},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		uint32_t first, last;
		bool valid = options_range(cases[i].text, 12, &first, &last);
		if (valid != cases[i].valid ||
			(valid && (first != cases[i].first || last != cases[i].last)))
			fail_msg("\"%s\"", cases[i].text);
	}
}

static void test_rates(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		bool valid;
		uint32_t numerator, denominator;
	} cases[] = {
		{"25", true, 25, 1},
		{"60000/1001", true, 60000, 1001},
		{"1000", true, 1000, 1},
		{"1/1000", true, 1, 1000},
		{"2147483647/2147483647", true, INT32_MAX, INT32_MAX},
		{"1001", false, 0, 0},
		{"1/1001", false, 0, 0},
		{"2147483647/2147483", false, 0, 0},
		{"2147483648/2147483647", false, 0, 0},
		{"25/2147483648", false, 0, 0},
		{"0", false, 0, 0},
		{"0/1", false, 0, 0},
		{"1/0", false, 0, 0},
		{"0/0", false, 0, 0},
		{"25/", false, 0, 0},
		{"/25", false, 0, 0},
		{"25/1/1", false, 0, 0},
		{"29.97", false, 0, 0},
		{"-25", false, 0, 0},
		{"", false, 0, 0},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		uint32_t numerator, denominator;
		bool valid = options_rate(cases[i].text, &numerator, &denominator);
		if (valid != cases[i].valid ||
			(valid && (numerator != cases[i].numerator ||
					  denominator != cases[i].denominator)))
			fail_msg("\"%s\"", cases[i].text);
	}
}

static void test_sizes(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		bool valid;
		uint32_t width, height;
	} cases[] = {
		{"1x1", true, 1, 1},
		{"1280x960", true, 1280, 960},
		{"2147483647x2", true, INT32_MAX, 2},
		{"2147483648x2", false, 0, 0},
		{"0x2", false, 0, 0},
		{"2x0", false, 0, 0},
		{"x2", false, 0, 0},
		{"2x", false, 0, 0},
		{"2", false, 0, 0},
		{"2X2", false, 0, 0},
		{"2x2x2", false, 0, 0},
		{"2 x 2", false, 0, 0},
		{"", false, 0, 0},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		uint32_t width, height;
		bool valid = options_size(cases[i].text, &width, &height);
		if (valid != cases[i].valid ||
			(valid && (width != cases[i].width || height != cases[i].height)))
			fail_msg("\"%s\"", cases[i].text);
	}
}

static void test_frame_names(void **state)
{
	(void)state;
	static const struct {
		const char *pattern;
		uint32_t number;
		const char *path;
	} cases[] = {
		{"out.png", 1, "out-0001.png"},
		{"out.png", 12345, "out-12345.png"},
		{"out", 7, "out-0007"},
		{"a.b/out", 7, "a.b/out-0007"},
		{"a.b/out.x.png", 7, "a.b/out.x-0007.png"},
		{".hidden", 7, ".hidden-0007"},
		{"a/.hidden", 7, "a/.hidden-0007"},
		{"f%04d.png", 3, "f0003.png"},
		{"f%d", 3, "f3"},
		{"%02d/out.png", 3, "03/out.png"},
		{"f%s.png", 3, "f%s-0003.png"},
		{"f%n.png", 3, "f%n-0003.png"},
		{"f%d%d.png", 3, "f%d%d-0003.png"},
		{"f%%d.png", 3, "f%%d-0003.png"},
		{"f%4d.png", 3, "f%4d-0003.png"},
		{"f%00d.png", 3, "f%00d-0003.png"},
		{"f%0123d.png", 3, "f%0123d-0003.png"},
		{"f%04x.png", 3, "f%04x-0003.png"},
		{"f%", 3, "f%-0003"},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		char path[64];
		assert_true(sequence_path(cases[i].pattern, cases[i].number, path, sizeof(path)));
		assert_string_equal(path, cases[i].path);
	}
	char path[12];
	assert_false(sequence_path("out.png", 1, path, sizeof(path)));
	assert_true(sequence_path("out.pn", 1, path, sizeof(path)));
}

static char *print_facts(bool json)
{
	char *text = NULL;
	size_t size;
	FILE *file = open_memstream(&text, &size);
	struct facts facts;
	facts_begin(&facts, file, json);
	facts_add(&facts, "driver", "a \"b\" \\ c\td");
	facts_format(&facts, "edges", "%d", -12);
	facts_sink(&facts, "bytes", "2.9");
	facts_add(&facts, "version", "0.1.0");
	facts_add(&facts, "odd", "007");
	facts_add(&facts, "point", "3.");
	facts_add(&facts, "empty", "");
	facts_add(&facts, "dash", "-");
	facts_end(&facts);
	fclose(file);
	return text;
}

static void test_facts_as_lines(void **state)
{
	(void)state;
	char *text = print_facts(false);
	assert_string_equal(text,
		"driver: a \"b\" \\ c\td\nedges: -12\nbytes: 2.9\nversion: 0.1.0\n"
		"odd: 007\npoint: 3.\nempty: \ndash: -\n");
	free(text);
}

static void test_facts_as_json(void **state)
{
	(void)state;
	char *text = print_facts(true);
	assert_string_equal(text, "{\n  \"driver\": \"a \\\"b\\\" \\\\ c\\u0009d\",\n"
				  "  \"edges\": -12,\n  \"bytes\": 2.9,\n"
				  "  \"version\": \"0.1.0\",\n  \"odd\": \"007\",\n"
				  "  \"point\": \"3.\",\n  \"empty\": \"\",\n"
				  "  \"dash\": \"-\"\n}\n");
	free(text);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_numbers),
		cmocka_unit_test(test_reals),
		cmocka_unit_test(test_ranges),
		cmocka_unit_test(test_rates),
		cmocka_unit_test(test_sizes),
		cmocka_unit_test(test_frame_names),
		cmocka_unit_test(test_facts_as_lines),
		cmocka_unit_test(test_facts_as_json),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
