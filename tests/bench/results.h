/* SPDX-License-Identifier: MIT */
#ifndef TESTS_BENCH_RESULTS_H
#define TESTS_BENCH_RESULTS_H

#include "bench/result.h"
#include <stdio.h>

/** A result with a different, awkward number in each field. */
struct result make_result(const char *scene, const char *technique);

/** Text that a function writes to a FILE. */
struct text {
	char *bytes; /* owned */
	size_t size;
	FILE *file;
};

FILE *text_begin(struct text *text);
/** The text, until the next text_begin(). */
const char *text_end(struct text *text);
void text_finish(struct text *text);

#endif
