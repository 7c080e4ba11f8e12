/* SPDX-License-Identifier: MIT */
#include "app/check_preset.h"
#include "base/array.h"
#include <errno.h>
#include <ini.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reader {
	struct check_preset *preset;
	const struct command *command;
	const char *path;
	FILE *file;
	check_preset_take take;
	void *data;
	int line;
	struct sm_error why; /* of the first line that cannot be used, where reading ends */
	bool failed;
};

/* "FOLDER/value" for a file beside the preset; a copy of the value for all else. */
static char *make_value(const char *path, const char *name, const char *value)
{
	const char *slash = strrchr(path, '/');
	bool beside = strcmp(name, "expect") == 0 && value[0] != '/' && slash != NULL;
	int folder = beside ? (int)(slash + 1 - path) : 0;
	size_t size = (size_t)folder + strlen(value) + 1;
	char *made = malloc(size);
	if (made != NULL)
		snprintf(made, size, "%.*s%s", folder, path, value);
	return made;
}

static const char *keep(struct reader *reader, const char *name, const char *value)
{
	struct check_preset *preset = reader->preset;
	if (!array_reserve((void **)&preset->values, &preset->capacity, preset->count + 1,
		    sizeof(*preset->values)))
		return NULL;
	char *made = make_value(reader->path, name, value);
	if (made != NULL)
		preset->values[preset->count++] = made;
	return made;
}

static const struct flag *find_flag(const struct command *command, const char *name)
{
	for (size_t i = 0; i < command->flag_count; i++)
		if (strcmp(command->flags[i].name, name) == 0)
			return &command->flags[i];
	return NULL;
}

static bool take_key(
	struct reader *reader, const char *section, const char *name, const char *value)
{
	const struct flag *flag = find_flag(reader->command, name);
	if (strcmp(section, "check") != 0)
		return error_set(&reader->why, SM_ERROR_INPUT,
			"section [check] is wanted, not [%.40s]", section);
	if (flag == NULL || flag->value == NULL || strcmp(name, "preset") == 0)
		return error_set(&reader->why, SM_ERROR_INPUT,
			"no flag with a value is named \"%.40s\"", name);
	const char *kept = keep(reader, name, value);
	if (kept == NULL)
		return error_no_memory(&reader->why);
	return reader->take(reader->data, flag->id, kept, &reader->why);
}

static bool is_comment(const char *line)
{
	line += strspn(line, " \t");
	return *line == '#' || *line == ';';
}

/* inih would take a line that is longer than its buffer for two. */
static char *next_line(char *buffer, int size, void *data)
{
	struct reader *reader = data;
	if (reader->failed || fgets(buffer, size, reader->file) == NULL)
		return NULL;
	reader->line++;
	if (strchr(buffer, '\n') != NULL || feof(reader->file))
		return buffer;
	if (is_comment(buffer)) {
		for (int c = 0; c != '\n' && c != EOF;)
			c = getc(reader->file);
		return buffer;
	}
	reader->failed = true;
	error_set(&reader->why, SM_ERROR_INPUT, "a line of text shorter than %d bytes is wanted",
		size - 1);
	return NULL;
}

static int take_line(void *data, const char *section, const char *name, const char *value)
{
	struct reader *reader = data;
	reader->failed = !take_key(reader, section, name, value);
	return !reader->failed;
}

bool check_preset_read(struct check_preset *preset, const struct command *command, const char *path,
	check_preset_take take, void *data, struct sm_error *error)
{
	struct reader reader = {
		.preset = preset, .command = command, .path = path, .take = take, .data = data};
	reader.file = fopen(path, "re");
	if (reader.file == NULL)
		return error_set(
			error, SM_ERROR_INPUT, "cannot read %.300s (%s)", path, strerror(errno));
	int line = ini_parse_stream(next_line, &reader, take_line, &reader);
	bool whole = line >= 0 && !ferror(reader.file);
	int code = errno;
	fclose(reader.file);
	if (!whole)
		return error_set(
			error, SM_ERROR_INPUT, "cannot read %.300s (%s)", path, strerror(code));
	if (reader.failed)
		return error_set(
			error, SM_ERROR_INPUT, "%.300s:%d: %s", path, reader.line, reader.why.text);
	return line == 0 ||
	       error_set(error, SM_ERROR_INPUT, "%.300s:%d: NAME = VALUE is wanted", path, line);
}

void check_preset_finish(struct check_preset *preset)
{
	for (size_t i = 0; i < preset->count; i++)
		free(preset->values[i]);
	free(preset->values);
	*preset = (struct check_preset){0};
}
