/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* asprintf() */
#include "check/baseline.h"
#include "base/array.h"
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where in a file. */
struct place {
	const char *path;
	uint32_t line;
};

static bool refuse(
	const struct place *place, const char *problem, const char *text, struct sm_error *error)
{
	return error_set(error, SM_ERROR_INPUT, "%.200s:%u: %s: %.150s", place->path, place->line,
		problem, text);
}

static char *print_place(const struct place *place)
{
	char *text = NULL;
	return asprintf(&text, "%s:%u", place->path, place->line) < 0 ? NULL : text;
}

static bool add_pattern(struct check_patterns *patterns, const char *text,
	const struct place *place, struct sm_error *error)
{
	char why[100];
	if (!array_reserve((void **)&patterns->items, &patterns->capacity, patterns->count + 1,
		    sizeof(*patterns->items)))
		return error_no_memory(error);
	struct check_pattern *pattern = &patterns->items[patterns->count];
	int code = regcomp(&pattern->regex, text, REG_EXTENDED | REG_NOSUB);
	if (code != 0) {
		regerror(code, &pattern->regex, why, sizeof(why));
		return refuse(place, why, text, error);
	}
	patterns->count++;
	pattern->place = print_place(place);
	return pattern->place != NULL || error_no_memory(error);
}

static bool is_name(const char *text)
{
	for (const char *at = text; *at != '\0'; at++)
		if (!isalnum((unsigned char)*at) && strchr("._=-", *at) == NULL)
			return false;
	return text[0] != '\0';
}

static struct check_known *find_known(const struct check_baseline *baseline, const char *name)
{
	for (size_t i = 0; i < baseline->known_count; i++)
		if (strcmp(baseline->known[i].name, name) == 0)
			return &baseline->known[i];
	return NULL;
}

static bool add_known(struct check_baseline *baseline, const char *name, enum check_status status,
	const struct place *place, struct sm_error *error)
{
	if (!array_reserve((void **)&baseline->known, &baseline->known_capacity,
		    baseline->known_count + 1, sizeof(*baseline->known)))
		return error_no_memory(error);
	struct check_known *known = &baseline->known[baseline->known_count++];
	*known = (struct check_known){
		.name = strdup(name), .place = print_place(place), .status = status};
	return (known->name != NULL && known->place != NULL) || error_no_memory(error);
}

/* line is taken apart. */
static bool take_known(struct check_baseline *baseline, char *line, const struct place *place,
	struct sm_error *error)
{
	enum check_status status;
	char *comma = strchr(line, ',');
	if (comma == NULL)
		return refuse(place, "NAME,Status is wanted", line, error);
	*comma = '\0';
	if (!is_name(line))
		return refuse(place, "no name of a case", line, error);
	if (!check_status_find(comma + 1, &status))
		return refuse(place, "no status", comma + 1, error);
	if (find_known(baseline, line) != NULL)
		return refuse(place, "a case is named twice", line, error);
	if (status == CHECK_EXPECTED_FAIL)
		status = CHECK_FAIL;
	bool passes = status != CHECK_FAIL && status != CHECK_CRASH && status != CHECK_TIMEOUT;
	return passes || add_known(baseline, line, status, place, error);
}

static bool ends_with(const char *path, const char *end)
{
	const char *slash = strrchr(path, '/');
	const char *name = slash != NULL ? slash + 1 : path;
	const char *dot = strrchr(name, '.');
	size_t length = dot != NULL ? (size_t)(dot - name) : strlen(name), size = strlen(end);
	return length >= size && strncmp(name + length - size, end, size) == 0;
}

static bool take_line(struct check_baseline *baseline, char *line, const struct place *place,
	struct sm_error *error)
{
	size_t length = strlen(line);
	while (length > 0 && isspace((unsigned char)line[length - 1]))
		line[--length] = '\0';
	line += strspn(line, " \t");
	if (line[0] == '\0' || line[0] == '#')
		return true;
	if (ends_with(place->path, "skips"))
		return add_pattern(&baseline->skips, line, place, error);
	if (ends_with(place->path, "flakes"))
		return add_pattern(&baseline->flakes, line, place, error);
	return take_known(baseline, line, place, error);
}

/* Longer ones are no baseline's. */
#define LINE_SIZE 4096

/* The bytes of a line, and a 0; how many there are without it: none at the end of the file. */
static size_t read_line(FILE *file, char line[LINE_SIZE])
{
	size_t length = 0;
	int c = 0;
	while (length < LINE_SIZE - 1 && c != '\n' && (c = getc(file)) != EOF)
		line[length++] = (char)c;
	line[length] = '\0';
	return length;
}

static bool read_lines(
	struct check_baseline *baseline, FILE *file, struct place *place, struct sm_error *error)
{
	char line[LINE_SIZE];
	size_t length;
	bool taken = true;
	while (taken && (length = read_line(file, line)) > 0) {
		place->line++;
		if (length == LINE_SIZE - 1)
			taken = refuse(place, "the line is too long", line, error);
		else if (strlen(line) != length)
			taken = refuse(place, "no text", line, error);
		else
			taken = take_line(baseline, line, place, error);
	}
	return taken;
}

bool check_baseline_read(struct check_baseline *baseline, const char *path, struct sm_error *error)
{
	struct place place = {.path = path};
	FILE *file = fopen(path, "re");
	if (file == NULL)
		return error_set(
			error, SM_ERROR_INPUT, "cannot read %.300s (%s)", path, strerror(errno));
	bool taken = read_lines(baseline, file, &place, error);
	if (taken && ferror(file))
		taken = error_set(
			error, SM_ERROR_INPUT, "cannot read %.300s (%s)", path, strerror(errno));
	fclose(file);
	return taken;
}

static void finish_known(struct check_known *known)
{
	free(known->name);
	free(known->place);
}

static void finish_patterns(struct check_patterns *patterns)
{
	for (size_t i = 0; i < patterns->count; i++) {
		regfree(&patterns->items[i].regex);
		free(patterns->items[i].place);
	}
	free(patterns->items);
}

void check_baseline_finish(struct check_baseline *baseline)
{
	for (size_t i = 0; i < baseline->known_count; i++)
		finish_known(&baseline->known[i]);
	free(baseline->known);
	finish_patterns(&baseline->skips);
	finish_patterns(&baseline->flakes);
	*baseline = (struct check_baseline){0};
}

bool check_baseline_match(const struct check_baseline *baseline, const struct check_list *list,
	struct sm_error *error)
{
	for (size_t i = 0; i < baseline->known_count; i++) {
		const struct check_known *known = &baseline->known[i];
		if (!check_list_has(list, known->name))
			return error_set(error, SM_ERROR_INPUT,
				"%.300s: no case is named %.100s; see smoothie check --list",
				known->place, known->name);
	}
	return true;
}

static const char *find_pattern(const struct check_patterns *patterns, const char *name)
{
	for (size_t i = 0; i < patterns->count; i++)
		if (regexec(&patterns->items[i].regex, name, 0, NULL, 0) == 0)
			return patterns->items[i].place;
	return NULL;
}

const char *check_baseline_skips(const struct check_baseline *baseline, const char *name)
{
	return find_pattern(&baseline->skips, name);
}

enum check_status check_baseline_judge(
	const struct check_baseline *baseline, const char *name, enum check_status status)
{
	const struct check_known *known = find_known(baseline, name);
	if (known != NULL && status == known->status)
		return CHECK_EXPECTED_FAIL;
	if (known != NULL && status == CHECK_PASS)
		status = CHECK_UNEXPECTED_PASS;
	return check_status_is_unexpected(status) && find_pattern(&baseline->flakes, name) != NULL
		       ? CHECK_FLAKE
		       : status;
}

enum check_status check_attempts_judge(enum check_status first, enum check_status second)
{
	return check_status_is_unexpected(first) && !check_status_is_unexpected(second)
		       ? CHECK_FLAKE
		       : first;
}
