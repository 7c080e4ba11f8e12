/* SPDX-License-Identifier: MIT */
#ifndef APP_CHECK_DESCRIBE_H
#define APP_CHECK_DESCRIBE_H

#include "app/check_options.h"
#include "check/context.h"

/** Opens the device in a process of its own, adds what "smoothie info" says of it and of how cases
 *  are run to the run's facts, and tells the driver's class.
 *  Fails as platform_create_on() and sm_renderer_create(), (MACHINE) without memory or where the
 *  driver crashes. */
bool check_describe(const struct check_options *options, struct check_run *run,
	enum check_class *class, struct sm_error *error);

#endif
