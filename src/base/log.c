/* SPDX-License-Identifier: MIT */
#include "base/log.h"
#include <stdio.h>

static struct {
	sm_log log; /* NULL: silent */
	void *data; /* not owned */
} sink;

void log_set_sink(sm_log log, void *data)
{
	sink.log = log;
	sink.data = data;
}

void log_line(enum sm_log_level level, const char *format, ...)
{
	if (sink.log == NULL)
		return;
	char line[1000];
	va_list args;
	va_start(args, format);
	vsnprintf(line, sizeof(line), format, args);
	va_end(args);
	sink.log(sink.data, level, line);
}
