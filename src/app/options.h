/* SPDX-License-Identifier: MIT */
#ifndef APP_OPTIONS_H
#define APP_OPTIONS_H

#include "app/command.h"
#include "base/error.h"

/** Flags that every subcommand has, by the ids below; options_common() takes them. */
#define COMMON_FLAGS                                                                               \
	{FLAG_DEBUG, "debug", NULL, "log what the driver says and does (also: SMOOTHIE_DEBUG=1)"}, \
		{'q', "quiet", NULL, "no warnings, no progress"},                                  \
		{'v', "verbose", NULL, "say more; twice: all"},                                    \
	{                                                                                          \
		'h', "help", NULL, "show this"                                                     \
	}

/** The flag of subcommands that draw without a display. */
#define RENDER_DEVICE_FLAG                                               \
	{                                                                \
		FLAG_DEVICE, "device", "PATH|surfaceless",               \
			"where to render; default: the first that works" \
	}

enum {
	FLAG_END = -1,    /**< no flag is left; optind is the first argument */
	FLAG_FAILED = -2, /**< *error is filled */
	FLAG_DEVICE = 256,
	FLAG_DEBUG,
	FLAG_CAPS, /**< driver_options.h */
	FLAG_PATH,
	FLAG_NO_SKIP, /**< likewise */
	FLAG_OWN, /**< subcommands count on from here */
};

struct common_options {
	const char *device; /**< NULL: choose */
	bool debug, help;
	int verbosity; /**< -1: quiet, 0, 1, 2 and above: all */
};

/** The common options before any flag is read. */
struct common_options options_defaults(void);

/** Reads the next flag of argv with getopt_long(): its id (optarg is its value, or NULL), FLAG_END,
 *  or FLAG_FAILED. Flags and arguments may mix. */
int options_next(const struct command *command, int argc, char **argv, struct sm_error *error);

/** Takes a flag that is a common one. */
void options_common(struct common_options *options, int id, const char *value);

/** Prints what --help shows. */
void options_help(const struct command *command);

/** Fills *error (INPUT) with a line that ends in a hint at --help, and returns false. */
bool options_error(struct sm_error *error, const struct command *command, const char *format, ...)
	PRINTF_LIKE(3, 4);

/** A decimal number within [min, max], and nothing else. */
bool options_number(const char *text, uint32_t min, uint32_t max, uint32_t *value);

/** A decimal number within [min, max], such as ".03" or "3e-2", and nothing else. */
bool options_real(const char *text, double min, double max, double *value);

/** A rate "N" or "N/D", each from 1 to 2^31 - 1, that is from 0.001 to 1000. */
bool options_rate(const char *text, uint32_t *numerator, uint32_t *denominator);

/** Of things numbered from 1 to max: "N", the first N, or "A:B", from A to B with both of them. */
bool options_range(const char *text, uint32_t max, uint32_t *first, uint32_t *last);

/** "WIDTHxHEIGHT", each from 1 to 2^31 - 1. */
bool options_size(const char *text, uint32_t *width, uint32_t *height);

#endif
