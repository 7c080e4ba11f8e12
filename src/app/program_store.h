/* SPDX-License-Identifier: MIT */
#ifndef APP_PROGRAM_STORE_H
#define APP_PROGRAM_STORE_H

#include <smoothie.h>

/** Compiled programs as files of a folder of the user's own. What fails is noted in the log for
 *  debugging, and means that programs are compiled. Zero is empty. */
struct program_store {
	struct sm_program_store calls; /**< for sm_renderer_set_program_store() */
	char *folder;                  /**< owned; NULL: nothing is kept */
};

/** Chooses the folder, makes it if it is not there, and removes the oldest entries when it has too
 *  many: $SMOOTHIE_CACHE_DIR, or nothing if that is empty; unless it is set the first that can be
 * had of $STATE_DIRECTORY/programs, $XDG_CACHE_HOME/smoothie/programs and
 * ~/.cache/smoothie/programs. The store must stay where it is while a renderer uses it. */
void program_store_init(struct program_store *store);
void program_store_finish(struct program_store *store);

#endif
