/* SPDX-License-Identifier: MIT */
#include "bench/json.h"
#include "base/json.h"
#include "bench/column.h"
#include <math.h>

static void write_real(double value, FILE *file)
{
	char text[32];
	column_format_real(value, text);
	fputs(isfinite(value) ? text : "null", file);
}

static void write_passes(const struct pass_time *passes, FILE *file)
{
	fputc('{', file);
	for (size_t i = 0; i < PASSES_MAX && passes[i].name[0] != '\0'; i++) {
		fputs(i == 0 ? "" : ", ", file);
		json_string(file, passes[i].name);
		fputs(": ", file);
		write_real(passes[i].ms, file);
	}
	fputc('}', file);
}

static void write_value(const struct column *column, const struct result *result, FILE *file)
{
	const void *value = (const char *)result + column->offset;
	char text[COLUMN_TEXT_MAX];
	column_format(column, result, text);
	switch (column->type) {
	case COLUMN_TEXT:
		json_string(file, text);
		break;
	case COLUMN_REAL:
		write_real(*(const double *)value, file);
		break;
	case COLUMN_PASSES:
		write_passes(value, file);
		break;
	case COLUMN_COUNT32:
	case COLUMN_COUNT64:
		fputs(text, file);
		break;
	}
}

static void write_result(const struct result *result, FILE *file)
{
	for (size_t i = 0; column_at(i) != NULL; i++) {
		fprintf(file, "%s\"%s\": ", i == 0 ? "    {" : ", ", column_at(i)->name);
		write_value(column_at(i), result, file);
	}
	fputc('}', file);
}

void json_write(const struct result_list *list, const struct run_facts *facts, FILE *file)
{
	fputs("{\n  \"facts\": {", file);
	for (size_t i = 0; i < facts->count; i++) {
		fputs(i == 0 ? "\n    " : ",\n    ", file);
		json_string(file, facts->items[i].key);
		fputs(": ", file);
		json_string(file, facts->items[i].value);
	}
	fputs("\n  },\n  \"columns\": {", file);
	for (size_t i = 0; column_at(i) != NULL; i++) {
		fprintf(file, "%s\"%s\": ", i == 0 ? "\n    " : ",\n    ", column_at(i)->name);
		json_string(file, column_at(i)->help);
	}
	fputs("\n  },\n  \"results\": [\n", file);
	for (size_t i = 0; i < list->count; i++) {
		write_result(&list->items[i], file);
		fputs(i + 1 < list->count ? ",\n" : "\n", file);
	}
	fputs("  ]\n}\n", file);
}
