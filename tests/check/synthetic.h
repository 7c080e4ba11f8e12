/* SPDX-License-Identifier: MIT */
#ifndef TESTS_CHECK_SYNTHETIC_H
#define TESTS_CHECK_SYNTHETIC_H

#include "check/result.h"
#include "page/file.h"

/* A run as no driver made it: each status, passes around them, and texts that are markup. */

/** Names and messages that each format has to escape. */
#define SYNTHETIC_EVIL "]]></x>\"'<script>&#,\\\n\x01\x7f caf\xe9 \xc3\xa9 \xef\xbf\xbf"

/** The names of the cases that have pictures: of the first the result is white and the reference
 *  black, the second looks like a shadow that is a bit off. */
#define SYNTHETIC_PLAIN "exact.smoothie.fixed12.fence"
#define SYNTHETIC_SHADOW "picture.smoothie.float.fence.smoothie=rgba8"

/** Makes the run, with pictures in the folder, which is there. False where that cannot be. */
bool synthetic_run(
	struct check_run *run, const char *folder, file_writer write, struct sm_error *error);

#endif
