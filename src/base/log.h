/* SPDX-License-Identifier: MIT */
#ifndef BASE_LOG_H
#define BASE_LOG_H

#include "base/error.h"

/** Where this copy of the log goes; log may be NULL. data is not owned. */
void log_set_sink(sm_log log, void *data);

/** Formats one line, without a newline, for the sink. */
void log_line(enum sm_log_level level, const char *format, ...) PRINTF_LIKE(2, 3);

#define log_error(...) log_line(SM_LOG_ERROR, __VA_ARGS__)
#define log_warning(...) log_line(SM_LOG_WARNING, __VA_ARGS__)
#define log_info(...) log_line(SM_LOG_INFO, __VA_ARGS__)
#define log_debug(...) log_line(SM_LOG_DEBUG, __VA_ARGS__)

#endif
