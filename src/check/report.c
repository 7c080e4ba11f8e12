/* SPDX-License-Identifier: MIT */
#include "check/report.h"
#include "page/escape.h"
#include <limits.h>

/* As deqp-runner does, without a header. */
static void print_line(const char *name, enum check_status status, FILE *file)
{
	escape_csv(name, file);
	fprintf(file, ",%s", check_status_name(status));
}

void check_print_results(FILE *file, const void *data)
{
	const struct check_run *run = ((const struct check_report *)data)->run;
	for (size_t i = 0; i < run->count; i++) {
		print_line(run->results[i].name, run->results[i].status, file);
		fprintf(file, ",%.6f\n", run->results[i].seconds);
	}
}

/* How a case fails, whether a baseline says so or not; CHECK_PASS where it does not. */
static enum check_status failure_of(const struct check_result *result)
{
	switch (result->status) {
	case CHECK_FAIL:
	case CHECK_CRASH:
	case CHECK_TIMEOUT:
		return result->status;
	case CHECK_EXPECTED_FAIL:
		return result->first_status;
	default:
		return CHECK_PASS;
	}
}

void check_print_failures(FILE *file, const void *data)
{
	const struct check_run *run = ((const struct check_report *)data)->run;
	for (size_t i = 0; i < run->count; i++) {
		enum check_status status = failure_of(&run->results[i]);
		if (status == CHECK_PASS)
			continue;
		print_line(run->results[i].name, status, file);
		fputc('\n', file);
	}
}

bool check_report_path(const char *folder, const char *name, char *path, struct sm_error *error)
{
	return snprintf(path, PATH_MAX, "%s/%s", folder, name) < PATH_MAX ||
	       error_set(error, SM_ERROR_INPUT, "the path of the folder %.100s... is too long",
		       folder);
}

static bool write_part(const struct check_report *report, const char *name,
	void (*print)(FILE *file, const void *data), struct sm_error *error)
{
	char path[PATH_MAX];
	return check_report_path(report->folder, name, path, error) &&
	       file_print(path, print, report, report->write, error);
}

bool check_report_results(const struct check_report *report, struct sm_error *error)
{
	return write_part(report, "results.csv", check_print_results, error);
}

bool check_report_write(const struct check_report *report, struct sm_error *error)
{
	return check_report_results(report, error) &&
	       write_part(report, "failures.csv", check_print_failures, error) &&
	       write_part(report, "junit.xml", check_print_junit, error) &&
	       write_part(report, "report.html", check_print_page, error);
}
