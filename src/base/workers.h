/* SPDX-License-Identifier: MIT */
#ifndef BASE_WORKERS_H
#define BASE_WORKERS_H

#include <pthread.h>
#include <stdbool.h>

#define WORKERS_MAX 8

/** Threads that share work, and sleep between. Zero is none, and finished. */
struct workers {
	unsigned count; /* that share: the caller of workers_run() is one; 0: not started */
	unsigned most;  /* that may be started; 0: one a processor, up to WORKERS_MAX */
	/* Owned */
	pthread_t threads[WORKERS_MAX - 1];
	pthread_mutex_t mutex;
	pthread_cond_t begun, done;
	void (*work)(void *data, unsigned part);
	void *data;
	unsigned long round;        /* of work */
	unsigned parts, next, left; /* to do, the next to take, and how many are not done */
	bool ends;
};

/** How many threads share work: they are started, where they are not. 1 for NULL, on one processor,
 *  and where none can be started. */
unsigned workers_share(struct workers *workers);

/** Begins work(data, part) for each part below `parts`, in any order and on any other thread. No
 *  further work is begun before workers_wait(). To be called by one thread at a time. */
void workers_begin(struct workers *workers, unsigned parts, void (*work)(void *data, unsigned part),
	void *data);

/** Shares what has been begun, and returns when all parts are done. */
void workers_wait(struct workers *workers);

/** Begins work and waits for it; with NULL the caller does all. */
void workers_run(struct workers *workers, unsigned parts, void (*work)(void *data, unsigned part),
	void *data);

/** Ends the threads. */
void workers_finish(struct workers *workers);

#endif
