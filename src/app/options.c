/* SPDX-License-Identifier: MIT */
#include "app/options.h"
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_FLAGS 32

struct common_options options_defaults(void)
{
	const char *debug = getenv("SMOOTHIE_DEBUG");
	return (struct common_options){.debug = debug != NULL && strcmp(debug, "1") == 0};
}

static bool has_letter(const struct flag *flag)
{
	return flag->id < FLAG_DEVICE;
}

static const struct flag *find_flag(const struct command *command, int id)
{
	for (size_t i = 0; i < command->flag_count; i++)
		if (command->flags[i].id == id)
			return &command->flags[i];
	return NULL;
}

static int refuse(const struct command *command, int result, char **argv, struct sm_error *error)
{
	const struct flag *flag = find_flag(command, optopt);
	if (result == ':')
		options_error(error, command, "--%s needs %s", flag->name, flag->value);
	else if (flag != NULL)
		options_error(error, command, "--%s takes no value", flag->name);
	else if (optopt != 0)
		options_error(error, command, "unknown flag -%c", optopt);
	else
		options_error(error, command, "unknown flag %s", argv[optind - 1]);
	return FLAG_FAILED;
}

/* getopt_long() wants its own tables; making them anew for each flag keeps no state around. The
 * colon at the start leaves the messages to us. */
int options_next(const struct command *command, int argc, char **argv, struct sm_error *error)
{
	struct option longs[MAX_FLAGS + 1] = {0};
	char shorts[2 * MAX_FLAGS + 2] = ":";
	char *letter = shorts + 1;
	for (size_t i = 0; i < command->flag_count && i < MAX_FLAGS; i++) {
		const struct flag *flag = &command->flags[i];
		int argument = flag->value == NULL     ? no_argument
			       : flag->value[0] == '[' ? optional_argument
						       : required_argument;
		longs[i] = (struct option){flag->name, argument, NULL, flag->id};
		if (has_letter(flag)) {
			*letter++ = (char)flag->id;
			if (argument == required_argument)
				*letter++ = ':';
		}
	}
	int result = getopt_long(argc, argv, shorts, longs, NULL);
	if (result == '?' || result == ':')
		return refuse(command, result, argv, error);
	return result == -1 ? FLAG_END : result;
}

void options_common(struct common_options *options, int id, const char *value)
{
	switch (id) {
	case FLAG_DEVICE:
		options->device = value;
		break;
	case FLAG_DEBUG:
		options->debug = true;
		break;
	case 'q':
		options->verbosity = -1;
		break;
	case 'v':
		options->verbosity++;
		break;
	case 'h':
		options->help = true;
		break;
	}
}

static void print_flag(const struct flag *flag)
{
	char left[48];
	const char *value = flag->value != NULL ? flag->value : "";
	const char *join = value[0] == '\0' || value[0] == '[' ? "" : " ";
	if (has_letter(flag))
		snprintf(left, sizeof(left), "-%c, --%s%s%s", flag->id, flag->name, join, value);
	else
		snprintf(left, sizeof(left), "    --%s%s%s", flag->name, join, value);
	printf("  %-30s %s\n", left, flag->help);
}

void options_help(const struct command *command)
{
	printf("usage: smoothie %s %s\n%s\n\n", command->name, command->arguments,
		command->summary);
	for (size_t i = 0; i < command->flag_count; i++)
		print_flag(&command->flags[i]);
}

bool options_error(struct sm_error *error, const struct command *command, const char *format, ...)
{
	char what[400];
	va_list args;
	va_start(args, format);
	vsnprintf(what, sizeof(what), format, args);
	va_end(args);
	return error_set(error, SM_ERROR_INPUT, "%s; see smoothie %s --help", what, command->name);
}

/* Reads digits up to the character `end`, and moves *text behind that. */
static bool read_number(const char **text, char end, uint32_t max, uint32_t *value)
{
	uint64_t number = 0;
	const char *at = *text;
	for (; *at >= '0' && *at <= '9'; at++) {
		number = number * 10 + (uint64_t)(*at - '0');
		if (number > max)
			return false;
	}
	if (at == *text || *at != end)
		return false;
	*text = at + 1;
	*value = (uint32_t)number;
	return true;
}

bool options_number(const char *text, uint32_t min, uint32_t max, uint32_t *value)
{
	return read_number(&text, '\0', max, value) && *value >= min;
}

/* strtod() alone would also take spaces, hexadecimal digits and names of what is not finite. */
bool options_real(const char *text, double min, double max, double *value)
{
	char *end;
	*value = strtod(text, &end);
	return end != text && text[strspn(text, "+-.0123456789eE")] == '\0' && *end == '\0' &&
	       *value >= min && *value <= max;
}

bool options_rate(const char *text, uint32_t *numerator, uint32_t *denominator)
{
	*denominator = 1;
	if (!read_number(&text, '\0', INT32_MAX, numerator) &&
		!(read_number(&text, '/', INT32_MAX, numerator) &&
			read_number(&text, '\0', INT32_MAX, denominator)))
		return false;
	uint64_t frames = *numerator, seconds = *denominator;
	return seconds > 0 && frames * 1000 >= seconds && frames <= seconds * 1000;
}

bool options_range(const char *text, uint32_t max, uint32_t *first, uint32_t *last)
{
	if (!read_number(&text, ':', max, first))
		*first = 1;
	return read_number(&text, '\0', max, last) && *first >= 1 && *first <= *last;
}

bool options_size(const char *text, uint32_t *width, uint32_t *height)
{
	return read_number(&text, 'x', INT32_MAX, width) && *width > 0 &&
	       read_number(&text, '\0', INT32_MAX, height) && *height > 0;
}
