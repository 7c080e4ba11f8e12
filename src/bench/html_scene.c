/* SPDX-License-Identifier: MIT */
#include "bench/frontier.h"
#include "bench/html.h"
#include "bench/table.h"
#include "page/escape.h"
#include <string.h>

static void write_headings(const struct contents *contents, FILE *file)
{
	const struct table_column *column = NULL;
	fputs("<thead><tr><th scope=\"col\">technique</th>", file);
	while ((column = table_next_column(column, contents->results)) != NULL) {
		fputs("<th scope=\"col\" title=\"", file);
		escape_markup(table_help(column), file);
		fputs("\">", file);
		escape_markup(table_heading(column), file);
		fputs("</th>", file);
	}
	fputs("</tr></thead>\n", file);
}

static void write_row(const struct contents *contents, const struct result *result, FILE *file)
{
	const struct table_column *column = NULL;
	fputs("<tr><th scope=\"row\">", file);
	escape_markup(result->technique, file);
	fputs("</th>", file);
	while ((column = table_next_column(column, contents->results)) != NULL) {
		bool best = table_is_best(column, contents->results, result);
		char text[TABLE_CELL_MAX];
		table_cell(column, result, text);
		fprintf(file, best ? "<td class=\"best\"><strong>%s</strong></td>" : "<td>%s</td>",
			text);
	}
	fputs("</tr>\n", file);
}

static void write_table(const struct rows *rows, FILE *file)
{
	const struct result *setting = rows->setting, *row = NULL;
	char text[160];
	setting_describe(setting, text, sizeof(text));
	fputs("<div class=\"scroll\"><table>\n<caption>", file);
	escape_markup(text, file);
	fprintf(file, "; errors at %u&times;%u, times at %u&times;%u pixels</caption>\n",
		setting->width, setting->height, setting->time_width, setting->time_height);
	write_headings(rows->contents, file);
	fputs("<tbody>\n", file);
	while ((row = rows_next(rows, row)) != NULL)
		write_row(rows->contents, row, file);
	fputs("</tbody></table></div>\n<p>", file);
	frontier_write(rows, escape_markup, file);
	fputs("</p>\n", file);
}

static double passes_total(const struct result *result)
{
	double sum = 0;
	for (size_t i = 0; i < PASSES_MAX && result->passes[i].name[0] != '\0'; i++)
		if (result->passes[i].ms > 0)
			sum += result->passes[i].ms;
	return sum;
}

static void write_bar(const struct contents *contents, const struct result *result, FILE *file)
{
	fputs("<tr><th scope=\"row\">", file);
	escape_markup(result->technique, file);
	fputs("</th><td><div class=\"bar\">", file);
	for (size_t i = 0; i < PASSES_MAX && result->passes[i].name[0] != '\0'; i++) {
		const struct pass_time *pass = &result->passes[i];
		fprintf(file, "<span class=\"p%zu\" style=\"width:%.2f%%\" title=\"",
			pass_number(contents, pass->name) % 8,
			pass->ms > 0 ? 100 * pass->ms / passes_total(result) : 0);
		escape_markup(pass->name, file);
		fprintf(file, ": %.2f ms\"></span>", pass->ms);
	}
	fprintf(file, "</div></td><td>%.2f ms</td></tr>\n", passes_total(result));
}

static bool has_pass(const struct result *result, const char *name)
{
	for (size_t i = 0; i < PASSES_MAX && result->passes[i].name[0] != '\0'; i++)
		if (strcmp(result->passes[i].name, name) == 0)
			return true;
	return false;
}

static bool any_has_pass(const struct rows *rows, const char *name)
{
	const struct result *row = NULL;
	while ((row = rows_next(rows, row)) != NULL)
		if (has_pass(row, name))
			return true;
	return false;
}

static void write_legend(const struct rows *rows, FILE *file)
{
	fputs("<p class=\"legend\">", file);
	for (size_t i = 0; i < rows->contents->pass_count; i++) {
		if (!any_has_pass(rows, rows->contents->passes[i]))
			continue;
		fprintf(file, "<span><i class=\"p%zu\"></i>", i % 8);
		escape_markup(rows->contents->passes[i], file);
		fputs("</span> ", file);
	}
	fputs("</p>\n", file);
}

static bool any_has_passes(const struct rows *rows)
{
	const struct result *row = NULL;
	while ((row = rows_next(rows, row)) != NULL)
		if (passes_total(row) > 0)
			return true;
	return false;
}

static void write_passes(const struct rows *rows, FILE *file)
{
	const struct result *row = NULL;
	if (!any_has_passes(rows))
		return;
	fputs("<h4>Shares of passes</h4>\n", file);
	write_legend(rows, file);
	fputs("<table class=\"bars\"><tbody>\n", file);
	while ((row = rows_next(rows, row)) != NULL)
		if (passes_total(row) > 0)
			write_bar(rows->contents, row, file);
	fputs("</tbody></table>\n", file);
}

static void write_difference(const struct result *result, FILE *file)
{
	char name[FILE_NAME_MAX];
	difference_file_name(result, name);
	fprintf(file, "<figure><a href=\"%s\"><img loading=\"lazy\" src=\"%s\" alt=\"Reference, ",
		name, name);
	escape_markup(result->technique, file);
	fputs(" and their difference\"></a><figcaption>", file);
	escape_markup(result->technique, file);
	if (result->error[REGION_PENUMBRA].pixels > 0)
		fprintf(file, ": RMSE %.4f", result->error[REGION_PENUMBRA].rmse);
	fputs("</figcaption></figure>\n", file);
}

static void write_differences(const struct rows *rows, FILE *file)
{
	const struct result *row = NULL;
	size_t count = 0;
	while ((row = rows_next(rows, row)) != NULL) {
		if (!has_difference(rows->contents, row))
			continue;
		if (count++ == 0)
			fputs("<h4>Reference, technique, difference</h4>\n<p class=\"scale\">too "
			      "dark <i></i> too bright</p>\n<div class=\"differences\">\n",
				file);
		write_difference(row, file);
	}
	if (count > 0)
		fputs("</div>\n", file);
}

static void write_sheet(const struct rows *rows, FILE *file)
{
	const struct result *row = rows_next(rows, NULL);
	char name[FILE_NAME_MAX];
	if (!has_sheet(rows->contents, row))
		return;
	sheet_file_name(row, name);
	fprintf(file,
		"<h4>Side by side</h4>\n<figure><a href=\"%s\"><img loading=\"lazy\" src=\"%s\" "
		"alt=\"Where the penumbra is widest, the reference and each technique above its "
		"difference from that\"></a></figure>\n",
		name, name);
}

/* What is of another setting than the main one. */
static void write_details(const struct rows *rows, FILE *file)
{
	char text[160];
	setting_describe(rows->setting, text, sizeof(text));
	fputs("<details><summary>", file);
	escape_markup(text, file);
	fputs("</summary>\n", file);
	write_table(rows, file);
	write_sheet(rows, file);
	write_differences(rows, file);
	fputs("</details>\n", file);
}

void html_write_scene(const struct contents *contents, const struct result *scene, FILE *file)
{
	fprintf(file, "<section id=\"scene-%zu\">\n<h3>",
		distinct_find(&contents->scenes, scene, same_scene));
	escape_markup(scene->scene, file);
	fprintf(file, "</h3>\n<p>%u triangles.</p>\n", scene->triangles);
	const struct rows main = {contents, scene, contents->main};
	if (rows_next(&main, NULL) != NULL) {
		html_write_plot(contents, contents->main, scene, file);
		write_table(&main, file);
		write_passes(&main, file);
		write_sheet(&main, file);
		write_differences(&main, file);
	}
	for (size_t i = 0; i < contents->settings.count; i++) {
		const struct rows rows = {contents, scene, contents->settings.items[i]};
		if (rows.setting != contents->main && rows_next(&rows, NULL) != NULL)
			write_details(&rows, file);
	}
	fputs("</section>\n", file);
}
