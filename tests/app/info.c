/* SPDX-License-Identifier: MIT */
/* What `smoothie info` tells of drivers and of scenes. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void test_driver(void **state)
{
	(void)state;
	static const char *const lines[] = {"smoothie: ", "\ndevice: surfaceless\n",
		"\nEGL vendor: ", "\nEGL version: ", "\ncompiled programs: "};
	struct outcome outcome = RUN("info", "--device", "surfaceless");
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

static void test_caps_taken_away_and_given_back(void **state)
{
	(void)state;
	static const char *const away[] = {"\ncap min_rg16f: no: taken away\n",
		"\ncap min_rg32f: no: without EXT_float_blend\n", "\nneed smoothie: rgb10_a2 (",
		"; rg16f was not taken because min_rg16f: taken away"};
	static const char *const back[] = {"\ncap min_rg16f: yes: ", "\nneed smoothie: rg16f (",
		"\nneed taps: fetch, forced ("};
	struct outcome outcome =
		RUN("info", "--device", "surfaceless", "--caps", "-min_rg16f,-EXT_float_blend");
	ASSERT_LINES(&outcome, away);
	outcome_finish(&outcome);
	outcome = RUN("info", "--device", "surfaceless", "--caps", "-min_rg16f", "--path",
		"taps=fetch", "--caps", "+min_rg16f");
	ASSERT_LINES(&outcome, back);
	outcome_finish(&outcome);
}

static void test_context_that_cannot_be_had(void **state)
{
	(void)state;
	static const struct {
		const char *environment;
		int status;
		const char *text;
	} cases[] = {
		{"MESA_GLES_VERSION_OVERRIDE=2.0", 1,
			"OpenGL ES 3.0 is needed, it offers OpenGL ES 2.0"},
		{"SMOOTHIE_CONTEXT=strict", 2, "SMOOTHIE_CONTEXT is \"strict\""},
	};
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct outcome outcome = run_program(&(struct run){
			.arguments = {"info", "--device", "surfaceless"},
			.environment = cases[i].environment,
		});
		assert_failure(&outcome, cases[i].status, cases[i].text);
		outcome_finish(&outcome);
	}
}

/* Three boxes of 12 triangles, 8 corners and 18 edges each. */
static void test_scene(void **state)
{
	(void)state;
	static const char *const lines[] = {"meshes: 3\n", "\nobjects: 3\n", "\nlights: 1\n",
		"\ntriangles: 36\n", "\nrepeated triangles: 0\n", "\ndegenerate triangles: 0\n",
		"\nwelded vertices: 24\n", "\nedges: 54\n", "\nopen edges: 0\n",
		"\nnon-manifold edges: 0\n", "\ninverted edges: 0\n", "\nclosed parts: 3\n",
		"\nopen parts: 0\n", "\nturned triangles: 0\n",
		"\nbytes per edge: ", "\nbytes per edge with planes: "};
	/* A scene needs no driver. */
	struct outcome outcome = run_program(&(struct run){.arguments = {"info", "builtin:boxes"},
		.environment = "__EGL_VENDOR_LIBRARY_FILENAMES=/dev/null"});
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

static void test_json_has_numbers_for_numbers(void **state)
{
	(void)state;
	static const char *const lines[] = {
		"{\n", "\n  \"edges\": 54,\n", "\n  \"open edges\": 0,\n"};
	struct outcome outcome = RUN("info", "builtin:boxes", "--json");
	ASSERT_LINES(&outcome, lines);
	assert_string_equal(outcome.out + outcome.out_size - 3, "\n}\n");
	outcome_finish(&outcome);
}

static void test_memory(void **state)
{
	(void)state;
	/* 256 x 256 texels of 4 bytes. */
	static const char *const lines[] = {
		"\nGL: meshes as drawn: ", "\nGL: shadow maps: light 0: 262144\n",
		"\nprocessor: casters: edges: ", "\nGL, all: ", "\nprocessor, all: "};
	struct outcome outcome = RUN("info", "builtin:boxes", "--memory", "--device", "surfaceless",
		"--technique", "smoothie", "--map", "256");
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
	outcome = RUN("info", "--memory");
	assert_failure(&outcome, 2, "--memory: SCENE is missing");
	outcome_finish(&outcome);
	outcome = RUN("info", "builtin:boxes", "--map", "256");
	assert_failure(&outcome, 2, "are for --memory alone");
	outcome_finish(&outcome);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_driver),
		cmocka_unit_test(test_caps_taken_away_and_given_back),
		cmocka_unit_test(test_context_that_cannot_be_had),
		cmocka_unit_test(test_scene),
		cmocka_unit_test(test_memory),
		cmocka_unit_test(test_json_has_numbers_for_numbers),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
