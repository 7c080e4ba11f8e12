/* SPDX-License-Identifier: MIT */
#include "bench/csv.h"
#include "base/array.h"
#include "bench/column.h"
#include "page/escape.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void write_row(const struct result *result, FILE *file)
{
	char text[COLUMN_TEXT_MAX];
	for (size_t i = 0; column_at(i) != NULL; i++) {
		column_format(column_at(i), result, text);
		fputs(i == 0 ? "" : ",", file);
		escape_csv(text, file);
	}
	fputc('\n', file);
}

void csv_write(const struct result_list *list, FILE *file)
{
	for (size_t i = 0; column_at(i) != NULL; i++)
		fprintf(file, "%s%s", i == 0 ? "" : ",", column_at(i)->name);
	fputc('\n', file);
	for (size_t i = 0; i < list->count; i++)
		write_row(&list->items[i], file);
}

/* Where a field ended. */
enum stop { STOP_COMMA, STOP_LINE, STOP_FILE, STOP_ERROR };

struct reader {
	FILE *file;       /* not owned */
	const char *name; /* not owned */
	size_t line;      /* of what is read next */
	char *text;       /* the last field; owned */
	size_t length, capacity;
	/* By place in a line: the columns of the header, NULL where not known; owned. */
	const struct column **columns;
	size_t column_count, column_capacity;
	struct sm_error *error; /* may be NULL */
};

static bool add_character(struct reader *reader, int c)
{
	void *text = reader->text;
	if (!array_reserve(&text, &reader->capacity, reader->length + 1, 1))
		return error_no_memory(reader->error);
	reader->text = text;
	reader->text[reader->length++] = (char)c;
	return true;
}

static bool refuse(const struct reader *reader, const char *problem)
{
	return error_set(reader->error, SM_ERROR_INPUT, "%.300s:%zu: %s", reader->name,
		reader->line, problem);
}

/* The next character; the end of a line, however it is written, is '\n'. */
static int next_character(struct reader *reader)
{
	int c = getc(reader->file);
	if (c != '\r')
		return c;
	c = getc(reader->file);
	if (c != '\n')
		ungetc(c, reader->file);
	return '\n';
}

/* Reads what stands between quotes, the first of which is read. */
static bool read_quoted(struct reader *reader)
{
	size_t first = reader->line;
	for (;;) {
		int c = getc(reader->file);
		if (c == EOF) {
			reader->line = first;
			return refuse(reader, "a quote is never closed");
		}
		if (c == '"' && (c = getc(reader->file)) != '"') {
			ungetc(c, reader->file);
			return true;
		}
		reader->line += c == '\n';
		if (!add_character(reader, c))
			return false;
	}
}

static enum stop end_field(struct reader *reader, enum stop stop)
{
	return add_character(reader, '\0') ? stop : STOP_ERROR;
}

static enum stop read_field(struct reader *reader)
{
	bool quoted = false;
	reader->length = 0;
	for (;;) {
		int c = next_character(reader);
		if (c == ',')
			return end_field(reader, STOP_COMMA);
		if (c == '\n')
			return end_field(reader, STOP_LINE);
		if (c == EOF)
			return end_field(reader, STOP_FILE);
		if (quoted || c == '\0') {
			refuse(reader, quoted ? "text follows a closed quote" : "a byte is 0");
			return STOP_ERROR;
		}
		if (c == '"' && reader->length == 0) {
			quoted = true;
			if (!read_quoted(reader))
				return STOP_ERROR;
		} else if (!add_character(reader, c)) {
			return STOP_ERROR;
		}
	}
}

static bool add_column(struct reader *reader)
{
	void *columns = reader->columns;
	const struct column *column = column_at(column_find(reader->text));
	for (size_t i = 0; column != NULL && i < reader->column_count; i++)
		if (reader->columns[i] == column)
			return error_set(reader->error, SM_ERROR_INPUT,
				"%.300s:%zu: two columns are named \"%s\"", reader->name,
				reader->line, column->name);
	if (!array_reserve(&columns, &reader->column_capacity, reader->column_count + 1,
		    sizeof(*reader->columns)))
		return error_no_memory(reader->error);
	reader->columns = columns;
	reader->columns[reader->column_count++] = column;
	return true;
}

static bool require_column(const struct reader *reader, const char *name)
{
	for (size_t i = 0; i < reader->column_count; i++)
		if (reader->columns[i] == column_at(column_find(name)))
			return true;
	return error_set(reader->error, SM_ERROR_INPUT,
		"%.300s:1: no column is named \"%s\"; is this a results.csv?", reader->name, name);
}

static bool read_header(struct reader *reader, enum stop *stop)
{
	do {
		*stop = read_field(reader);
		if (*stop == STOP_ERROR || !add_column(reader))
			return false;
	} while (*stop == STOP_COMMA);
	return require_column(reader, "scene") && require_column(reader, "technique");
}

static bool read_value(struct reader *reader, size_t place, struct result *result)
{
	if (place >= reader->column_count)
		return refuse(reader, "there are more values than columns");
	const struct column *column = reader->columns[place];
	const char *problem = column != NULL ? column_parse(column, result, reader->text) : NULL;
	return problem == NULL ||
	       error_set(reader->error, SM_ERROR_INPUT, "%.300s:%zu: %s \"%.60s\" %s", reader->name,
		       reader->line, column->name, reader->text, problem);
}

/* A result of which nothing is known. */
static struct result unknown_result(void)
{
	struct result result = {0};
	for (size_t i = 0; column_at(i) != NULL; i++)
		if (column_at(i)->type == COLUMN_REAL)
			column_parse(column_at(i), &result, "");
	return result;
}

static bool read_row(struct reader *reader, enum stop *stop, struct result_list *list)
{
	struct result result = unknown_result();
	size_t count = 0;
	do {
		*stop = read_field(reader);
		if (*stop == STOP_ERROR)
			return false;
		bool empty = count == 0 && *stop != STOP_COMMA && reader->text[0] == '\0';
		if (empty)
			return true;
		if (!read_value(reader, count++, &result))
			return false;
	} while (*stop == STOP_COMMA);
	if (count < reader->column_count)
		return refuse(reader, "there are fewer values than columns");
	return result_list_add(list, &result, reader->error);
}

static bool read_all(struct reader *reader, struct result_list *list)
{
	enum stop stop;
	bool read = read_header(reader, &stop);
	while (read && stop != STOP_FILE) {
		reader->line++;
		read = read_row(reader, &stop, list);
	}
	return read;
}

bool csv_read(struct result_list *list, FILE *file, const char *file_name, struct sm_error *error)
{
	struct reader reader = {.file = file, .name = file_name, .line = 1, .error = error};
	errno = 0;
	bool read = read_all(&reader, list);
	if (ferror(file))
		read = error_set(error, SM_ERROR_MACHINE, "cannot read %.300s (%s)", file_name,
			strerror(errno));
	free(reader.text);
	free(reader.columns);
	return read;
}
