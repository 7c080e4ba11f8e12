/* SPDX-License-Identifier: MIT */
#include "app/check_describe.h"
#include "app/check_options.h"
#include "app/check_output.h"
#include "app/output.h"
#include "app/report.h"
#include "app/signals.h"
#include "check/cases.h"
#include "check/report.h"
#include "check/runner.h"
#include "platform.h"
#include <limits.h>
#include <stdio.h>
#include <time.h>

/* A run, from the command line to its files. */
struct conformance {
	struct check_options options;
	struct check_list list;
	struct check_baseline baseline;
	struct check_run run;
	enum check_class class;
	struct check_output output;
};

static volatile sig_atomic_t stop; /* the signal that asks for the run's end */

/* Of the first attempt, which is the one that reports tell of. */
static bool write_pictures(const struct conformance *conformance,
	const struct check_context *context, struct check_result *result, struct sm_error *error)
{
	struct check_pair pair = {context->drawn, context->wanted, context->width, context->height};
	if (conformance->options.output == NULL || result->status != CHECK_FAIL ||
		result->attempts > 1 || context->drawn == NULL || context->wanted == NULL)
		return true;
	if (check_pictures_write(conformance->options.output, &pair, output_write, result, error))
		return true;
	error->status = SM_ERROR_MACHINE;
	return false;
}

static struct check_context make_context(const struct conformance *conformance)
{
	const struct check_options *options = &conformance->options;
	uint32_t side = check_class_size(conformance->class);
	return (struct check_context){
		.device = check_run_fact(&conformance->run, "device"),
		.debug = options->common.debug,
		.driver = driver_options_get(&options->driver),
		.class = conformance->class,
		.width = options->width > 0 ? options->width : side,
		.height = options->width > 0 ? options->height : side,
		.map = check_class_map(conformance->class),
	};
}

/* In the child. */
static bool attempt(void *data, const struct check_case *item, struct check_result *result,
	struct sm_error *error)
{
	struct conformance *conformance = data;
	struct check_context context = make_context(conformance);
	struct sm_error failure;
	signals_leave_to_parent();
	check_fail(result, "the case says nothing");
	context.platform = platform_create_on(context.device, context.debug, &failure);
	if (context.platform != NULL)
		item->run(item, &context, result);
	else
		check_fail(result, "%s", failure.text);
	bool written = write_pictures(conformance, &context, result, error);
	check_context_finish(&context);
	return written;
}

static bool tell(void *data, const struct check_result *result, struct sm_error *error)
{
	struct conformance *conformance = data;
	return check_output_result(&conformance->output, result, error);
}

static void watch(void *data, size_t done)
{
	struct conformance *conformance = data;
	progress_update(&conformance->output.progress, (uint32_t)done);
}

static bool build_list(struct conformance *conformance, struct sm_error *error)
{
	check_cases_build(&conformance->list);
	return !conformance->list.failed || error_no_memory(error);
}

static bool read_baselines(struct conformance *conformance, struct sm_error *error)
{
	for (size_t i = 0; i < conformance->options.baseline_count; i++)
		if (!check_baseline_read(
			    &conformance->baseline, conformance->options.baselines[i], error))
			return false;
	return check_baseline_match(&conformance->baseline, &conformance->list, error);
}

static bool select_cases(struct conformance *conformance, struct sm_error *error)
{
	const struct check_options *options = &conformance->options;
	if (!check_list_select(&conformance->list, options->globs, options->glob_count, error))
		return false;
	check_list_take_fraction(&conformance->list, options->fraction, options->fraction_start);
	return true;
}

static bool print_list(const struct check_list *list)
{
	for (size_t i = 0; i < list->count; i++)
		puts(list->items[i].name);
	return true;
}

/* Ends the program as the sender of the signal expects, now that files are whole. */
static bool end_by_signal(void)
{
	fflush(stdout);
	signal(stop, SIG_DFL);
	raise(stop);
	return false;
}

static bool run_cases(struct conformance *conformance, struct sm_error *error)
{
	struct check_runner runner = {
		.list = &conformance->list,
		.baseline = &conformance->baseline,
		.jobs = conformance->options.jobs,
		.timeout = conformance->options.timeout,
		.attempt = attempt,
		.ended = tell,
		.watch = watch,
		.data = conformance,
		.stop = &stop,
	};
	struct sm_error failure;
	signals_note(&stop);
	bool ran = check_runner_run(&runner, &conformance->run, error);
	/* What a full disk leaves of the files is as it was before; they get what they can. */
	bool ended = check_output_end(&conformance->output, ran ? error : &failure);
	if (stop != 0)
		return end_by_signal();
	return ran && ended && check_output_verdict(&conformance->run, error);
}

static bool run_session(struct conformance *conformance, struct sm_error *error)
{
	struct check_run *run = &conformance->run;
	run->fraction = conformance->options.fraction;
	run->fraction_start = conformance->options.fraction_start;
	run->jobs = conformance->options.jobs;
	run->started = (int64_t)time(NULL);
	return check_describe(&conformance->options, run, &conformance->class, error) &&
	       check_output_begin(&conformance->output, &conformance->options, run,
		       conformance->list.count, error) &&
	       run_cases(conformance, error);
}

bool check_command_run(int argc, char **argv, struct sm_error *error)
{
	struct conformance conformance = {0};
	const struct check_options *options = &conformance.options;
	bool done = check_options_init(&conformance.options, argc, argv, error);
	if (done && options->common.help)
		options_help(&check_command);
	else if (done) {
		report_set_verbosity(options->common.debug ? 2 : options->common.verbosity);
		done = build_list(&conformance, error) && read_baselines(&conformance, error) &&
		       select_cases(&conformance, error) &&
		       (options->list ? print_list(&conformance.list)
				      : run_session(&conformance, error));
	}
	check_options_finish(&conformance.options);
	check_list_finish(&conformance.list);
	check_baseline_finish(&conformance.baseline);
	check_run_finish(&conformance.run);
	return done;
}
