/* SPDX-License-Identifier: MIT */
#include "check/report.h"
#include "page/escape.h"
#include <inttypes.h>
#include <string.h>
#include <time.h>

/* The element of a status, NULL for none: what is known and accepted does not break a build, but
 * is not counted as passed either. */
static const char *element_of(enum check_status status)
{
	switch (status) {
	case CHECK_FAIL:
	case CHECK_UNEXPECTED_PASS:
		return "failure";
	case CHECK_CRASH:
	case CHECK_TIMEOUT:
		return "error";
	case CHECK_SKIP:
	case CHECK_EXPECTED_FAIL:
		return "skipped";
	default:
		return NULL;
	}
}

static size_t count_elements(const struct check_run *run, const char *element)
{
	size_t count = 0;
	for (size_t i = 0; i < run->count; i++) {
		const char *of = element_of(run->results[i].status);
		count += of != NULL && strcmp(of, element) == 0;
	}
	return count;
}

static void print_attribute(const char *name, const char *value, FILE *file)
{
	fprintf(file, " %s=\"", name);
	escape_markup(value, file);
	fputc('"', file);
}

static void print_totals(const struct check_run *run, FILE *file)
{
	fprintf(file,
		" tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" skipped=\"%zu\" time=\"%.3f\"",
		run->count, count_elements(run, "failure"), count_elements(run, "error"),
		count_elements(run, "skipped"), run->seconds);
}

static void print_suite(const struct check_run *run, FILE *file)
{
	char text[32];
	struct tm parts;
	time_t started = (time_t)run->started;
	fputs("<testsuite name=\"smoothie check\"", file);
	print_totals(run, file);
	if (gmtime_r(&started, &parts) != NULL &&
		strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S", &parts) > 0)
		print_attribute("timestamp", text, file);
	fputs(">\n<properties>\n", file);
	for (size_t i = 0; i < run->fact_count; i++) {
		fputs("<property", file);
		print_attribute("name", run->facts[i].key, file);
		print_attribute("value", run->facts[i].value, file);
		fputs("/>\n", file);
	}
	fputs("</properties>\n", file);
}

/* "picture" of "picture.smoothie.float.fence": what servers group by. */
static void print_class(const char *name, FILE *file)
{
	char group[CHECK_NAME_SIZE] = "";
	size_t length = strcspn(name, ".");
	if (length < sizeof(group))
		memcpy(group, name, length);
	print_attribute("classname", group, file);
}

static void print_difference(const struct check_difference *difference, FILE *file)
{
	if (difference->pixels == 0)
		return;
	fprintf(file,
		"%" PRIu64 " of %" PRIu64 " pixels differ by more than %g (%" PRIu64
		" may); mean %g, largest %g\n",
		difference->failing, difference->pixels, difference->tolerance, difference->budget,
		difference->mean, difference->max);
}

static void print_outcome(const struct check_result *result, FILE *file)
{
	const char *element = element_of(result->status);
	if (element == NULL)
		return;
	fprintf(file, "<%s", element);
	if (strcmp(element, "skipped") != 0)
		print_attribute("type", check_status_name(result->status), file);
	fprintf(file, " message=\"%s: ", check_status_name(result->status));
	escape_markup(result->message, file);
	fputs("\">", file);
	print_difference(&result->difference, file);
	fprintf(file, "</%s>\n", element);
}

/* Servers show what "[[ATTACHMENT|PATH]]" names, some the first of them alone: the difference says
 * most. */
static void print_attachments(
	const struct check_report *report, const struct check_result *result, FILE *file)
{
	const char *const paths[] = {
		result->pictures.difference, result->pictures.result, result->pictures.reference};
	for (size_t i = 0; i < sizeof(paths) / sizeof(paths[0]); i++) {
		if (paths[i][0] == '\0')
			continue;
		fputs("[[ATTACHMENT|", file);
		escape_markup(report->folder, file);
		fputc('/', file);
		escape_markup(paths[i], file);
		fputs("]]\n", file);
	}
	if (result->pictures.difference[0] != '\0')
		fprintf(file, "%s has the full red where the result is too bright by %g or more\n",
			result->pictures.difference, check_difference_full(result->difference.max));
}

static void print_output(
	const struct check_report *report, const struct check_result *result, FILE *file)
{
	if (element_of(result->status) == NULL && result->message[0] == '\0' &&
		result->pictures.difference[0] == '\0')
		return;
	fprintf(file, "<system-out>%s: ", check_status_name(result->status));
	escape_markup(result->message, file);
	fprintf(file, "\nattempts: %" PRIu32 "\n", result->attempts);
	print_attachments(report, result, file);
	fputs("</system-out>\n", file);
}

static void print_case(
	const struct check_report *report, const struct check_result *result, FILE *file)
{
	fputs("<testcase", file);
	print_class(result->name, file);
	print_attribute("name", result->name, file);
	fprintf(file, " time=\"%.3f\">\n", result->seconds);
	print_outcome(result, file);
	print_output(report, result, file);
	fputs("</testcase>\n", file);
}

void check_print_junit(FILE *file, const void *data)
{
	const struct check_report *report = data;
	const struct check_run *run = report->run;
	fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites", file);
	print_totals(run, file);
	fputs(">\n", file);
	print_suite(run, file);
	for (size_t i = 0; i < run->count; i++)
		print_case(report, &run->results[i], file);
	fputs("</testsuite>\n</testsuites>\n", file);
}
