/* SPDX-License-Identifier: MIT */
#include "app/check_output.h"
#include "app/output.h"
#include "app/stopwatch.h"
#include "bench/report.h"
#include "check/report.h"
#include <errno.h>
#include <string.h>

static const double interval = 2000; /* ms between files of a run that goes on */

/* Where a folder cannot be written, another machine may well: the run fails, not the command. */
static bool as_machine(bool done, struct sm_error *error)
{
	if (!done)
		error->status = SM_ERROR_MACHINE;
	return done;
}

static struct check_report report(const struct check_output *output)
{
	return (struct check_report){
		.folder = output->options->output, .run = output->run, .write = output_write};
}

static bool write_all(struct check_output *output, struct sm_error *error)
{
	struct check_report files = report(output);
	return output->options->output == NULL ||
	       as_machine(check_report_write(&files, error), error);
}

static bool write_results(struct check_output *output, struct sm_error *error)
{
	struct check_report files = report(output);
	output->written = stopwatch_now();
	return output->options->output == NULL ||
	       as_machine(check_report_results(&files, error), error);
}

static bool flush(struct sm_error *error)
{
	return fflush(stdout) == 0 ||
	       error_set(error, SM_ERROR_MACHINE, "cannot write the outcome (%s)", strerror(errno));
}

bool check_output_begin(struct check_output *output, const struct check_options *options,
	const struct check_run *run, size_t count, struct sm_error *error)
{
	*output = (struct check_output){.options = options, .run = run};
	if (options->output != NULL &&
		!as_machine(report_make_folder(options->output, error), error))
		return false;
	/* Whatever ends this run, none of the files is of one before. */
	if (!write_all(output, error))
		return false;
	output->written = stopwatch_now();
	if (options->tap)
		check_tap_begin(stdout, count);
	else
		printf("%s, device %s\n%s; %s; pictures of %s; %zu cases, %u at a time\n",
			check_run_fact(run, "renderer"), check_run_fact(run, "device"),
			check_run_fact(run, "version"), check_run_fact(run, "class of drivers"),
			check_run_fact(run, "size of pictures"), count, run->jobs);
	progress_start(&output->progress, (uint32_t)count, options->common.verbosity < 0);
	return flush(error);
}

static bool is_worth_a_line(const struct check_output *output, const struct check_result *result)
{
	return output->options->common.verbosity > 0 ||
	       check_status_is_unexpected(result->status) || result->status == CHECK_FLAKE;
}

bool check_output_result(
	struct check_output *output, const struct check_result *result, struct sm_error *error)
{
	output->told++;
	if (output->options->tap) {
		progress_finish(&output->progress);
		check_tap_result(stdout, output->told, result);
	} else if (is_worth_a_line(output, result)) {
		progress_finish(&output->progress);
		printf("%s %s (%.2f s)%s%s\n", check_status_name(result->status), result->name,
			result->seconds, result->message[0] != '\0' ? ": " : "", result->message);
	}
	if (!flush(error))
		return false;
	return stopwatch_now() - output->written < interval || write_results(output, error);
}

static void print_summary(const struct check_run *run)
{
	for (size_t i = 0; i < CHECK_STATUS_COUNT; i++) {
		enum check_status status = (enum check_status)i;
		size_t count = check_run_count(run, status);
		if (count > 0)
			printf("%-15s %zu\n", check_status_name(status), count);
	}
	printf("%-15s %zu in %.1f s\n", run->complete ? "All" : "Ended early", run->count,
		run->seconds);
}

bool check_output_end(struct check_output *output, struct sm_error *error)
{
	progress_finish(&output->progress);
	bool written = write_all(output, error);
	if (output->options->tap && !output->run->complete)
		check_tap_bail_out(stdout, written ? "the run was ended" : error->text);
	else if (!output->options->tap)
		print_summary(output->run);
	return written && flush(error);
}

bool check_output_verdict(const struct check_run *run, struct sm_error *error)
{
	size_t unexpected = check_run_count_unexpected(run);
	if (!run->complete)
		return error_set(
			error, SM_ERROR_MACHINE, "the run was ended after %zu cases", run->count);
	return unexpected == 0 ||
	       error_set(error, SM_ERROR_MACHINE, "%zu of %zu cases did not end as expected",
		       unexpected, run->count);
}
