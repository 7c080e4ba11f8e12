/* SPDX-License-Identifier: MIT */
#ifndef APP_PROGRESS_H
#define APP_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

/** A bar on stderr for work of several steps, with the time that is left. It shows only on a
 * terminal, and only once the work has taken two seconds. */
struct progress {
	double start, last; /* ms of the monotonic clock: of the work, and of the bar as it is */
	uint32_t total;
	bool enabled, shown;
};

void progress_start(struct progress *progress, uint32_t total, bool quiet);
void progress_update(struct progress *progress, uint32_t done);
/** Removes the bar. */
void progress_finish(struct progress *progress);

#endif
