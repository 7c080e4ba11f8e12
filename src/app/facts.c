/* SPDX-License-Identifier: MIT */
#include "app/facts.h"
#include "base/json.h"
#include <string.h>

/* RFC 8259, section 6, without exponents: JSON has no leading zeros and no bare points. */
static bool is_number(const char *text)
{
	static const char digits[] = "0123456789";
	text += text[0] == '-';
	size_t whole = strspn(text, digits);
	if (whole == 0 || (text[0] == '0' && whole > 1))
		return false;
	text += whole;
	if (text[0] == '\0')
		return true;
	size_t fraction = strspn(text + 1, digits);
	return text[0] == '.' && fraction > 0 && text[1 + fraction] == '\0';
}

void facts_begin(struct facts *facts, FILE *file, bool json)
{
	*facts = (struct facts){.file = file, .json = json};
	if (json)
		fputs("{", file);
}

void facts_add(struct facts *facts, const char *key, const char *value)
{
	if (!facts->json) {
		fprintf(facts->file, "%s: %s\n", key, value);
		return;
	}
	fputs(facts->count++ > 0 ? ",\n  " : "\n  ", facts->file);
	json_string(facts->file, key);
	fputs(": ", facts->file);
	if (is_number(value))
		fputs(value, facts->file);
	else
		json_string(facts->file, value);
}

void facts_format(struct facts *facts, const char *key, const char *format, ...)
{
	char value[201];
	va_list args;
	va_start(args, format);
	vsnprintf(value, sizeof(value), format, args);
	va_end(args);
	facts_add(facts, key, value);
}

void facts_end(struct facts *facts)
{
	if (facts->json)
		fputs("\n}\n", facts->file);
}

void facts_sink(void *data, const char *key, const char *value)
{
	facts_add(data, key, value);
}
