/* SPDX-License-Identifier: MIT */
#include "base/line.h"
#include <stdio.h>

void line_format(char *line, size_t size, const char *format, va_list args)
{
	vsnprintf(line, size, format, args);
	for (char *c = line; *c != '\0'; c++)
		if ((unsigned char)*c < ' ' || *c == '\x7f')
			*c = ' ';
}
