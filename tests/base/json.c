/* SPDX-License-Identifier: MIT */
/* Any text is a string of JSON. */
#include "base/json.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>

static const struct {
	const char *text, *json;
} cases[] = {
	{"", "\"\""},
	{"plain", "\"plain\""},
	{"a \"b\" \\c", "\"a \\\"b\\\" \\\\c\""},
	{"\n\t\x01\x1f", "\"\\u000a\\u0009\\u0001\\u001f\""},
	{"\x7f\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80",
		"\"\x7f\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\""},
	{"caf\xe9", "\"caf\\ufffd\""},                            /* Latin-1 */
	{"\xc0\xaf", "\"\\ufffd\\ufffd\""},                       /* overlong */
	{"\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\""},            /* a surrogate */
	{"\xf4\x90\x80\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\""}, /* above U+10FFFF */
	{"\xe2\x82", "\"\\ufffd\\ufffd\""},                       /* cut off */
	{"\xf0\x9f\x98\"", "\"\\ufffd\\ufffd\\ufffd\\\"\""},
};

static void test_strings(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		char *bytes = NULL;
		size_t size;
		FILE *file = open_memstream(&bytes, &size);
		assert_non_null(file);
		json_string(file, cases[i].text);
		assert_int_equal(fclose(file), 0);
		assert_string_equal(bytes, cases[i].json);
		free(bytes);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(test_strings)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
