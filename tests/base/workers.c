/* SPDX-License-Identifier: MIT */
#include "base/workers.h"
#include <setjmp.h>
#include <stdarg.h>
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

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(do_each_part_once),
		cmocka_unit_test(are_as_many_as_processors),
		cmocka_unit_test(start_again_when_finished),
	};
	return cmocka_run_group_tests_name("workers", tests, NULL, NULL);
}
