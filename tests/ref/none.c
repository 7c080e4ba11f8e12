/* SPDX-License-Identifier: MIT */
#include "ref/reference.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static void a_build_without_embree_says_so(void **state)
{
	(void)state;
	struct reference reference;
	struct sm_error error;
	assert_false(reference_is_built());
	assert_false(reference_trace(&reference, &(struct reference_request){0}, &error));
	assert_int_equal(error.status, SM_ERROR_MACHINE);
	assert_non_null(strstr(error.text, "built without Embree"));
	assert_non_null(strstr(error.text, "libembree-dev"));
	assert_null(reference.visibility);
	reference_finish(&reference);
	reference_finish(NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_build_without_embree_says_so),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
