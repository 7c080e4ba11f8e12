/* SPDX-License-Identifier: MIT */
#include "model_file.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

struct model *load_model(const char *path, enum plan_up up)
{
	struct sm_error error;
	struct model *model = model_create(&error);
	assert_non_null(model);
	if (!import_model(path, up, model, &error))
		fail_msg("%s", error.text);
	return model;
}

void check_floats(const float *got, const float *expected, size_t count)
{
	for (size_t i = 0; i < count; i++)
		assert_float_equal(got[i], expected[i], 1e-5);
}
