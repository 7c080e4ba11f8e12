/* SPDX-License-Identifier: MIT */
#include "check/runner.h"
#include "base/array.h"
#include "process/worker.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* What a child has to do. */
struct task {
	const struct check_runner *runner;
	const struct check_case *item;
	struct check_result *result; /* shared */
};

/* A place for a child. */
struct slot {
	struct task task;
	struct worker worker;
	struct worker_process process; /* zero: free */
	size_t index;
	double started;
	struct check_result first; /* of two attempts */
};

/* A run that goes on. */
struct pool {
	const struct check_runner *runner;
	struct check_run *run;
	struct check_result *results; /* [list->count], shared */
	bool *ended;                  /* [list->count] */
	struct slot *slots;           /* [jobs] */
	size_t next;
};

static double now(void)
{
	struct timespec time;
	clock_gettime(CLOCK_MONOTONIC, &time);
	return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static bool work(void *data, struct sm_error *error)
{
	struct task *task = data;
	const struct check_runner *runner = task->runner;
	return runner->attempt(runner->data, task->item, task->result, error);
}

static bool begin(struct slot *slot, struct sm_error *error)
{
	struct check_result *result = slot->task.result;
	*result = (struct check_result){
		.attempts = result->attempts + 1,
		.seconds = result->seconds,
		.first_status = result->first_status,
	};
	memcpy(result->name, slot->task.item->name, sizeof(result->name));
	slot->worker =
		(struct worker){.name = slot->task.item->name, .work = work, .data = &slot->task};
	slot->started = now();
	return worker_start(&slot->process, &slot->worker, error);
}

/* Puts a result among the run's, in the list's order. */
static struct check_result *insert(struct pool *pool, size_t index)
{
	struct check_run *run = pool->run;
	size_t at = 0;
	for (size_t i = 0; i < index; i++)
		at += pool->ended[i];
	struct check_result *place = &run->results[at];
	memmove(place + 1, place, (run->count - at) * sizeof(*place));
	*place = pool->results[index];
	run->count++;
	pool->ended[index] = true;
	return place;
}

static bool finish_case(struct pool *pool, size_t index, struct sm_error *error)
{
	const struct check_runner *runner = pool->runner;
	const struct check_result *result = insert(pool, index);
	return runner->ended == NULL || runner->ended(runner->data, result, error);
}

static bool skip(struct pool *pool, size_t index, const char *place, struct sm_error *error)
{
	struct check_result *result = &pool->results[index];
	*result = (struct check_result){.status = CHECK_SKIP, .first_status = CHECK_SKIP};
	memcpy(result->name, pool->runner->list->items[index].name, sizeof(result->name));
	snprintf(result->message, sizeof(result->message), "left out by %.300s", place);
	return finish_case(pool, index, error);
}

/* Starts the next case that is not left out, if there is one. */
static bool fill(struct pool *pool, struct slot *slot, struct sm_error *error)
{
	const struct check_runner *runner = pool->runner;
	while (pool->next < runner->list->count) {
		size_t index = pool->next++;
		const struct check_case *item = &runner->list->items[index];
		const char *place = check_baseline_skips(runner->baseline, item->name);
		if (place == NULL) {
			slot->index = index;
			slot->task = (struct task){runner, item, &pool->results[index]};
			return begin(slot, error);
		}
		if (!skip(pool, index, place, error))
			return false;
	}
	return true;
}

/* An attempt has ended, and *result is what it came to: that is final, or it starts again. */
static bool settle(struct pool *pool, struct slot *slot, struct sm_error *error)
{
	struct check_result *result = slot->task.result;
	result->seconds += now() - slot->started;
	if (result->attempts == 1)
		result->first_status = result->status;
	result->status = check_baseline_judge(pool->runner->baseline, result->name, result->status);
	if (result->attempts == 2) {
		/* What it did wrong at first is what is to be seen. */
		slot->first.status = check_attempts_judge(slot->first.status, result->status);
		slot->first.seconds = result->seconds;
		slot->first.attempts = result->attempts;
		*result = slot->first;
	} else if (check_status_is_unexpected(result->status) &&
		   result->status != CHECK_UNEXPECTED_PASS) {
		slot->first = *result;
		return begin(slot, error);
	}
	return finish_case(pool, slot->index, error);
}

static void end(struct slot *slot, enum check_status status, const char *message)
{
	struct check_result *result = slot->task.result;
	result->status = status;
	/* The case may have been about to write it. */
	result->pictures = (struct check_pictures){0};
	result->difference = (struct check_difference){0};
	snprintf(result->message, sizeof(result->message), "%.*s", CHECK_MESSAGE_SIZE - 1, message);
}

static bool stop_late(struct pool *pool, struct slot *slot, struct sm_error *error)
{
	char message[100];
	if (now() - slot->started < pool->runner->timeout)
		return true;
	worker_stop(&slot->process);
	snprintf(message, sizeof(message), "not done after %g s", pool->runner->timeout);
	end(slot, CHECK_TIMEOUT, message);
	return settle(pool, slot, error);
}

static bool serve(struct pool *pool, struct slot *slot, struct sm_error *error)
{
	struct sm_error found = {0};
	if (slot->process.pid == 0)
		return fill(pool, slot, error);
	switch (worker_poll(&slot->process, &found)) {
	case WORKER_RUNNING:
		return stop_late(pool, slot, error);
	case WORKER_FAILED:
		return error_set(error, found.status, "%s", found.text);
	case WORKER_CRASHED:
		end(slot, CHECK_CRASH, found.text);
		break;
	case WORKER_DONE:
		break;
	}
	return settle(pool, slot, error);
}

static bool is_stopped(const struct check_runner *runner)
{
	return runner->stop != NULL && *runner->stop != 0;
}

static bool run_all(struct pool *pool, struct sm_error *error)
{
	static const struct timespec pause = {.tv_nsec = 2000000};
	const struct check_runner *runner = pool->runner;
	while (pool->run->count < runner->list->count && !is_stopped(runner)) {
		for (uint32_t i = 0; i < runner->jobs; i++)
			if (!serve(pool, &pool->slots[i], error))
				return false;
		if (runner->watch != NULL)
			runner->watch(runner->data, pool->run->count);
		nanosleep(&pause, NULL);
	}
	return true;
}

bool check_runner_run(
	const struct check_runner *runner, struct check_run *run, struct sm_error *error)
{
	size_t count = runner->list->count;
	size_t size = (count + 1) * sizeof(struct check_result); /* no empty mapping */
	double started = now();
	struct pool pool = {
		.runner = runner,
		.run = run,
		.results = worker_share(size),
		.ended = array_zalloc(count, sizeof(*pool.ended)),
		.slots = array_zalloc(runner->jobs, sizeof(*pool.slots)),
	};
	run->results = array_alloc(count, sizeof(*run->results));
	bool made = run->results != NULL && pool.results != NULL && pool.ended != NULL &&
		    pool.slots != NULL;
	bool ran = made ? run_all(&pool, error) : error_no_memory(error);
	for (uint32_t i = 0; pool.slots != NULL && i < runner->jobs; i++)
		worker_stop(&pool.slots[i].process);
	run->complete = run->count == count;
	run->seconds = now() - started;
	worker_unshare(pool.results, size);
	free(pool.ended);
	free(pool.slots);
	return ran;
}
