/* SPDX-License-Identifier: MIT */
#include "check/result.h"
#include <stdlib.h>
#include <string.h>

static const char *const names[CHECK_STATUS_COUNT] = {
	[CHECK_PASS] = "Pass",
	[CHECK_FAIL] = "Fail",
	[CHECK_SKIP] = "Skip",
	[CHECK_CRASH] = "Crash",
	[CHECK_TIMEOUT] = "Timeout",
	[CHECK_FLAKE] = "Flake",
	[CHECK_EXPECTED_FAIL] = "ExpectedFail",
	[CHECK_UNEXPECTED_PASS] = "UnexpectedPass",
};

const char *check_status_name(enum check_status status)
{
	return names[status];
}

bool check_status_find(const char *name, enum check_status *status)
{
	for (size_t i = 0; i < CHECK_STATUS_COUNT; i++) {
		if (strcmp(name, names[i]) != 0)
			continue;
		*status = (enum check_status)i;
		return true;
	}
	return false;
}

bool check_status_is_unexpected(enum check_status status)
{
	return status == CHECK_FAIL || status == CHECK_CRASH || status == CHECK_TIMEOUT ||
	       status == CHECK_UNEXPECTED_PASS;
}

static void fact_finish(struct check_fact *fact)
{
	free(fact->key);
	free(fact->value);
}

void check_run_finish(struct check_run *run)
{
	for (size_t i = 0; i < run->fact_count; i++)
		fact_finish(&run->facts[i]);
	free(run->facts);
	free(run->results);
	*run = (struct check_run){0};
}

bool check_run_add_fact(struct check_run *run, const char *key, const char *value)
{
	struct check_fact *facts = realloc(run->facts, (run->fact_count + 1) * sizeof(*facts));
	if (facts == NULL)
		return false;
	run->facts = facts;
	struct check_fact fact = {.key = strdup(key), .value = strdup(value)};
	if (fact.key == NULL || fact.value == NULL) {
		fact_finish(&fact);
		return false;
	}
	facts[run->fact_count++] = fact;
	return true;
}

const char *check_run_fact(const struct check_run *run, const char *key)
{
	for (size_t i = 0; i < run->fact_count; i++)
		if (strcmp(run->facts[i].key, key) == 0)
			return run->facts[i].value;
	return "";
}

size_t check_run_count(const struct check_run *run, enum check_status status)
{
	size_t count = 0;
	for (size_t i = 0; i < run->count; i++)
		count += run->results[i].status == status;
	return count;
}

size_t check_run_count_unexpected(const struct check_run *run)
{
	size_t count = 0;
	for (size_t i = 0; i < run->count; i++)
		count += check_status_is_unexpected(run->results[i].status);
	return count;
}
