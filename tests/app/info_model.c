/* SPDX-License-Identifier: MIT */
/* What `smoothie info` counts in a model file. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* A square pyramid without its base, one side turned over. */
static const char pyramid[] = "v 0 1 0\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
			      "f 1 3 2\nf 1 4 3\nf 1 4 5\nf 1 2 5\n";

static void test_edges_and_parts_are_counted(void **state)
{
	(void)state;
	static const char *const lines[] = {"meshes: 1\n", "\ntriangles: 4\n",
		"\nwelded vertices: 5\n", "\nedges: 8\n", "\nopen edges: 4\n",
		"\ninverted edges: 2\n", "\nclosed parts: 0\n", "\nopen parts: 1\n",
		"\nturned triangles: 1\n"};
	write_text("pyramid.obj", pyramid);
	struct outcome outcome = RUN("info", "pyramid.obj");
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

static void test_animations_are_listed(void **state)
{
	(void)state;
	static const char *const lines[] = {"\nskins: 1\n", "\nbones: 1\n", "\nmorph targets: 1\n",
		"\nanimations: 3\n", "\nanimation 0: Go, 1.000 s, 2 nodes, 1 morphs\n",
		"\nanimation 1: Wave, 1.000 s, 1 nodes, 0 morphs\n", "\nanimation 2: Broken, "};
	struct outcome outcome = RUN("info", "-q", SMOOTHIE_RIG);
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

static void test_animations_of_several_objects_are_told_apart(void **state)
{
	(void)state;
	static const char *const lines[] = {
		"\nanimations: 6\n", "\nanimation 2 of one: Broken", "\nanimation 0 of two: Go, "};
	write_text("pair.ini", "[object one]\nmodel = " SMOOTHIE_RIG "\nanimation = none\n"
			       "[object two]\nmodel = " SMOOTHIE_RIG "\n");
	struct outcome outcome = RUN("info", "-q", "pair.ini");
	ASSERT_LINES(&outcome, lines);
	outcome_finish(&outcome);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
			test_edges_and_parts_are_counted, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(
			test_animations_are_listed, enter_scratch, leave_scratch),
		cmocka_unit_test_setup_teardown(test_animations_of_several_objects_are_told_apart,
			enter_scratch, leave_scratch),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
