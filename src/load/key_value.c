/* SPDX-License-Identifier: MIT */
#include "load/color.h"
#include "load/key.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool parse_number(const struct key *key, const char **text, float *number)
{
	char *end;
	double value = strtod(*text, &end);
	/* Written so that NaN fails. */
	if (end == *text || !(value >= key->min && value <= key->max))
		return false;
	*text = end;
	*number = (float)value;
	return true;
}

/** Passes over blanks with at most one comma in them; false if there is neither. */
static bool skip_separator(const char **text)
{
	const char *start = *text;
	*text += strspn(*text, " \t");
	*text += **text == ',';
	*text += strspn(*text, " \t");
	return *text > start;
}

/** Numbers up to the end of the text; how many, or 0. */
static int parse_numbers(const struct key *key, const char *text, float numbers[3])
{
	int count = 0;
	while (count < 3 && parse_number(key, &text, &numbers[count])) {
		count++;
		if (*text == '\0')
			return count;
		if (!skip_separator(&text))
			return 0;
	}
	return 0;
}

static bool parse_color(const struct key *key, const char *text, float color[3])
{
	if (text[0] != '#')
		return parse_numbers(key, text, color) == 3;
	if (strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6)
		return false;
	unsigned long bytes = strtoul(text + 1, NULL, 16);
	for (int i = 0; i < 3; i++)
		color[i] = color_linear((float)(bytes >> (16 - 8 * i) & 0xff) / 255);
	return true;
}

static bool parse_scale(const struct key *key, const char *text, float scale[3])
{
	int count = parse_numbers(key, text, scale);
	if (count == 1)
		scale[1] = scale[2] = scale[0];
	return count == 1 || count == 3;
}

/** A whole number in the key's range, of digits alone. */
static bool parse_count(const struct key *key, const char **text, uint32_t *count)
{
	size_t digits = strspn(*text, "0123456789");
	/* Ten digits could be above 2^32. */
	if (digits == 0 || digits > 9)
		return false;
	uint32_t value = (uint32_t)strtoul(*text, NULL, 10);
	*text += digits;
	*count = value;
	return value >= key->min && value <= key->max;
}

static bool parse_size(const struct key *key, const char *text, uint32_t size[2])
{
	return parse_count(key, &text, &size[0]) && *text++ == 'x' &&
	       parse_count(key, &text, &size[1]) && *text == '\0';
}

static bool parse_word(const char *words, const char *text, unsigned *index)
{
	size_t length = strlen(text);
	for (*index = 0; words != NULL; (*index)++) {
		if (strcspn(words, "|") == length && strncmp(words, text, length) == 0)
			return true;
		words = strchr(words, '|');
		words = words != NULL ? words + 1 : NULL;
	}
	return false;
}

static bool parse_period(const struct key *key, const char *text, double *period)
{
	char *end;
	double value = strtod(text, &end), size = fabs(value);
	*period = value;
	/* Written so that NaN fails. */
	return end != text && *end == '\0' && (size == 0 || (size >= key->min && size <= key->max));
}

/** Room for any value but a text. */
union value {
	float numbers[3];
	double period;
	uint32_t counts[2];
	unsigned word;
	bool yes;
};

/** The size of a parsed value; 0 if it is not allowed. */
static size_t parse_value(const struct key *key, const char *text, union value *value)
{
	bool ok = false;
	switch (key->type) {
	case KEY_NUMBER:
		return parse_numbers(key, text, value->numbers) == 1 ? sizeof(float) : 0;
	case KEY_VECTOR:
		ok = parse_numbers(key, text, value->numbers) == 3;
		return ok ? sizeof(value->numbers) : 0;
	case KEY_SCALE:
		return parse_scale(key, text, value->numbers) ? sizeof(value->numbers) : 0;
	case KEY_COLOR:
		return parse_color(key, text, value->numbers) ? sizeof(value->numbers) : 0;
	case KEY_COUNT:
		ok = parse_count(key, &text, &value->counts[0]) && *text == '\0';
		return ok ? sizeof(uint32_t) : 0;
	case KEY_PERIOD:
		return parse_period(key, text, &value->period) ? sizeof(double) : 0;
	case KEY_SIZE:
		return parse_size(key, text, value->counts) ? sizeof(value->counts) : 0;
	case KEY_WORD:
		return parse_word(key->words, text, &value->word) ? sizeof(value->word) : 0;
	case KEY_YES:
		ok = parse_word("no|yes", text, &value->word);
		value->yes = value->word == 1;
		return ok ? sizeof(value->yes) : 0;
	case KEY_TEXT:
		break;
	}
	return 0;
}

static bool replace_text(char **field, const char *text)
{
	char *copy = text[0] != '\0' ? strdup(text) : NULL;
	if (copy == NULL)
		return false;
	free(*field);
	*field = copy;
	return true;
}

bool key_parse(const struct key *key, const char *text, void *section)
{
	char *field = (char *)section + key->offset;
	if (key->type == KEY_TEXT)
		return replace_text((char **)field, text);
	union value value;
	size_t size = parse_value(key, text, &value);
	memcpy(field, &value, size);
	return size > 0;
}

static void leave_open(const struct key *key, void *data)
{
	static const float open[3] = {NAN, NAN, NAN};
	static const union value none;
	char *field = (char *)data + key->offset;
	if (key->type == KEY_NUMBER)
		memcpy(field, open, sizeof(float));
	else if (key->type == KEY_COUNT)
		memcpy(field, &none, sizeof(uint32_t));
	else if (key->type == KEY_SIZE)
		memcpy(field, &none, sizeof(none.counts));
	else if (key->type == KEY_TEXT)
		memcpy(field, &(char *){NULL}, sizeof(char *));
	else
		memcpy(field, open, sizeof(open));
}

bool section_reset(enum section section, void *data)
{
	bool ok = true;
	const struct key *key;
	for (size_t i = 0; (key = key_at(i)) != NULL; i++) {
		if (key->section != section)
			continue;
		if (key->initial == NULL)
			leave_open(key, data);
		else
			ok = key_parse(key, key->initial, data) && ok;
	}
	return ok;
}
