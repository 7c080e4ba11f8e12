/* SPDX-License-Identifier: MIT */
#include "page/escape.h"
#include "base/utf8.h"
#include <stdbool.h>
#include <string.h>

static const char *entity(char c)
{
	switch (c) {
	case '&':
		return "&amp;";
	case '<':
		return "&lt;";
	case '>': /* for the sake of "]]>", which XML forbids in content */
		return "&gt;";
	case '"':
		return "&quot;";
	default:
		return NULL;
	}
}

/* U+FFFE and U+FFFF (XML 1.0, section 2.2) */
static bool is_excluded(const char *character, size_t size)
{
	return size == 3 && (memcmp(character, "\xef\xbf\xbe", 3) == 0 ||
				    memcmp(character, "\xef\xbf\xbf", 3) == 0);
}

void escape_markup(const char *text, FILE *file)
{
	while (*text != '\0') {
		size_t size = utf8_size(text);
		if (size == 0 || is_excluded(text, size))
			fputs("\xef\xbf\xbd", file);
		else if ((unsigned char)*text < 0x20 || *text == 0x7f)
			fputc(' ', file);
		else if (entity(*text) != NULL)
			fputs(entity(*text), file);
		else
			fwrite(text, 1, size, file);
		text += size > 0 ? size : 1;
	}
}

void escape_csv(const char *text, FILE *file)
{
	if (strpbrk(text, ",\"\r\n") == NULL) {
		fputs(text, file);
		return;
	}
	fputc('"', file);
	for (; *text != '\0'; text++) {
		if (*text == '"')
			fputc('"', file);
		fputc(*text, file);
	}
	fputc('"', file);
}
