/* SPDX-License-Identifier: MIT */
#ifndef PROCESS_WORKER_H
#define PROCESS_WORKER_H

#include <smoothie.h>
#include <sys/types.h>

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
	/** Called every few milliseconds meanwhile by worker_run(); may be NULL. */
	void (*watch)(void *data);
	void *watch_data;
};

/**
 * Does the work in a forked child, which ends with this process if that ends first. Call it while
 * there are no other threads and no GL.
 * Fails as the work does, or (MACHINE) if the child crashes or there is none.
 */
bool worker_run(const struct worker *worker, struct sm_error *error);

/** The child of a worker; zero: none. */
struct worker_process {
	const struct worker *worker; /**< not owned */
	pid_t pid;
	struct sm_error *found; /**< shared with the child, owned */
};

enum worker_end {
	WORKER_RUNNING,
	WORKER_DONE,
	WORKER_FAILED,  /**< as its work says */
	WORKER_CRASHED, /**< it ended in any other way */
};

/** worker_run() without waiting: the end is to be asked for with worker_poll(); worker->watch is
 * not used. Several may run at a time. Fails (MACHINE) where there is no child. */
bool worker_start(
	struct worker_process *process, const struct worker *worker, struct sm_error *error);
/** What has become of it so far; fills *error where that is FAILED or CRASHED. Once it has ended,
 *  *process is zero. */
enum worker_end worker_poll(struct worker_process *process, struct sm_error *error);
/** Ends it, if it has not ended, and makes it zero. */
void worker_stop(struct worker_process *process);

#endif
