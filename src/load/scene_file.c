/* SPDX-License-Identifier: MIT */
#include "load/scene_file.h"
#include "base/array.h"
#include <errno.h>
#include <ini.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { MAX_BYTES = 1 << 20 };

static const char blanks[] = " \t\r";

struct reader {
	const char *path;
	const char *rest; /* of the text, from the next line */
	int line;         /* that was read last, counted from 1 */
	struct plan *plan;
	struct plan_section open; /* no data: before the first heading */
	struct sm_error *error;
	bool failed;
};

bool scene_file_is(const char *source)
{
	size_t length = strlen(source);
	return length >= 4 && strcasecmp(source + length - 4, ".ini") == 0;
}

static void fail_here(struct reader *reader, const char *format, ...) PRINTF_LIKE(2, 3);

static void fail_here(struct reader *reader, const char *format, ...)
{
	char cause[400];
	va_list args;
	va_start(args, format);
	vsnprintf(cause, sizeof(cause), format, args);
	va_end(args);
	error_set(reader->error, SM_ERROR_INPUT, "%s:%d: %s", reader->path, reader->line, cause);
	reader->failed = true;
}

/** The light or object of that name, made if there is none yet. */
static bool open_named(struct reader *reader, enum section section, const char *name)
{
	struct plan *plan = reader->plan;
	size_t count = plan_count(plan, section), found = plan_find(plan, section, name);
	if (found == SIZE_MAX &&
		(section == SECTION_LIGHT ? plan_add_light(plan, name, reader->error) == NULL
					  : plan_add_object(plan, name, reader->error) == NULL)) {
		reader->failed = true;
		return false;
	}
	reader->open = plan_get(plan, section, found != SIZE_MAX ? found : count);
	return true;
}

/** Opens the section of "[section]" or "[section NAME]". */
static void open_section(struct reader *reader, char *heading)
{
	char *end = strchr(heading, ']');
	if (end == NULL) {
		fail_here(reader, "a ] is missing after %.60s", heading);
		return;
	}
	char *after = end + 1 + strspn(end + 1, blanks);
	if (*after != '\0' && *after != ';' && *after != '#') {
		fail_here(reader, "nothing may follow the heading, but \"%.60s\" does", after);
		return;
	}
	*end = '\0';
	char *word = heading + 1 + strspn(heading + 1, blanks);
	char *name = word + strcspn(word, blanks);
	if (*name != '\0')
		*name++ = '\0';
	name += strspn(name, blanks);
	for (char *last = name + strlen(name); last > name && strchr(blanks, last[-1]) != NULL;)
		*--last = '\0';

	enum section section = section_find(word);
	if (section == SECTION_COUNT)
		fail_here(reader,
			"no section [%.40s]; there are [camera], [light NAME], [object NAME], "
			"[ground], [environment], [motion], [shadow], [output]",
			word);
	else if (section_is_named(section) && *name == '\0')
		fail_here(reader, "[%s] needs a name, as in [%s NAME]", word, word);
	else if (!section_is_named(section) && *name != '\0')
		fail_here(reader, "[%s] takes no name, but has \"%.40s\"", word, name);
	else if (section_is_named(section))
		open_named(reader, section, name);
	else
		reader->open = plan_get(reader->plan, section, 0);
}

/**
 * Hands inih the next line, like fgets(). Headings are opened here and reach inih as empty lines,
 * since it tells neither its line numbers nor of a section without keys; comments do so because
 * they may be longer than its buffer, and indentation is dropped, which it takes for continuation.
 */
static char *next_line(char *buffer, int size, void *data)
{
	struct reader *reader = data;
	if (reader->failed || *reader->rest == '\0')
		return NULL;
	reader->line++;
	const char *start = reader->rest;
	size_t length = strcspn(start, "\n");
	reader->rest += length + (start[length] == '\n');
	size_t indent = strspn(start, blanks);
	indent = indent < length ? indent : length;
	start += indent;
	length -= indent;
	if (*start == ';' || *start == '#')
		length = 0;
	if (length > (size_t)size - 3) {
		fail_here(reader, "the line is longer than %d bytes", size - 3);
		return NULL;
	}
	memcpy(buffer, start, length);
	buffer[length] = '\0';
	if (*buffer == '[') {
		open_section(reader, buffer);
		length = 0;
	}
	memcpy(buffer + length, "\n", 2);
	return buffer;
}

static int set_key(void *data, const char *section, const char *name, const char *value)
{
	struct reader *reader = data;
	(void)section;
	if (reader->failed)
		return 0;
	if (reader->open.data == NULL) {
		fail_here(reader, "%.40s stands before the first [section]", name);
		return 0;
	}
	size_t index = key_find(reader->open.section, name);
	if (index != SIZE_MAX && *reader->open.given >> index & 1) {
		fail_here(reader, "%s is given twice", name);
		return 0;
	}
	char place[300];
	snprintf(place, sizeof(place), "%.280s:%d", reader->path, reader->line);
	reader->failed = !plan_set(&reader->open, name, value, place, reader->error);
	return !reader->failed;
}

/** The whole text of a regular file of up to MAX_BYTES, from malloc(). */
static char *read_text(const char *path, struct sm_error *error)
{
	char *text = NULL;
	FILE *file = fopen(path, "rb");
	struct stat status;
	if (file == NULL || fstat(fileno(file), &status) != 0) {
		error_set(error, SM_ERROR_INPUT, "%s: %s", path, strerror(errno));
		goto out;
	}
	if (!S_ISREG(status.st_mode)) {
		error_set(error, SM_ERROR_INPUT, "%s: not a regular file", path);
		goto out;
	}
	text = array_zalloc(MAX_BYTES + 2, 1);
	if (text == NULL) {
		error_no_memory(error);
		goto out;
	}
	size_t size = fread(text, 1, MAX_BYTES + 1, file);
	const char *problem = ferror(file)       ? strerror(errno)
			      : size > MAX_BYTES ? "larger than 1 MiB, too large for a scene file"
			      : memchr(text, '\0', size) != NULL ? "not a text file"
								 : NULL;
	if (problem != NULL) {
		error_set(error, SM_ERROR_INPUT, "%s: %s", path, problem);
		free(text);
		text = NULL;
	}
out:
	if (file != NULL)
		fclose(file);
	return text;
}

static bool read_keys(const char *path, const char *text, struct plan *plan, struct sm_error *error)
{
	static const char byte_order_mark[] = "\xef\xbb\xbf";
	size_t mark = strlen(byte_order_mark);
	struct reader reader = {
		.path = path,
		.rest = strncmp(text, byte_order_mark, mark) == 0 ? text + mark : text,
		.plan = plan,
		.error = error,
	};
	int line = ini_parse_stream(next_line, &reader, set_key, &reader);
	if (line < 0)
		return error_no_memory(error);
	if (line > 0 && (!reader.failed || line < reader.line)) {
		reader.line = line;
		fail_here(&reader, "neither a [section] nor key = value");
	}
	return !reader.failed;
}

/** Turns a model's path from relative to the scene file to relative to where the program runs. */
static bool rebase_model(struct plan_object *object, const char *path, struct sm_error *error)
{
	const char *slash = strrchr(path, '/');
	if (object->model == NULL || object->model[0] == '/' || slash == NULL ||
		strncmp(object->model, "builtin:", 8) == 0)
		return true;
	size_t folder = (size_t)(slash - path) + 1, size = strlen(object->model) + 1;
	char *joined = array_alloc(folder + size, 1);
	if (joined == NULL)
		return error_no_memory(error);
	memcpy(joined, path, folder);
	memcpy(joined + folder, object->model, size);
	free(object->model);
	object->model = joined;
	return true;
}

bool scene_file_parse(const char *path, const char *text, struct plan *plan, struct sm_error *error)
{
	bool ok = read_keys(path, text, plan, error);
	for (size_t i = 0; ok && i < plan->object_count; i++)
		ok = rebase_model(&plan->objects[i], path, error);
	return ok;
}

bool scene_file_read(const char *path, struct plan *plan, struct sm_error *error)
{
	char *text = read_text(path, error);
	bool ok = text != NULL && scene_file_parse(path, text, plan, error);
	free(text);
	return ok;
}
