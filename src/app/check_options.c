/* SPDX-License-Identifier: MIT */
#include "app/check_options.h"
#include "base/array.h"
#include <getopt.h>
#include <stdlib.h>
#include <unistd.h>

enum {
	FLAG_LIST = FLAG_OWN,
	FLAG_TEST,
	FLAG_JOBS,
	FLAG_FRACTION,
	FLAG_FRACTION_START,
	FLAG_OUTPUT,
	FLAG_EXPECT,
	FLAG_TIMEOUT,
	FLAG_TAP,
	FLAG_SIZE,
	FLAG_PRESET,
};

static const struct flag flags[] = {
	{FLAG_LIST, "list", NULL, "name the cases, and run none"},
	{FLAG_TEST, "test", "GLOB", "cases named so; may be repeated; default: all"},
	{FLAG_EXPECT, "expect", "FILE", "what may fail: NAME,Status; *-skips, *-flakes: patterns"},
	{FLAG_OUTPUT, "output", "DIR", "write results, reports and pictures there"},
	{FLAG_TAP, "tap", NULL, "print TAP"},
	{FLAG_JOBS, "jobs", "N", "cases at a time; default: one a processor"},
	{FLAG_FRACTION, "fraction", "N", "every N-th case alone"},
	{FLAG_FRACTION_START, "fraction-start", "K", "from the K-th on, 1 to N; default 1"},
	{FLAG_TIMEOUT, "timeout", "S", "seconds that a case may take; default 60"},
	{FLAG_SIZE, "size", "WxH", "of pictures; default: 256x256, and 128x128 on softpipe"},
	{FLAG_PRESET, "preset", "FILE", "flags from a file; those that follow count more"},
	DRIVER_FLAGS,
	RENDER_DEVICE_FLAG,
	COMMON_FLAGS,
};

#define MAX_JOBS 1024
#define MAX_SIDE 4096

static bool take_number(
	const char *flag, const char *value, uint32_t max, uint32_t *number, struct sm_error *error)
{
	return options_number(value, 1, max, number) ||
	       options_error(error, &check_command, "--%s %.40s: a number from 1 to %u is wanted",
		       flag, value, max);
}

static bool take_size(struct check_options *options, const char *value, struct sm_error *error)
{
	return (options_size(value, &options->width, &options->height) &&
		       options->width <= MAX_SIDE && options->height <= MAX_SIDE) ||
	       options_error(error, &check_command, "--size %.40s: WxH is wanted, up to %dx%d",
		       value, MAX_SIDE, MAX_SIDE);
}

static bool add_text(const char ***texts, size_t *count, size_t *capacity, const char *text,
	struct sm_error *error)
{
	if (!array_reserve((void **)texts, capacity, *count + 1, sizeof(**texts)))
		return error_no_memory(error);
	(*texts)[(*count)++] = text;
	return true;
}

static bool take_flag(void *data, int id, const char *value, struct sm_error *error)
{
	struct check_options *options = data;
	switch (id) {
	case FLAG_LIST:
		options->list = true;
		return true;
	case FLAG_TEST:
		return add_text(&options->globs, &options->glob_count, &options->glob_capacity,
			value, error);
	case FLAG_EXPECT:
		return add_text(&options->baselines, &options->baseline_count,
			&options->baseline_capacity, value, error);
	case FLAG_OUTPUT:
		options->output = value;
		return true;
	case FLAG_TAP:
		options->tap = true;
		return true;
	case FLAG_JOBS:
		return take_number("jobs", value, MAX_JOBS, &options->jobs, error);
	case FLAG_FRACTION:
		return take_number("fraction", value, INT32_MAX, &options->fraction, error);
	case FLAG_FRACTION_START:
		return take_number(
			"fraction-start", value, INT32_MAX, &options->fraction_start, error);
	case FLAG_TIMEOUT:
		return options_real(value, .001, 86400, &options->timeout) ||
		       options_error(error, &check_command,
			       "--timeout %.40s: seconds are wanted, up to a day", value);
	case FLAG_CAPS:
	case FLAG_PATH:
		return driver_options_flag(&options->driver, id, value, error);
	case FLAG_SIZE:
		return take_size(options, value, error);
	case FLAG_PRESET:
		return check_preset_read(
			&options->preset, &check_command, value, take_flag, options, error);
	default:
		options_common(&options->common, id, value);
		return true;
	}
}

static bool check(const struct check_options *options, char **argv, struct sm_error *error)
{
	if (argv[optind] != NULL)
		return options_error(
			error, &check_command, "no argument is wanted, but %.200s", argv[optind]);
	return options->fraction_start <= options->fraction ||
	       options_error(error, &check_command, "--fraction-start %u is beyond --fraction %u",
		       options->fraction_start, options->fraction);
}

static uint32_t processors(void)
{
	long count = sysconf(_SC_NPROCESSORS_ONLN);
	return count < 1 ? 1 : count > MAX_JOBS ? MAX_JOBS : (uint32_t)count;
}

bool check_options_init(
	struct check_options *options, int argc, char **argv, struct sm_error *error)
{
	int id;
	*options = (struct check_options){
		.common = options_defaults(),
		.jobs = processors(),
		.fraction = 1,
		.fraction_start = 1,
		.timeout = 60,
	};
	while ((id = options_next(&check_command, argc, argv, error)) >= 0)
		if (!take_flag(options, id, optarg, error))
			return false;
	return id != FLAG_FAILED && (options->common.help || check(options, argv, error));
}

void check_options_finish(struct check_options *options)
{
	free(options->globs);
	free(options->baselines);
	driver_options_finish(&options->driver);
	check_preset_finish(&options->preset);
}

const struct command check_command = {
	.name = "check",
	.arguments = "[flags]",
	.summary = "Try a driver, case by case, against what every driver must draw.",
	.flags = flags,
	.flag_count = sizeof(flags) / sizeof(flags[0]),
	.run = check_command_run,
};
