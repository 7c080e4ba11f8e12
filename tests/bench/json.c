/* SPDX-License-Identifier: MIT */
/* The inputs of a run and its rows, as JSON. */
#include "bench/json.h"
#include "results.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

static void assert_contains(const char *text, const char *part)
{
	if (strstr(text, part) == NULL)
		fail_msg("\"%s\" is not in:\n%s", part, text);
}

static void test_rows_are_objects(void **state)
{
	(void)state;
	struct result result = make_result("say \"hi\"\\\n", "hard");
	struct result_list list = {.items = &result, .count = 1};
	struct run_facts facts = {0};
	struct text text = {0};
	result.flicker = NAN;
	result.error[REGION_ALL].rmse = INFINITY;
	json_write(&list, &facts, text_begin(&text));
	assert_contains(text_end(&text), "{\"scene\": \"say \\\"hi\\\"\\\\\\u000a\", ");
	assert_contains(text.bytes, "\"flicker\": null, \"ms\": 1.1,");
	assert_contains(text.bytes, "\"all_rmse\": null,");
	assert_contains(text.bytes,
		"\"passes\": {\"shadow map\": 0.30000000000000004, \"surfaces\": 1e-300}");
	assert_contains(text.bytes, "\"geometry_bytes\": 18446744073709551615,");
	text_finish(&text);
}

static void test_facts_are_an_object(void **state)
{
	(void)state;
	static char *const arguments[] = {"bench", "--out", "it's here"};
	struct result_list list = {0};
	struct run_facts facts;
	struct text text = {0};
	char machine[160];
	run_facts_init(&facts, 3, arguments);
	run_facts_driver(&facts, "renderer", "llvmpipe");
	run_facts_driver(&facts, "version", "OpenGL ES 3.2");
	run_facts_add(&facts, "samples", "%d", 1024);
	assert_false(facts.failed);
	json_write(&list, &facts, text_begin(&text));
	assert_contains(
		text_end(&text), "\"command\": \"smoothie bench --out 'it'\\\\''s here'\",");
	assert_contains(text.bytes, "\"driver renderer\": \"llvmpipe\",");
	assert_contains(text.bytes, "\"samples\": \"1024\"\n");
	assert_contains(text.bytes, "\"results\": [\n  ]\n}\n");
	run_facts_machine(&facts, machine, sizeof(machine));
	assert_contains(machine, " cores, llvmpipe, OpenGL ES 3.2");
	assert_string_equal(run_facts_get(&facts, "nothing"), "");
	run_facts_finish(&facts);
	text_finish(&text);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_rows_are_objects),
		cmocka_unit_test(test_facts_are_an_object),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
