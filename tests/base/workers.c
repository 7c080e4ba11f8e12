/* SPDX-License-Identifier: MIT */
#include "base/workers.h"
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <unistd.h>

#include <cmocka.h>

#define PARTS_MAX 20

/* How often each part was done, by whichever thread. */
struct tally {
	unsigned done[PARTS_MAX];
};

static void count_part(void *data, unsigned part)
{
	struct tally *tally = data;
	tally->done[part]++;
}

static void check_rounds(struct workers *workers, unsigned parts, unsigned rounds)
{
	struct tally tally = {{0}};
	for (unsigned i = 0; i < rounds; i++)
		workers_run(workers, parts, count_part, &tally);
	for (unsigned part = 0; part < PARTS_MAX; part++)
		assert_int_equal(tally.done[part], part < parts ? rounds : 0);
}

static void do_each_part_once(void **state)
{
	(void)state;
	for (unsigned most = 1; most <= WORKERS_MAX; most++) {
		struct workers workers = {.most = most};
		assert_int_equal(workers_share(&workers), most);
		check_rounds(&workers, most, 300);
		check_rounds(&workers, PARTS_MAX, 300);
		check_rounds(&workers, 1, 10);
		workers_finish(&workers);
	}
}

static void are_as_many_as_processors(void **state)
{
	(void)state;
	struct workers workers = {0};
	long processors = sysconf(_SC_NPROCESSORS_ONLN);
	unsigned share = workers_share(&workers);
	assert_int_equal(share, processors < WORKERS_MAX ? processors : WORKERS_MAX);
	workers_finish(&workers);
	assert_int_equal(workers_share(NULL), 1);
}

static void start_again_when_finished(void **state)
{
	(void)state;
	struct workers workers = {.most = 100};
	workers_finish(&workers);
	for (int i = 0; i < 20; i++) {
		assert_int_equal(workers_share(&workers), WORKERS_MAX);
		check_rounds(&workers, PARTS_MAX, 3);
		workers_finish(&workers);
	}
}

/* Whether a part has begun, on another thread. */
struct sign {
	atomic_bool begun;
	pthread_t thread;
};

static void give_sign(void *data, unsigned part)
{
	struct sign *sign = data;
	(void)part;
	sign->thread = pthread_self();
	atomic_store(&sign->begun, true);
}

static void work_meanwhile(void **state)
{
	(void)state;
	struct workers workers = {.most = 2};
	for (int i = 0; i < 300; i++) {
		struct sign sign = {false};
		workers_begin(&workers, 1, give_sign, &sign);
		/* Ends only if another thread works. */
		while (!atomic_load(&sign.begun))
			sched_yield();
		workers_wait(&workers);
		assert_false(pthread_equal(sign.thread, pthread_self()));
	}
	workers_finish(&workers);
}

static void work_at_last_where_they_are_alone(void **state)
{
	(void)state;
	struct workers workers = {.most = 1};
	struct tally tally = {{0}};
	workers_begin(&workers, PARTS_MAX, count_part, &tally);
	for (unsigned part = 0; part < PARTS_MAX; part++)
		assert_int_equal(tally.done[part], 0);
	workers_wait(&workers);
	for (unsigned part = 0; part < PARTS_MAX; part++)
		assert_int_equal(tally.done[part], 1);
	workers_finish(&workers);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(do_each_part_once),
		cmocka_unit_test(are_as_many_as_processors),
		cmocka_unit_test(start_again_when_finished),
		cmocka_unit_test(work_meanwhile),
		cmocka_unit_test(work_at_last_where_they_are_alone),
	};
	return cmocka_run_group_tests_name("workers", tests, NULL, NULL);
}
