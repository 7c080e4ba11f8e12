/* SPDX-License-Identifier: MIT */
#include "app/report.h"
#include "base/log.h"
#include <stdio.h>

static enum sm_log_level limit;

static void print_line(void *data, enum sm_log_level level, const char *line)
{
	static const char *const prefixes[] = {
		[SM_LOG_ERROR] = "error: ",
		[SM_LOG_WARNING] = "warning: ",
		[SM_LOG_INFO] = "",
		[SM_LOG_DEBUG] = "debug: ",
	};
	(void)data;
	if (level <= limit)
		fprintf(stderr, "smoothie: %s%s\n", prefixes[level], line);
}

int report_error(const struct sm_error *error)
{
	fprintf(stderr, "smoothie: %s\n", error->text);
	return error->status;
}

void report_set_verbosity(int verbosity)
{
	limit = verbosity < 0    ? SM_LOG_ERROR
		: verbosity == 0 ? SM_LOG_WARNING
		: verbosity == 1 ? SM_LOG_INFO
				 : SM_LOG_DEBUG;
	log_set_sink(print_line, NULL);
	sm_set_log(print_line, NULL);
}
