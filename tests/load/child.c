/* SPDX-License-Identifier: MIT */
#include "load/child.h"
#include "load/model.h"
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static bool succeed(void *data)
{
	struct model *model = data;
	model->meshes = model_alloc(model, 1, sizeof(*model->meshes));
	model->meshes[0].name = model_string(model, "made by the child");
	return true;
}

static bool refuse(void *data)
{
	(void)data;
	return false;
}

static bool hang(void *data)
{
	(void)data;
	while (pause() < 0)
		continue;
	return true;
}

static bool crash(void *data)
{
	(void)data;
	kill(getpid(), SIGSEGV);
	return true;
}

static bool give_up(void *data)
{
	(void)data;
	abort();
	return true;
}

/* True if the limit holds: a mapping within it succeeds, one beyond it does not. */
static bool map_too_much(void *data)
{
	size_t mib = 1 << 20;
	(void)data;
	void *small = mmap(NULL, 8 * mib, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	void *large = mmap(NULL, 64 * mib, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	return small != MAP_FAILED && large == MAP_FAILED;
}

static void each_end_is_told(void **state)
{
	static const struct {
		bool (*work)(void *);
		enum child_end end;
	} cases[] = {
		{refuse, CHILD_FAILED},
		{hang, CHILD_SLOW},
		{crash, CHILD_CRASHED},
		{give_up, CHILD_CRASHED},
		{map_too_much, CHILD_SUCCEEDED},
	};
	(void)state;
	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++)
		assert_int_equal(child_run(cases[i].work, NULL, 1, 32 << 20), cases[i].end);
}

static void leave_quietly(int number)
{
	(void)number;
	_exit(0);
}

static bool end_itself(void *data)
{
	(void)data;
	return raise(SIGTERM) == 0;
}

/* A handler would clean up what is the parent's. */
static void handlers_of_the_parent_are_not_called(void **state)
{
	(void)state;
	signal(SIGTERM, leave_quietly);
	assert_int_equal(child_run(end_itself, NULL, 5, 1 << 20), CHILD_CRASHED);
	signal(SIGTERM, SIG_DFL);
}

static void a_model_filled_by_a_child_is_the_parents(void **state)
{
	(void)state;
	struct model *model = model_create(NULL);
	assert_non_null(model);
	assert_int_equal(child_run(succeed, model, 5, 1 << 20), CHILD_SUCCEEDED);
	assert_string_equal(model->meshes[0].name, "made by the child");
	model_destroy(model);
}

static void a_model_has_an_end(void **state)
{
	(void)state;
	struct model *model = model_create(NULL);
	assert_non_null(model);
	assert_null(model_alloc(model, SIZE_MAX, 2));
	assert_null(model_alloc(model, (size_t)1 << 30, 1));
	assert_non_null(model_alloc(model, 0, 8));
	assert_non_null(model_alloc(model, 10, 1));
	assert_int_equal((uintptr_t)model_alloc(model, 1, 1) % _Alignof(max_align_t), 0);
	model_destroy(model);
	model_destroy(NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_end_is_told),
		cmocka_unit_test(handlers_of_the_parent_are_not_called),
		cmocka_unit_test(a_model_filled_by_a_child_is_the_parents),
		cmocka_unit_test(a_model_has_an_end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
