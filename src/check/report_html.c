/* SPDX-License-Identifier: MIT */
#include "bench/difference.h"
#include "check/report_page.h"
#include "check/report_text.h"
#include "page/escape.h"
#include "page/page.h"
#include <inttypes.h>
#include <time.h>

static void print_head(FILE *file)
{
	page_begin("smoothie check", file);
	fputs("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
	      "img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n",
		file);
	fprintf(file, "<style>\n%s.scale i{background:", report_css);
	difference_write_gradient(file);
	fputs("}\n</style>\n", file);
	page_body(file);
}

static void print_when(const struct check_run *run, FILE *file)
{
	char text[32] = "";
	struct tm parts;
	time_t started = (time_t)run->started;
	if (gmtime_r(&started, &parts) != NULL)
		strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", &parts);
	fprintf(file, "<p class=\"soft\">%s, %.1f s, %" PRIu32 " job%s", text, run->seconds,
		run->jobs, run->jobs == 1 ? "" : "s");
	if (run->fraction > 1)
		fprintf(file, ", one case in %" PRIu32 ", from case %" PRIu32 " on", run->fraction,
			run->fraction_start);
	fputs("; <a href=\"results.csv\">results.csv</a>, "
	      "<a href=\"failures.csv\">failures.csv</a>, "
	      "<a href=\"junit.xml\">junit.xml</a></p>\n",
		file);
}

/* How many of each status, and where to find what. */
static void print_counts(const struct check_run *run, FILE *file)
{
	fputs("<nav><p>", file);
	for (int i = 0; i < CHECK_STATUS_COUNT; i++) {
		enum check_status status = (enum check_status)i;
		size_t count = check_run_count(run, status);
		if (count > 0)
			fprintf(file, "<span class=\"tag %s\">%zu %s</span> ", page_class(status),
				count, check_status_name(status));
	}
	fputs("<span class=\"links\"><a href=\"#results\">all results</a> &middot; "
	      "<a href=\"#driver\">driver and run</a></span></p></nav>\n",
		file);
}

static void print_verdict(const struct check_run *run, FILE *file)
{
	size_t unexpected = check_run_count_unexpected(run);
	bool passed = unexpected == 0 && run->complete;
	fputs("<header>\n<div class=\"verdict\"><h1>smoothie check</h1> ", file);
	if (unexpected > 0)
		fprintf(file, "<span class=\"tag bad\">%zu of %zu unexpected</span>", unexpected,
			run->count);
	else
		fprintf(file, "<span class=\"tag %s\">%zu as expected</span>",
			passed ? "good" : "odd", run->count);
	fputs("</div>\n<p><span class=\"driver\">", file);
	escape_markup(check_run_fact(run, "renderer"), file);
	fputs("</span><br><span class=\"soft\">", file);
	escape_markup(check_run_fact(run, "version"), file);
	fputs("</span></p>\n", file);
	print_when(run, file);
	if (!run->complete)
		fputs("<p class=\"note\">The run ended before all cases had.</p>\n", file);
	print_counts(run, file);
	fputs("</header>\n", file);
}

static void print_filter(const struct check_run *run, FILE *file)
{
	fputs("<div class=\"filter\" role=\"search\">\n", file);
	for (int i = 0; i < CHECK_STATUS_COUNT; i++) {
		enum check_status status = (enum check_status)i;
		size_t count = check_run_count(run, status);
		if (count > 0)
			fprintf(file,
				"<button type=\"button\" class=\"%s\" data-status=\"%s\" "
				"aria-pressed=\"false\">%s <b>%zu</b></button>\n",
				page_class(status), check_status_name(status),
				check_status_name(status), count);
	}
	fputs("<input type=\"search\" placeholder=\"part of a name\" "
	      "aria-label=\"Cases whose name has\">\n<output></output>\n</div>\n",
		file);
}

static void print_headings(FILE *file)
{
	static const struct {
		const char *class, *name;
	} columns[] = {{"", "status"}, {"name", "case"}, {"", "seconds"}, {"wide", "pixels"},
		{"wide", "mean"}, {"wide", "largest"}};
	fputs("<thead><tr>", file);
	for (size_t i = 0; i < sizeof(columns) / sizeof(columns[0]); i++)
		fprintf(file,
			"<th scope=\"col\" class=\"%s\"><button type=\"button\">%s</button></th>",
			columns[i].class, columns[i].name);
	fputs("</tr></thead>\n", file);
}

static void print_name(const struct check_run *run, size_t index, FILE *file)
{
	const struct check_result *result = &run->results[index];
	bool linked = page_has_case(result);
	fputs("<td class=\"name\">", file);
	if (linked)
		fprintf(file, "<a href=\"#case-%zu\">", index);
	escape_markup(result->name, file);
	fputs(linked ? "</a>" : "", file);
	if (result->message[0] != '\0') {
		fputs("<small>", file);
		escape_markup(result->message, file);
		fputs("</small>", file);
	}
	fputs("</td>", file);
}

static void print_difference(const struct check_difference *difference, FILE *file)
{
	if (difference->pixels == 0) {
		for (int i = 0; i < 3; i++)
			fputs("<td class=\"wide\" data-value=\"-1\"></td>", file);
		return;
	}
	fprintf(file,
		"<td class=\"wide\" data-value=\"%" PRIu64 "\">%" PRIu64
		"</td><td class=\"wide\" data-value=\"%.9g\">%.2g</td><td class=\"wide\" "
		"data-value=\"%.9g\">%.2g</td>",
		difference->failing, difference->failing, difference->mean, difference->mean,
		difference->max, difference->max);
}

static void print_row(const struct check_run *run, size_t index, FILE *file)
{
	const struct check_result *result = &run->results[index];
	fprintf(file, "<tr data-status=\"%s\" data-name=\"", check_status_name(result->status));
	escape_markup(result->name, file);
	fputs("\"><td>", file);
	page_print_status(result->status, file);
	fputs("</td>", file);
	print_name(run, index, file);
	fprintf(file, "<td data-value=\"%.6f\">%.2f</td>", result->seconds, result->seconds);
	print_difference(&result->difference, file);
	fputs("</tr>\n", file);
}

static void print_table(const struct check_run *run, FILE *file)
{
	fputs("<h2 id=\"results\">Results</h2>\n", file);
	print_filter(run, file);
	fputs("<table class=\"results\">\n", file);
	print_headings(file);
	fputs("<tbody>\n", file);
	for (size_t i = 0; i < run->count; i++)
		print_row(run, i, file);
	fputs("</tbody></table>\n", file);
}

static void print_cases(const struct check_report *report, bool unexpected, FILE *file)
{
	const struct check_run *run = report->run;
	size_t count = 0;
	for (size_t i = 0; i < run->count; i++) {
		enum check_status status = run->results[i].status;
		if (!page_has_case(&run->results[i]) ||
			check_status_is_unexpected(status) != unexpected)
			continue;
		if (count++ == 0)
			fprintf(file, "<h2>%s</h2>\n",
				unexpected ? "Unexpected" : "Expected failures and flakes");
		page_print_case(report, i, file);
	}
}

static void print_facts(const struct check_run *run, FILE *file)
{
	fputs("<h2 id=\"driver\">Driver and run</h2>\n<table class=\"facts\"><tbody>\n", file);
	for (size_t i = 0; i < run->fact_count; i++)
		page_pair(run->facts[i].key, run->facts[i].value, file);
	fputs("</tbody></table>\n", file);
}

void check_print_page(FILE *file, const void *data)
{
	const struct check_report *report = data;
	print_head(file);
	print_verdict(report->run, file);
	print_cases(report, true, file);
	print_table(report->run, file);
	print_cases(report, false, file);
	print_facts(report->run, file);
	fprintf(file, "<script>\n%s</script>\n", report_js);
	page_end(file);
}
