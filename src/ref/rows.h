/* SPDX-License-Identifier: MIT */
#ifndef REF_ROWS_H
#define REF_ROWS_H

#include <stdint.h>

/** Work on the rows of a picture, each of which any thread may take. */
struct rows {
	uint32_t count;
	void (*work)(void *data, uint32_t row);
	void (*report)(void *data); /* after each row of the calling thread; may be NULL */
	void *data;
};

/** Returns when all rows are done. threads: 0 for one a processor. Where fewer can be had, fewer do
 *  it. */
void rows_run(const struct rows *rows, uint32_t threads);

#endif
