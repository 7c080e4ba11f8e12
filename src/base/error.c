/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "base/line.h"

bool error_set(struct sm_error *error, enum sm_status status, const char *format, ...)
{
	if (error == NULL)
		return false;
	error->status = status;
	va_list args;
	va_start(args, format);
	line_format(error->text, sizeof(error->text), format, args);
	va_end(args);
	return false;
}

bool error_no_memory(struct sm_error *error)
{
	return error_set(error, SM_ERROR_MACHINE, "out of memory");
}
