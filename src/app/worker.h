/* SPDX-License-Identifier: MIT */
#ifndef APP_WORKER_H
#define APP_WORKER_H

#include <smoothie.h>

/** Zeroed memory that child processes share with their parent, or NULL without memory. */
void *worker_share(size_t size);
/** NULL is fine. */
void worker_unshare(void *memory, size_t size);

/** Work for a process of its own, so that it has an environment and memory of its own, and that a
 *  driver that crashes takes no more with it. */
struct worker {
	const char *name; /**< for error messages: what is done, to what */
	/** Done in the child. What it writes to shared memory stays. */
	bool (*work)(void *data, struct sm_error *error);
	void *data;
	/** Called every few milliseconds meanwhile; may be NULL. */
	void (*watch)(void *data);
	void *watch_data;
};

/**
 * Does the work in a forked child, which ends with this process if that ends first. Call it while
 * there are no other threads and no GL.
 * Fails as the work does, or (MACHINE) if the child crashes or there is none.
 */
bool worker_run(const struct worker *worker, struct sm_error *error);

#endif
