/* SPDX-License-Identifier: MIT */
#include "base/error.h"
#include "ref/reference.h"

bool reference_is_built(void)
{
	return false;
}

bool reference_trace(struct reference *reference, const struct reference_request *request,
	struct sm_error *error)
{
	(void)request;
	*reference = (struct reference){0};
	return error_set(error, SM_ERROR_MACHINE,
		"built without Embree, which traces the reference; install libembree-dev and build "
		"again");
}

void reference_finish(struct reference *reference)
{
	if (reference != NULL)
		*reference = (struct reference){0};
}
