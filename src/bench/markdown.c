/* SPDX-License-Identifier: MIT */
#include "bench/markdown.h"
#include "bench/column.h"
#include "bench/frontier.h"
#include "bench/mean.h"
#include "bench/table.h"
#include <string.h>

void markdown_text(const char *text, FILE *file)
{
	for (; *text != '\0'; text++) {
		if (strchr("\\`*_[]<>|&#", *text) != NULL)
			fputc('\\', file);
		fputc((unsigned char)*text < 0x20 ? ' ' : *text, file);
	}
}

void markdown_rule(size_t columns, FILE *file)
{
	fputs("|---|", file);
	for (size_t i = 1; i < columns; i++)
		fputs("--:|", file);
	fputc('\n', file);
}

static void write_plot(const struct contents *contents, const struct result *setting,
	const struct result *scene, FILE *file)
{
	char name[FILE_NAME_MAX];
	if (!has_plot(contents, setting, scene))
		return;
	plot_file_name(contents, setting, scene, "svg", name);
	fprintf(file, "![Error against time by technique](%s)\n\n", name);
}

static void write_means(const struct contents *contents, const struct result *setting, FILE *file)
{
	const struct mean_column *column;
	size_t columns = 0;
	char text[160];
	setting_describe(setting, text, sizeof(text));
	fputs("Means over scenes, ", file);
	markdown_text(text, file);
	fputs(":\n\n| technique | scenes |", file);
	for (; (column = mean_column_at(columns)) != NULL; columns++)
		fprintf(file, " %s |", column->heading);
	fputc('\n', file);
	markdown_rule(2 + columns, file);
	for (size_t i = 0; i < contents->techniques.count; i++) {
		const struct result *technique = contents->techniques.items[i];
		struct mean mean = mean_of(contents->results, setting, technique, NULL);
		if (mean.scenes == 0)
			continue;
		fputs("| ", file);
		markdown_text(technique->technique, file);
		fprintf(file, " | %zu |", mean.scenes);
		for (size_t j = 0; j < columns; j++) {
			fputc(' ', file);
			mean_write(mean_column_at(j), &mean, file);
			fputs(" |", file);
		}
		fputc('\n', file);
	}
	fputc('\n', file);
}

static void write_row(const struct contents *contents, const struct result *result, FILE *file)
{
	const struct table_column *column = NULL;
	fputs("| ", file);
	markdown_text(result->technique, file);
	fputs(" |", file);
	while ((column = table_next_column(column, contents->results)) != NULL) {
		char text[TABLE_CELL_MAX];
		table_cell(column, result, text);
		fprintf(file,
			table_is_best(column, contents->results, result) ? " **%s** |" : " %s |",
			text);
	}
	fputc('\n', file);
}

static void write_table(const struct rows *rows, FILE *file)
{
	const struct result *setting = rows->setting, *row = NULL;
	const struct table_column *column = NULL;
	size_t columns = 0;
	char text[160];
	setting_describe(setting, text, sizeof(text));
	markdown_text(text, file);
	fprintf(file, "; errors at %ux%u, times at %ux%u:\n\n| technique |", setting->width,
		setting->height, setting->time_width, setting->time_height);
	for (; (column = table_next_column(column, rows->contents->results)) != NULL; columns++)
		fprintf(file, " %s |", table_heading(column));
	fputc('\n', file);
	markdown_rule(1 + columns, file);
	while ((row = rows_next(rows, row)) != NULL)
		write_row(rows->contents, row, file);
	fputc('\n', file);
	frontier_write(rows, markdown_text, file);
	fputs("\n\n", file);
}

static void write_scene(const struct contents *contents, const struct result *scene, FILE *file)
{
	fputs("## ", file);
	markdown_text(scene->scene, file);
	fprintf(file, "\n\n%u triangles.\n\n", scene->triangles);
	write_plot(contents, contents->main, scene, file);
	for (size_t i = 0; i < contents->settings.count; i++) {
		const struct rows rows = {contents, scene, contents->settings.items[i]};
		if (rows_next(&rows, NULL) != NULL)
			write_table(&rows, file);
	}
}

static void write_facts(const struct run_facts *facts, FILE *file)
{
	fputs("## How to repeat it\n\nAt commit ", file);
	markdown_text(run_facts_get(facts, "commit"), file);
	fprintf(file, ":\n\n\t%s\n\n| | |\n|---|---|\n", run_facts_get(facts, "command"));
	for (size_t i = 0; i < facts->count; i++) {
		fputs("| ", file);
		markdown_text(facts->items[i].key, file);
		fputs(" | ", file);
		markdown_text(facts->items[i].value, file);
		fputs(" |\n", file);
	}
}

static void write_columns(const struct result_list *list, FILE *file)
{
	const struct table_column *column = NULL;
	fputs("\n## Columns\n\nOf the tables:\n\n", file);
	while ((column = table_next_column(column, list)) != NULL)
		fprintf(file, "- %s: %s\n", table_heading(column), table_help(column));
	fputs("\nOf results.csv:\n\n", file);
	for (size_t i = 0; column_at(i) != NULL; i++)
		fprintf(file, "- `%s`: %s\n", column_at(i)->name, column_at(i)->help);
}

void markdown_write(const struct contents *contents, FILE *file)
{
	fputs("# Soft shadows: error against time\n\nWritten by `smoothie bench`. Errors are of "
	      "visibility, linear from 0 to 1, against a ray-traced reference, in pixels that see "
	      "a "
	      "part of the light; the best of each column is bold.\n\n",
		file);
	if (contents->main != NULL) {
		markdown_text(contents->main->machine, file);
		fputs(".\n\n", file);
		for (size_t i = 0; i < contents->settings.count; i++) {
			write_plot(contents, contents->settings.items[i], NULL, file);
			write_means(contents, contents->settings.items[i], file);
		}
		markdown_precisions(contents->results, file);
		frontier_write_alone(contents, markdown_text, file);
		fputs("\n\n", file);
	} else {
		fputs("Nothing was measured.\n\n", file);
	}
	for (size_t i = 0; i < contents->scenes.count; i++)
		write_scene(contents, contents->scenes.items[i], file);
	write_facts(contents->facts, file);
	write_columns(contents->results, file);
}
