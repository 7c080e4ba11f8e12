/* SPDX-License-Identifier: MIT */
#include "base/json.h"
#include "base/utf8.h"

void json_string(FILE *file, const char *text)
{
	fputc('"', file);
	while (*text != '\0') {
		size_t size = utf8_size(text);
		if (size == 0)
			fputs("\\ufffd", file);
		else if ((unsigned char)*text < 0x20)
			fprintf(file, "\\u%04x", *text);
		else
			fprintf(file, *text == '"' || *text == '\\' ? "\\%.*s" : "%.*s", (int)size,
				text);
		text += size > 0 ? size : 1;
	}
	fputc('"', file);
}
