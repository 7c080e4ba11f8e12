/* SPDX-License-Identifier: MIT */
/* A run of cases that draw nothing: what passes, fails, crashes, hangs or comes and goes, and what
 * ends it early. */
#include "check/runner.h"
#include "process/worker.h"
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What cases count on, and the parent looks at. */
struct shared {
	_Atomic int attempts[32];
	_Atomic int running, most_running;
};

struct state {
	struct shared *shared;
	size_t told;
	sig_atomic_t stop;
};

static int attempt_number(const struct check_case *item, struct state *state)
{
	return ++state->shared->attempts[item->choice[0]];
}

/* A case does what its name says. */
static bool attempt(void *data, const struct check_case *item, struct check_result *result,
	struct sm_error *error)
{
	struct state *state = data;
	int number = attempt_number(item, state);
	result->status = CHECK_PASS;
	snprintf(result->message, sizeof(result->message), "attempt %d", number);
	if (strcmp(item->name, "crash") == 0)
		raise(SIGKILL);
	else if (strcmp(item->name, "exit") == 0)
		_exit(3);
	else if (strcmp(item->name, "hang") == 0)
		sleep(60);
	else if (strcmp(item->name, "fail") == 0 || strcmp(item->name, "known") == 0)
		result->status = CHECK_FAIL;
	else if (strcmp(item->name, "flake") == 0)
		result->status = number == 1 ? CHECK_FAIL : CHECK_PASS;
	else if (strcmp(item->name, "skip") == 0)
		result->status = CHECK_SKIP;
	else if (strcmp(item->name, "full") == 0)
		return error_set(error, SM_ERROR_MACHINE, "no room");
	return true;
}

static bool count_ended(void *data, const struct check_result *result, struct sm_error *error)
{
	struct state *state = data;
	(void)error;
	assert_true(result->name[0] != '\0');
	state->told++;
	return true;
}

struct trial {
	struct check_list list;
	struct check_baseline baseline;
	struct check_run run;
	struct check_runner runner;
	struct state state;
	struct sm_error error;
};

static int set_up(void **state)
{
	static struct trial trial;
	trial = (struct trial){.state.shared = worker_share(sizeof(struct shared))};
	trial.runner = (struct check_runner){
		.list = &trial.list,
		.baseline = &trial.baseline,
		.jobs = 3,
		.timeout = 20,
		.attempt = attempt,
		.ended = count_ended,
		.data = &trial.state,
		.stop = &trial.state.stop,
	};
	*state = &trial;
	return trial.state.shared != NULL ? 0 : -1;
}

static int tear_down(void **state)
{
	struct trial *trial = *state;
	check_list_finish(&trial->list);
	check_run_finish(&trial->run);
	worker_unshare(trial->state.shared, sizeof(struct shared));
	return 0;
}

static void add(struct trial *trial, const char *name)
{
	struct check_case *item = check_list_add(&trial->list, NULL, NULL, "%s", name);
	assert_non_null(item);
	item->choice[0] = trial->list.count - 1;
}

static bool run(struct trial *trial)
{
	return check_runner_run(&trial->runner, &trial->run, &trial->error);
}

static void test_outcomes(void **state)
{
	static const struct {
		const char *name;
		enum check_status status, first;
		uint32_t attempts;
		const char *message;
	} rows[] = {
		{"pass", CHECK_PASS, CHECK_PASS, 1, "attempt 1"},
		{"fail", CHECK_FAIL, CHECK_FAIL, 2, "attempt 1"},
		{"crash", CHECK_CRASH, CHECK_CRASH, 2, "Killed"},
		{"exit", CHECK_CRASH, CHECK_CRASH, 2, "ended early (status 3)"},
		{"flake", CHECK_FLAKE, CHECK_FAIL, 2, "attempt 1"},
		{"skip", CHECK_SKIP, CHECK_SKIP, 1, "attempt 1"},
		{"known", CHECK_EXPECTED_FAIL, CHECK_FAIL, 1, "attempt 1"},
	};
	const size_t count = sizeof(rows) / sizeof(rows[0]);
	struct trial *trial = *state;
	struct check_known known = {.name = (char[]){"known"}, .status = CHECK_FAIL};
	for (size_t i = 0; i < count; i++)
		add(trial, rows[i].name);
	trial->baseline.known = &known;
	trial->baseline.known_count = 1;
	assert_true(run(trial));
	assert_true(trial->run.complete);
	assert_int_equal(trial->run.count, count);
	assert_int_equal(trial->state.told, count);
	for (size_t i = 0; i < count; i++) {
		const struct check_result *result = &trial->run.results[i];
		assert_string_equal(result->name, rows[i].name);
		assert_int_equal(result->status, rows[i].status);
		assert_int_equal(result->first_status, rows[i].first);
		assert_int_equal(result->attempts, rows[i].attempts);
		assert_non_null(strstr(result->message, rows[i].message));
		assert_int_equal(trial->state.shared->attempts[i], rows[i].attempts);
	}
}

static void test_timeout(void **state)
{
	struct trial *trial = *state;
	add(trial, "hang");
	add(trial, "pass");
	trial->runner.timeout = .2;
	assert_true(run(trial));
	assert_int_equal(trial->run.results[0].status, CHECK_TIMEOUT);
	assert_int_equal(trial->run.results[0].attempts, 2);
	assert_string_equal(trial->run.results[0].message, "not done after 0.2 s");
	assert_true(trial->run.results[0].seconds >= .4);
	assert_int_equal(trial->run.results[1].status, CHECK_PASS);
}

/* One process for all would be ended by the first crash. */
static void test_every_case_survives_the_others(void **state)
{
	struct trial *trial = *state;
	for (int i = 0; i < 10; i++)
		add(trial, i % 2 == 0 ? "crash" : "pass");
	trial->runner.jobs = 1;
	assert_true(run(trial));
	for (size_t i = 0; i < 10; i++)
		assert_int_equal(
			trial->run.results[i].status, i % 2 == 0 ? CHECK_CRASH : CHECK_PASS);
}

static void test_failing_output_ends_it(void **state)
{
	struct trial *trial = *state;
	trial->runner.jobs = 1;
	add(trial, "pass");
	add(trial, "full");
	add(trial, "pass");
	assert_false(run(trial));
	assert_string_equal(trial->error.text, "no room");
	assert_int_equal(trial->error.status, SM_ERROR_MACHINE);
	assert_false(trial->run.complete);
	assert_int_equal(trial->run.count, 1);
	assert_int_equal(trial->state.shared->attempts[2], 0);
}

static void stop_it(void *data, size_t done)
{
	struct state *state = data;
	state->stop = done > 0;
}

static void test_stop(void **state)
{
	struct trial *trial = *state;
	trial->runner.jobs = 2;
	trial->runner.watch = stop_it;
	add(trial, "hang");
	add(trial, "pass");
	add(trial, "hang");
	assert_true(run(trial));
	assert_false(trial->run.complete);
	assert_int_equal(trial->run.count, 1);
	assert_string_equal(trial->run.results[0].name, "pass");
}

static void test_empty_list(void **state)
{
	struct trial *trial = *state;
	assert_true(run(trial));
	assert_true(trial->run.complete);
	assert_int_equal(trial->run.count, 0);
}

#define TRIAL(test) cmocka_unit_test_setup_teardown(test, set_up, tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TRIAL(test_outcomes),
		TRIAL(test_timeout),
		TRIAL(test_every_case_survives_the_others),
		TRIAL(test_failing_output_ends_it),
		TRIAL(test_stop),
		TRIAL(test_empty_list),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
