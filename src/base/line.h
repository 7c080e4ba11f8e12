/* SPDX-License-Identifier: MIT */
#ifndef BASE_LINE_H
#define BASE_LINE_H

#include <stdarg.h>
#include <stddef.h>

/** Like vsnprintf(), but what it writes is one line whatever names and values from a file are in
 *  it: control characters become blanks. */
void line_format(char *line, size_t size, const char *format, va_list args)
	__attribute__((format(printf, 3, 0)));

#endif
