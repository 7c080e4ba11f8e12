/* SPDX-License-Identifier: MIT */
#include "app/bench_output.h"
#include "app/output.h"
#include "bench/csv.h"
#include "bench/report.h"
#include "page/file.h"
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* PATH_MAX bytes of path. */
static bool file_path(const char *folder, const char *name, char *path, struct sm_error *error)
{
	return snprintf(path, PATH_MAX, "%s/%s", folder, name) < PATH_MAX ||
	       error_set(error, SM_ERROR_INPUT, "--out: the name is too long");
}

bool bench_output_prepare(const char *folder, struct sm_error *error)
{
	char csv[PATH_MAX], differences[PATH_MAX], sheets[PATH_MAX];
	return file_path(folder, "results.csv", csv, error) &&
	       file_path(folder, "differences", differences, error) &&
	       file_path(folder, "sheets", sheets, error) && report_make_folder(folder, error) &&
	       output_check(csv, error) && report_make_folder(differences, error) &&
	       report_make_folder(sheets, error);
}

bool bench_output_file(const char *folder, const char *name,
	void (*print)(FILE *file, const void *data), const void *data, struct sm_error *error)
{
	char path[PATH_MAX];
	return file_path(folder, name, path, error) &&
	       file_print(path, print, data, output_write, error);
}

bool bench_output_read(struct result_list *results, const char *path, struct sm_error *error)
{
	FILE *file = fopen(path, "re");
	if (file == NULL)
		return error_set(
			error, SM_ERROR_INPUT, "cannot read %.300s (%s)", path, strerror(errno));
	bool read = csv_read(results, file, path, error);
	fclose(file);
	return read;
}

void bench_output_head(FILE *file)
{
	fprintf(file, "%-12s %5s %5s %-20s %-9s %8s %7s %7s %7s %7s %8s %9s %7s %7s\n", "scene",
		"R/d", "map", "technique", "precision", "penumbra", "p99", "bias", "all", "outside",
		"flicker", "ms", "x hard", "x pcss");
}

/* NAN: not measured. */
static void print_number(FILE *file, int width, int digits, double value)
{
	if (isnan(value))
		fprintf(file, " %*s", width, "-");
	else
		fprintf(file, " %*.*f", width, digits, value);
}

static void print_row(FILE *file, const struct result *result)
{
	const struct error_summary *penumbra = &result->error[REGION_PENUMBRA];
	const struct time_summary *time = &result->time[THREADS_DEFAULT];
	fprintf(file, "%-12s %5.3g %5u %-20s %-9s", result->scene, result->radius, result->map,
		result->technique, result->precision);
	print_number(file, 8, 4, penumbra->rmse);
	print_number(file, 7, 3, penumbra->p99);
	print_number(file, 7, 3, penumbra->bias);
	print_number(file, 7, 4, result->error[REGION_ALL].rmse);
	print_number(file, 7, 0, result->outside_wrong);
	print_number(file, 8, 5, result->flicker);
	print_number(file, 9, 2, time->median > 0 ? time->median : NAN);
	print_number(file, 7, 2, time->ratio > 0 ? time->ratio : NAN);
	print_number(file, 7, 2, time->ratio_pcss > 0 ? time->ratio_pcss : NAN);
	fputc('\n', file);
}

bool bench_output_rows(
	FILE *file, const struct result_list *results, size_t first, struct sm_error *error)
{
	for (size_t i = first; i < results->count; i++)
		print_row(file, &results->items[i]);
	return fflush(file) == 0 ||
	       error_set(error, SM_ERROR_MACHINE, "cannot write the table (%s)", strerror(errno));
}
