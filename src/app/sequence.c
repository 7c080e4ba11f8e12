/* SPDX-License-Identifier: MIT */
#include "app/sequence.h"
#include <stdio.h>
#include <string.h>

/* A pattern split around its number: printf never sees what the user wrote. */
struct pattern {
	size_t before; /* characters ahead of the number */
	size_t after;  /* where the rest starts */
	int digits;
	const char *dash;
};

static bool find_conversion(const char *text, struct pattern *pattern)
{
	const char *percent = strchr(text, '%');
	if (percent == NULL || strchr(percent + 1, '%') != NULL)
		return false;
	const char *at = percent + 1;
	int digits = 1;
	if (at[0] == '0' && at[1] >= '1' && at[1] <= '9') {
		digits = at[1] - '0';
		at += 2;
	}
	*pattern = (struct pattern){(size_t)(percent - text), (size_t)(at + 1 - text), digits, ""};
	return *at == 'd';
}

static struct pattern before_extension(const char *text)
{
	const char *slash = strrchr(text, '/');
	const char *name = slash != NULL ? slash + 1 : text;
	const char *dot = strrchr(name, '.');
	/* A name's first dot hides it, and starts no extension. */
	size_t at = dot != NULL && dot != name ? (size_t)(dot - text) : strlen(text);
	return (struct pattern){at, at, 4, "-"};
}

bool sequence_path(const char *pattern, uint32_t number, char *path, size_t size)
{
	struct pattern parts;
	if (!find_conversion(pattern, &parts))
		parts = before_extension(pattern);
	int length = snprintf(path, size, "%.*s%s%0*u%s", (int)parts.before, pattern, parts.dash,
		parts.digits, number, pattern + parts.after);
	return length >= 0 && (size_t)length < size;
}
