/* SPDX-License-Identifier: MIT */
#ifndef APP_DRIVER_OPTIONS_H
#define APP_DRIVER_OPTIONS_H

#include "app/facts.h"
#include "app/options.h"

/** Flags of the subcommands that draw, by the ids of options.h. */
#define DRIVER_FLAGS                                                                               \
	{FLAG_CAPS, "caps", "-NAME,+NAME", "do without what the driver can do, or with it again"}, \
	{                                                                                          \
		FLAG_PATH, "path", "NEED=WAY", "meet a need in that way; may be repeated"          \
	}

/** The flag of those that draw frame after frame. */
#define SKIP_FLAG                                                                            \
	{                                                                                    \
		FLAG_NO_SKIP, "no-skip", "NAME", "do what could be skipped; all: everything" \
	}

/** What a command line says of the driver; zero: nothing. */
struct driver_options {
	char *caps;         /**< all lists in their order, by commas; NULL: none; owned */
	char *skips;        /**< likewise */
	const char **paths; /**< owned array */
	size_t path_count, path_capacity;
};

/** Whether a flag is one of DRIVER_FLAGS, or SKIP_FLAG. */
bool driver_options_has(int id);
/** Takes one. Fails (MACHINE) when out of memory. */
bool driver_options_flag(
	struct driver_options *options, int id, const char *value, struct sm_error *error);
void driver_options_finish(struct driver_options *options);

/** As sm_renderer_create_with() takes it: of the options, which must live on. */
struct sm_driver_options driver_options_get(const struct driver_options *options);

/** A renderer in the current context of the platform, so made. Fails as sm_renderer_create_with()
 * and sm_renderer_set_skips(). */
struct sm_renderer *driver_options_renderer(
	const struct driver_options *options, struct sm_error *error);

/** Says of each skip how often it was granted and asked for, and how often not granted. */
void driver_options_describe_skips(const struct sm_renderer *renderer, struct facts *facts);

#endif
