/* SPDX-License-Identifier: MIT */
#ifndef TESTS_FUZZ_EXPECT_H
#define TESTS_FUZZ_EXPECT_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Of libFuzzer: looks at one input; what must not be aborts. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/** Aborts with the place unless the condition holds, whatever the build. */
#define expect(condition) \
	((condition) ? (void)0 : expectation_failed(__FILE__, __LINE__, #condition))

_Noreturn void expectation_failed(const char *file, int line, const char *condition);

/** A failure is told in one line. */
void expect_clear_error(const struct sm_error *error);

void expect_finite(const float *values, size_t count);

#endif
