/* SPDX-License-Identifier: MIT */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include <smoothie.h>
#include <stdarg.h>

#define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))

/** Fills *error (may be NULL) with one line, whatever the arguments hold, and returns false, so
 * that a failing function can return it. */
bool error_set(struct sm_error *error, enum sm_status status, const char *format, ...)
	PRINTF_LIKE(3, 4);

/** The machine's failure that every allocation shares. */
bool error_no_memory(struct sm_error *error);

#endif
