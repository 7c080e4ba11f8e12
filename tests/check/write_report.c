/* SPDX-License-Identifier: MIT */
/* Writes the report of a synthetic run into a folder that is there, and TAP to standard output:
 * write_report FOLDER. */
#include "app/output.h"
#include "check/report.h"
#include "synthetic.h"

static void print_tap(const struct check_run *run)
{
	check_tap_begin(stdout, run->count);
	for (size_t i = 0; i < run->count; i++)
		check_tap_result(stdout, i + 1, &run->results[i]);
}

int main(int argc, char **argv)
{
	struct sm_error error = {0};
	struct check_run run = {0};
	const struct check_report report = {argc > 1 ? argv[1] : ".", &run, output_write};
	bool written = synthetic_run(&run, report.folder, output_write, &error) &&
		       check_report_write(&report, &error);
	if (written)
		print_tap(&run);
	else
		fprintf(stderr, "%s\n", error.text);
	check_run_finish(&run);
	return written ? 0 : 1;
}
