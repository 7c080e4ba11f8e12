/* SPDX-License-Identifier: MIT */
#include "page/page.h"
#include "page/escape.h"
#include "page/style.h"
#include <stdint.h>

void page_begin(const char *title, FILE *file)
{
	fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
	      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
	      "<title>",
		file);
	escape_markup(title, file);
	fprintf(file, "</title>\n<style>\n%s</style>\n", page_css);
}

void page_body(FILE *file)
{
	fputs("</head>\n<body>\n", file);
}

void page_end(FILE *file)
{
	fputs("</body>\n</html>\n", file);
}

void page_pair(const char *key, const char *value, FILE *file)
{
	fputs("<tr><th scope=\"row\">", file);
	escape_markup(key, file);
	fputs("</th><td class=\"left\">", file);
	escape_markup(value, file);
	fputs("</td></tr>\n", file);
}

/* RFC 4648, section 4: three bytes are four characters, the last of them padded. */
static void write_base64(const uint8_t *bytes, size_t size, FILE *file)
{
	static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
				     "0123456789+/";
	for (size_t i = 0; i < size; i += 3) {
		size_t count = size - i < 3 ? size - i : 3;
		uint32_t group = (uint32_t)bytes[i] << 16;
		for (size_t j = 1; j < count; j++)
			group |= (uint32_t)bytes[i + j] << (16 - 8 * j);
		for (size_t j = 0; j < 4; j++)
			fputc(j <= count ? digits[group >> (18 - 6 * j) & 63] : '=', file);
	}
}

void page_data_uri(const char *type, const void *bytes, size_t size, FILE *file)
{
	fprintf(file, "data:%s;base64,", type);
	write_base64(bytes, size, file);
}
