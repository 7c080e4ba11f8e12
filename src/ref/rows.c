/* SPDX-License-Identifier: MIT */
#include "ref/rows.h"
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <unistd.h>

#define THREADS_MOST 256

struct crew {
	const struct rows *rows;
	atomic_uint next;
};

static bool take_row(struct crew *crew)
{
	uint32_t row = atomic_fetch_add(&crew->next, 1);
	if (row >= crew->rows->count)
		return false;
	crew->rows->work(crew->rows->data, row);
	return true;
}

static void *help(void *data)
{
	while (take_row(data))
		;
	return NULL;
}

static uint32_t helpers_of(const struct rows *rows, uint32_t threads)
{
	if (threads == 0) {
		long processors = sysconf(_SC_NPROCESSORS_ONLN);
		threads = processors > 0 ? (uint32_t)processors : 1;
	}
	if (threads > THREADS_MOST)
		threads = THREADS_MOST;
	if (threads > rows->count)
		threads = rows->count;
	return threads > 0 ? threads - 1 : 0;
}

void rows_run(const struct rows *rows, uint32_t threads)
{
	struct crew crew = {.rows = rows};
	pthread_t helpers[THREADS_MOST];
	uint32_t wanted = helpers_of(rows, threads), count = 0;
	while (count < wanted && pthread_create(&helpers[count], NULL, help, &crew) == 0)
		count++;
	while (take_row(&crew))
		if (rows->report != NULL)
			rows->report(rows->data);
	for (uint32_t i = 0; i < count; i++)
		pthread_join(helpers[i], NULL);
}
