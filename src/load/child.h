/* SPDX-License-Identifier: MIT */
#ifndef LOAD_CHILD_H
#define LOAD_CHILD_H

#include <stdbool.h>
#include <stddef.h>

enum child_end {
	CHILD_SUCCEEDED,
	CHILD_FAILED,  /**< work() returned false */
	CHILD_SLOW,    /**< stopped at the limit of time */
	CHILD_CRASHED, /**< ended in any other way, the limit of memory being one of the causes */
	CHILD_MISSING, /**< the system had no process to give */
};

/**
 * Runs work(data) in a forked child and waits for its end. What it writes to shared mappings
 * stays; its standard output and error go nowhere.
 *
 * seconds: of wall time that it may take. bytes: of address space that it may add to what the
 * process already has.
 */
enum child_end child_run(bool (*work)(void *data), void *data, unsigned seconds, size_t bytes);

#endif
