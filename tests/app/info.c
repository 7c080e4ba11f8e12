/* SPDX-License-Identifier: MIT */
/* What `smoothie info` tells of drivers and of models. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

static void assert_lines(const struct outcome *outcome, const char *const *lines, size_t count)
{
	assert_int_equal(outcome->status, 0);
	assert_string_equal(outcome->error, "");
	for (size_t i = 0; i < count; i++)
		if (strstr(outcome->out, lines[i]) == NULL)
			fail_msg("line %zu of the expected is not in\n%s", i, outcome->out);
}

#define ASSERT_LINES(outcome, lines) \
	assert_lines(outcome, lines, sizeof(lines) / sizeof((lines)[0]))

static void test_driver(void **state)
{
	(void)state;
	static const char *const lines[] = {
		"smoothie: ", "\ndevice: surfaceless\n", "\nEGL vendor: ", "\nEGL version: "};
	struct outcome outcome = RUN("info", "--device", "surfaceless");
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

/* A square pyramid without its base. */
static const char pyramid[] = "v 0 1 0\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
			      "f 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 2 5\n";

static void test_model(void **state)
{
	(void)state;
	static const char *const lines[] = {"meshes: 1\n", "\nobjects: 1\n", "\nlights: 1\n",
		"\ntriangles: 4\n", "\ndegenerate triangles: 0\n", "\nwelded vertices: 5\n",
		"\nedges: 8\n", "\nopen edges: 4\n", "\nnon-manifold edges: 0\n",
		"\ninverted edges: 0\n", "\nbytes per edge: ", "\nbytes per edge with planes: "};
	write_text("pyramid.obj", pyramid);
	/* A model needs no driver. */
	struct outcome outcome = run_program(&(struct run){.arguments = {"info", "pyramid.obj"},
		.environment = "__EGL_VENDOR_LIBRARY_FILENAMES=/dev/null"});
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

static void test_json_has_numbers_for_numbers(void **state)
{
	(void)state;
	static const char *const lines[] = {
		"{\n", "\n  \"edges\": 8,\n", "\n  \"open edges\": 4,\n"};
	write_text("pyramid.obj", pyramid);
	struct outcome outcome = RUN("info", "pyramid.obj", "--json");
	ASSERT_LINES(&outcome, lines);
	assert_string_equal(outcome.out + outcome.out_size - 3, "\n}\n");
	outcome_finish(&outcome);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_driver),
		cmocka_unit_test_setup_teardown(test_model, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(
			test_json_has_numbers_for_numbers, enter_scratch, leave_scratch),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
