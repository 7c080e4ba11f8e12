/* SPDX-License-Identifier: MIT */
#ifndef APP_REPORT_H
#define APP_REPORT_H

#include <smoothie.h>

/** Prints "smoothie: TEXT" on stderr and returns the exit status. */
int report_error(const struct sm_error *error);

/** Sends the messages of program and library to stderr: warnings, or with verbosity < 0 errors
 *  alone, 1 information, 2 and above everything. */
void report_set_verbosity(int verbosity);

#endif
