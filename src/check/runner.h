/* SPDX-License-Identifier: MIT */
#ifndef CHECK_RUNNER_H
#define CHECK_RUNNER_H

#include "check/baseline.h"
#include "check/case.h"
#include <signal.h>

/** How cases are run: each attempt at one in a process of its own, several at a time. */
struct check_runner {
	const struct check_list *list;         /**< not owned */
	const struct check_baseline *baseline; /**< not owned */
	uint32_t jobs;                         /**< at a time; at least 1 */
	double timeout;                        /**< seconds of an attempt */
	/** Runs a case in the child, and fills in *result. Fails where the whole run must end, as
	 *  when there is no more room for what it writes. */
	bool (*attempt)(void *data, const struct check_case *item, struct check_result *result,
		struct sm_error *error);
	/** Is told each result once it is final, when it is one of the run's; may be NULL. Fails as
	 *  attempt(). */
	bool (*ended)(void *data, const struct check_result *result, struct sm_error *error);
	/** Called every few milliseconds; may be NULL. */
	void (*watch)(void *data, size_t done);
	void *data;                        /**< the caller's, handed to all three */
	const volatile sig_atomic_t *stop; /**< once it is not 0 the run ends; may be NULL */
};

/**
 * Runs the list. run->results has what has ended, in the list's order, all the while and also on
 * failure; run->complete says whether that is all. Call it while there are no other threads and no
 * GL. All children have ended when it returns. Fails as attempt() and ended(), and (MACHINE) for
 * lack of memory or processes.
 */
bool check_runner_run(
	const struct check_runner *runner, struct check_run *run, struct sm_error *error);

#endif
