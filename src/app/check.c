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
struct session {
	struct check_options options;
	struct check_list list;
	struct check_baseline baseline;
	struct check_run run;
	enum check_class class;
	struct check_output output;
};

static volatile sig_atomic_t stop; /* the signal that asks for the run's end */

/* Of the first attempt, which is the one that reports tell of. */
static bool write_pictures(const struct session *session, const struct check_context *context,
	struct check_result *result, struct sm_error *error)
{
	struct check_pair pair = {context->drawn, context->wanted, context->width, context->height};
	if (session->options.output == NULL || result->status != CHECK_FAIL ||
		result->attempts > 1 || context->drawn == NULL || context->wanted == NULL)
		return true;
	if (check_pictures_write(session->options.output, &pair, output_write, result, error))
		return true;
	error->status = SM_ERROR_MACHINE;
	return false;
}

static struct check_context make_context(const struct session *session)
{
	const struct check_options *options = &session->options;
	uint32_t side = check_class_size(session->class);
	return (struct check_context){
		.device = check_run_fact(&session->run, "device"),
		.debug = options->common.debug,
		.driver = driver_options_get(&options->driver),
		.class = session->class,
		.width = options->width > 0 ? options->width : side,
		.height = options->width > 0 ? options->height : side,
		.map = check_class_map(session->class),
	};
}

/* In the child. */
static bool attempt(void *data, const struct check_case *item, struct check_result *result,
	struct sm_error *error)
{
	struct session *session = data;
	struct check_context context = make_context(session);
	struct sm_error failure;
	signals_leave_to_parent();
	check_fail(result, "the case says nothing");
	context.platform = platform_create_on(context.device, context.debug, &failure);
	if (context.platform != NULL)
		item->run(item, &context, result);
	else
		check_fail(result, "%s", failure.text);
	bool written = write_pictures(session, &context, result, error);
	check_context_finish(&context);
	return written;
}

static bool tell(void *data, const struct check_result *result, struct sm_error *error)
{
	struct session *session = data;
	return check_output_result(&session->output, result, error);
}

static void watch(void *data, size_t done)
{
	struct session *session = data;
	progress_update(&session->output.progress, (uint32_t)done);
}

static bool build_list(struct session *session, struct sm_error *error)
{
	check_cases_build(&session->list);
	return !session->list.failed || error_no_memory(error);
}

static bool read_baselines(struct session *session, struct sm_error *error)
{
	for (size_t i = 0; i < session->options.baseline_count; i++)
		if (!check_baseline_read(&session->baseline, session->options.baselines[i], error))
			return false;
	return check_baseline_match(&session->baseline, &session->list, error);
}

static bool select_cases(struct session *session, struct sm_error *error)
{
	const struct check_options *options = &session->options;
	if (!check_list_select(&session->list, options->globs, options->glob_count, error))
		return false;
	check_list_take_fraction(&session->list, options->fraction, options->fraction_start);
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

static bool run_cases(struct session *session, struct sm_error *error)
{
	struct check_runner runner = {
		.list = &session->list,
		.baseline = &session->baseline,
		.jobs = session->options.jobs,
		.timeout = session->options.timeout,
		.attempt = attempt,
		.ended = tell,
		.watch = watch,
		.data = session,
		.stop = &stop,
	};
	struct sm_error failure;
	signals_note(&stop);
	bool ran = check_runner_run(&runner, &session->run, error);
	/* What a full disk leaves of the files is as it was before; they get what they can. */
	bool ended = check_output_end(&session->output, ran ? error : &failure);
	if (stop != 0)
		return end_by_signal();
	return ran && ended && check_output_verdict(&session->run, error);
}

static bool run_session(struct session *session, struct sm_error *error)
{
	struct check_run *run = &session->run;
	run->fraction = session->options.fraction;
	run->fraction_start = session->options.fraction_start;
	run->jobs = session->options.jobs;
	run->started = (int64_t)time(NULL);
	return check_describe(&session->options, run, &session->class, error) &&
	       check_output_begin(
		       &session->output, &session->options, run, session->list.count, error) &&
	       run_cases(session, error);
}

bool check_command_run(int argc, char **argv, struct sm_error *error)
{
	struct session session = {0};
	const struct check_options *options = &session.options;
	bool done = check_options_init(&session.options, argc, argv, error);
	if (done && options->common.help)
		options_help(&check_command);
	else if (done) {
		report_set_verbosity(options->common.debug ? 2 : options->common.verbosity);
		done = build_list(&session, error) && read_baselines(&session, error) &&
		       select_cases(&session, error) &&
		       (options->list ? print_list(&session.list) : run_session(&session, error));
	}
	check_options_finish(&session.options);
	check_list_finish(&session.list);
	check_baseline_finish(&session.baseline);
	check_run_finish(&session.run);
	return done;
}
