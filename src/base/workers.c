/* SPDX-License-Identifier: MIT */
#include "base/workers.h"
#include <signal.h>
#include <unistd.h>

/* Takes parts until none is left; the mutex is held before and after. */
static void take_parts(struct workers *workers)
{
	while (workers->next < workers->parts) {
		unsigned part = workers->next++;
		pthread_mutex_unlock(&workers->mutex);
		workers->work(workers->data, part);
		pthread_mutex_lock(&workers->mutex);
		if (--workers->left == 0)
			pthread_cond_signal(&workers->done);
	}
}

static void *help(void *data)
{
	struct workers *workers = data;
	unsigned long round = 0;
	pthread_mutex_lock(&workers->mutex);
	while (!workers->ends) {
		if (workers->round == round) {
			pthread_cond_wait(&workers->begun, &workers->mutex);
			continue;
		}
		round = workers->round;
		take_parts(workers);
	}
	pthread_mutex_unlock(&workers->mutex);
	return NULL;
}

static unsigned wanted(const struct workers *workers)
{
	long processors = sysconf(_SC_NPROCESSORS_ONLN);
	unsigned most = workers->most > 0 ? workers->most : WORKERS_MAX;
	if (workers->most == 0 && processors < (long)most)
		most = processors > 0 ? (unsigned)processors : 1;
	return most < WORKERS_MAX ? most : WORKERS_MAX;
}

static void make_locks(struct workers *workers)
{
	pthread_mutex_init(&workers->mutex, NULL);
	pthread_cond_init(&workers->begun, NULL);
	pthread_cond_init(&workers->done, NULL);
}

static void destroy_locks(struct workers *workers)
{
	pthread_cond_destroy(&workers->done);
	pthread_cond_destroy(&workers->begun);
	pthread_mutex_destroy(&workers->mutex);
}

/* Signals are left to the caller's threads. */
static void start(struct workers *workers)
{
	unsigned count = wanted(workers), started = 1;
	sigset_t all, before;
	workers->count = 1;
	if (count == 1)
		return;
	make_locks(workers);
	sigfillset(&all);
	pthread_sigmask(SIG_SETMASK, &all, &before);
	while (started < count &&
		pthread_create(&workers->threads[started - 1], NULL, help, workers) == 0)
		started++;
	pthread_sigmask(SIG_SETMASK, &before, NULL);
	workers->count = started;
	if (started == 1)
		destroy_locks(workers);
}

unsigned workers_share(struct workers *workers)
{
	if (workers == NULL)
		return 1;
	if (workers->count == 0)
		start(workers);
	return workers->count;
}

static void set_work(struct workers *workers, unsigned parts,
	void (*work)(void *data, unsigned part), void *data)
{
	workers->work = work;
	workers->data = data;
	workers->next = 0;
	workers->parts = workers->left = parts;
	workers->round++;
}

void workers_begin(struct workers *workers, unsigned parts, void (*work)(void *data, unsigned part),
	void *data)
{
	if (workers_share(workers) == 1) {
		set_work(workers, parts, work, data);
		return;
	}
	pthread_mutex_lock(&workers->mutex);
	set_work(workers, parts, work, data);
	if (parts == 1)
		pthread_cond_signal(&workers->begun);
	else
		pthread_cond_broadcast(&workers->begun);
	pthread_mutex_unlock(&workers->mutex);
}

void workers_wait(struct workers *workers)
{
	if (workers->count == 1) {
		for (; workers->next < workers->parts; workers->next++)
			workers->work(workers->data, workers->next);
		return;
	}
	pthread_mutex_lock(&workers->mutex);
	take_parts(workers);
	while (workers->left > 0)
		pthread_cond_wait(&workers->done, &workers->mutex);
	pthread_mutex_unlock(&workers->mutex);
}

void workers_run(struct workers *workers, unsigned parts, void (*work)(void *data, unsigned part),
	void *data)
{
	struct workers alone = {.count = 1};
	struct workers *all = workers != NULL ? workers : &alone;
	workers_begin(all, parts, work, data);
	workers_wait(all);
}

void workers_finish(struct workers *workers)
{
	if (workers->count > 1) {
		pthread_mutex_lock(&workers->mutex);
		workers->ends = true;
		pthread_cond_broadcast(&workers->begun);
		pthread_mutex_unlock(&workers->mutex);
		for (unsigned i = 0; i + 1 < workers->count; i++)
			pthread_join(workers->threads[i], NULL);
		destroy_locks(workers);
	}
	*workers = (struct workers){.most = workers->most};
}
