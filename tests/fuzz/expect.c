/* SPDX-License-Identifier: MIT */
#include "expect.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void expectation_failed(const char *file, int line, const char *condition)
{
	fprintf(stderr, "%s:%d: not so: %s\n", file, line, condition);
	abort();
}

void expect_clear_error(const struct sm_error *error)
{
	expect(error->status == SM_ERROR_INPUT);
	expect(error->text[0] != '\0');
	for (const char *c = error->text; *c != '\0'; c++)
		expect((unsigned char)*c >= ' ');
}

void expect_finite(const float *values, size_t count)
{
	for (size_t i = 0; i < count; i++)
		expect(isfinite(values[i]));
}
