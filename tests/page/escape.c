/* SPDX-License-Identifier: MIT */
/* Any text is content of HTML and XML, any text is a field of CSV, and bytes are a data: URI. */
#include "page/escape.h"
#include "page/page.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static void assert_writes(
	void (*write)(const char *text, FILE *file), const char *text, const char *expected)
{
	char *bytes = NULL;
	size_t size;
	FILE *file = open_memstream(&bytes, &size);
	assert_non_null(file);
	write(text, file);
	assert_int_equal(fclose(file), 0);
	assert_string_equal(bytes, expected);
	free(bytes);
}

struct text_case {
	const char *text, *expected;
};

static void test_markup(void **state)
{
	(void)state;
	static const struct text_case cases[] = {
		{"", ""},
		{"plain", "plain"},
		{"<a href=\"b\">&amp;'</a>", "&lt;a href=&quot;b&quot;&gt;&amp;amp;'&lt;/a&gt;"},
		{"]]>", "]]&gt;"},
		{"two\nlines\r\n\ttab", "two lines   tab"},
		{"\x01\x1b[31m\x7f", "  [31m "},
		{"\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80",
			"\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80"},
		{"caf\xe9 \xc0\xaf", "caf\xef\xbf\xbd \xef\xbf\xbd\xef\xbf\xbd"},
		{"\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},
		{"\xef\xbf\xbe\xef\xbf\xbf", "\xef\xbf\xbd\xef\xbf\xbd"},
		{"\xf0\x9f\x98", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},
	};
	for (size_t i = 0; i < COUNT(cases); i++)
		assert_writes(escape_markup, cases[i].text, cases[i].expected);
}

static void test_csv(void **state)
{
	(void)state;
	static const struct text_case cases[] = {
		{"", ""},
		{"plain <&>", "plain <&>"},
		{"a,b", "\"a,b\""},
		{"\"", "\"\"\"\""},
		{"two\nlines", "\"two\nlines\""},
		{"two\rlines", "\"two\rlines\""},
	};
	for (size_t i = 0; i < COUNT(cases); i++)
		assert_writes(escape_csv, cases[i].text, cases[i].expected);
}

static void write_uri(const char *text, FILE *file)
{
	page_data_uri("text/plain", text, strlen(text), file);
}

/* The vectors of RFC 4648, section 10, and all values of six bits. */
static void test_data_uris(void **state)
{
	(void)state;
	static const struct text_case cases[] = {
		{"", ""},
		{"f", "Zg=="},
		{"fo", "Zm8="},
		{"foo", "Zm9v"},
		{"foob", "Zm9vYg=="},
		{"fooba", "Zm9vYmE="},
		{"foobar", "Zm9vYmFy"},
		{"\xfb\xef\xbe\xff\xff\xff", "++++////"},
	};
	for (size_t i = 0; i < COUNT(cases); i++) {
		char expected[64];
		snprintf(
			expected, sizeof(expected), "data:text/plain;base64,%s", cases[i].expected);
		assert_writes(write_uri, cases[i].text, expected);
	}
}

static void write_page(const char *text, FILE *file)
{
	page_begin(text, file);
	page_body(file);
	page_pair(text, text, file);
	page_end(file);
}

static void test_titles_and_pairs_are_no_markup(void **state)
{
	(void)state;
	char *bytes = NULL;
	size_t size;
	FILE *file = open_memstream(&bytes, &size);
	assert_non_null(file);
	write_page("</title><b>", file);
	assert_int_equal(fclose(file), 0);
	assert_non_null(strstr(bytes, "<title>&lt;/title&gt;&lt;b&gt;</title>"));
	assert_non_null(strstr(bytes, "<th scope=\"row\">&lt;/title&gt;&lt;b&gt;</th>"
				      "<td class=\"left\">&lt;/title&gt;&lt;b&gt;</td>"));
	assert_null(strstr(bytes, "<b>"));
	free(bytes);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_markup),
		cmocka_unit_test(test_csv),
		cmocka_unit_test(test_data_uris),
		cmocka_unit_test(test_titles_and_pairs_are_no_markup),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
