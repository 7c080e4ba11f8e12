/* SPDX-License-Identifier: MIT */
#ifndef APP_OUTPUT_H
#define APP_OUTPUT_H

#include <smoothie.h>

/** Whether output_write() could be refused for a reason that is known already: a terminal, a folder
 *  that is missing or closed. Fails (INPUT). */
bool output_check(const char *path, struct sm_error *error);

/**
 * Writes a whole file or nothing: a temporary one beside it is renamed over it at the end, and
 * removed on failure or when a signal ends the program. Symbolic links are followed; "-" is
 * standard output; devices and pipes are written directly.
 * Fails (INPUT) where path cannot be written by the user, (MACHINE) when the disk is full or
 * broken.
 */
bool output_write(const char *path, const void *bytes, size_t size, struct sm_error *error);

/** output_write() of a file that is for its owner alone, whatever its name. */
bool output_write_private(const char *path, const void *bytes, size_t size, struct sm_error *error);

/** How the names of temporary files start. */
#define OUTPUT_TEMPORARY ".smoothie-"

#endif
