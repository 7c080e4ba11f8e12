/* SPDX-License-Identifier: MIT */
#ifndef APP_SIGNALS_H
#define APP_SIGNALS_H

#include <signal.h>

/** Makes the signals that end the program remove the guarded file first, and a write beyond the
 *  limit on file sizes an error as on a full disk. */
void signals_init(void);

/** From here on the first of those signals that arrives is noted in *number and ends nothing;
 * another ends the program. */
void signals_note(volatile sig_atomic_t *number);

/** In a child that its parent ends: leaves the keyboard's signals to the parent, and ends by those
 *  that are meant for it. */
void signals_leave_to_parent(void);

/** Holds those signals back from here to signals_resume(), so that file and guard change together.
 */
void signals_suspend(sigset_t *before);
void signals_resume(const sigset_t *before);

/** The file to remove, not owned; NULL: none. */
void signals_guard(const char *path);

#endif
