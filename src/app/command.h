/* SPDX-License-Identifier: MIT */
#ifndef APP_COMMAND_H
#define APP_COMMAND_H

#include <smoothie.h>

/** A flag of a subcommand; --help prints them in this order. */
struct flag {
	int id;            /**< its letter, or a number above any letter for a long flag alone */
	const char *name;  /**< without the dashes */
	const char *value; /**< what follows it, "[...]" when that may be missing; NULL: nothing */
	const char *help;
};

/** A subcommand of the program. */
struct command {
	const char *name;
	const char *arguments; /**< as the usage line shows them */
	const char *summary;   /**< one line */
	const struct flag *flags;
	size_t flag_count;
	/** Returns false with *error filled when it fails. argv[0] is the subcommand's name. */
	bool (*run)(int argc, char **argv, struct sm_error *error);
};

extern const struct command bench_command;
extern const struct command check_command;
extern const struct command info_command;
extern const struct command render_command;
extern const struct command show_command;

#endif
