/* SPDX-License-Identifier: MIT */
#ifndef APP_DRIVER_OPTIONS_H
#define APP_DRIVER_OPTIONS_H

#include "app/options.h"

/** Flags of the subcommands that draw, by the ids of options.h. */
#define DRIVER_FLAGS                                                                               \
	{FLAG_CAPS, "caps", "-NAME,+NAME", "do without what the driver can do, or with it again"}, \
	{                                                                                          \
		FLAG_PATH, "path", "NEED=WAY", "meet a need in that way; may be repeated"          \
	}

/** What a command line says of the driver; zero: nothing. */
struct driver_options {
	char *caps;         /**< all lists in their order, by commas; NULL: none; owned */
	const char **paths; /**< owned array */
	size_t path_count, path_capacity;
};

/** Takes a flag of DRIVER_FLAGS. Fails (MACHINE) when out of memory. */
bool driver_options_flag(
	struct driver_options *options, int id, const char *value, struct sm_error *error);
void driver_options_finish(struct driver_options *options);

/** As sm_renderer_create_with() takes it: of the options, which must live on. */
struct sm_driver_options driver_options_get(const struct driver_options *options);

/** A renderer in the current context of the platform, so made. */
struct sm_renderer *driver_options_renderer(
	const struct driver_options *options, struct sm_error *error);

#endif
