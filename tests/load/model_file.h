/* SPDX-License-Identifier: MIT */
#ifndef TESTS_LOAD_MODEL_FILE_H
#define TESTS_LOAD_MODEL_FILE_H

#include "load/import.h"

/** The model of a file that can be read; destroy it. */
struct model *load_model(const char *path, enum plan_up up);

/** To 1e-5. */
void check_floats(const float *got, const float *expected, size_t count);

#endif
