/* SPDX-License-Identifier: MIT */
/* Model files that are known to be damaged or odd: each gives a picture or one line, in time. */
#include "program.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <glob.h>
#include <string.h>
#include <unistd.h>

#define MODELS "/usr/share/assimp/models/"

static void assert_survives(const char *path)
{
	struct outcome outcome = RUN("render", path, "--size", "16x16", "-o", "out.png");
	if (outcome.status == 0) {
		assert_int_equal(unlink("out.png"), 0);
	} else {
		if (outcome.status != 1 && outcome.status != 2)
			fail_msg("%s ends with %d and:\n%s", path, outcome.status, outcome.error);
		assert_failure(&outcome, outcome.status, "");
	}
	assert_int_equal(count_entries(""), 0);
	outcome_finish(&outcome);
}

static void test_damaged_models(void **state)
{
	(void)state;
	static const char *const patterns[] = {
		MODELS "invalid/*",
		MODELS "glTF2/wrongTypes/*",
		MODELS "glTF2/IndexOutOfRange/*",
		MODELS "glTF2/MissingBin/*",
		MODELS "glTF2/SchemaFailures/*",
		MODELS "glTF2/RecursiveNodes/*",
		MODELS "glTF2/BoxWithInfinites-glTF-Binary/*",
	};
	glob_t files = {0};
	for (size_t i = 0; i < sizeof(patterns) / sizeof(patterns[0]); i++)
		glob(patterns[i], i > 0 ? GLOB_APPEND : 0, NULL, &files);
	size_t count = files.gl_pathc;
	for (size_t i = 0; i < count; i++)
		assert_survives(files.gl_pathv[i]);
	globfree(&files);
	if (count == 0)
		skip();
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_damaged_models, enter_scratch, leave_scratch),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
