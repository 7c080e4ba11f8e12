/* SPDX-License-Identifier: MIT */
#include "check/case.h"
#include "base/array.h"
#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct check_case *check_list_add(
	struct check_list *list, check_function run, const void *subject, const char *format, ...)
{
	if (!array_reserve((void **)&list->items, &list->capacity, list->count + 1,
		    sizeof(*list->items))) {
		list->failed = true;
		return NULL;
	}
	struct check_case *item = &list->items[list->count++];
	*item = (struct check_case){.run = run, .subject = subject};
	va_list args;
	va_start(args, format);
	vsnprintf(item->name, sizeof(item->name), format, args);
	va_end(args);
	return item;
}

void check_list_finish(struct check_list *list)
{
	free(list->items);
	*list = (struct check_list){0};
}

bool check_list_has(const struct check_list *list, const char *name)
{
	for (size_t i = 0; i < list->count; i++)
		if (strcmp(list->items[i].name, name) == 0)
			return true;
	return false;
}

static bool check_globs(const struct check_list *list, const char *const *globs, size_t count,
	struct sm_error *error)
{
	for (size_t i = 0; i < count; i++) {
		size_t at = 0;
		while (at < list->count && fnmatch(globs[i], list->items[at].name, 0) != 0)
			at++;
		if (at == list->count)
			return error_set(error, SM_ERROR_INPUT,
				"--test %.200s: no case is named so; see smoothie check --list",
				globs[i]);
	}
	return true;
}

static bool matches_any(const char *name, const char *const *globs, size_t count)
{
	for (size_t i = 0; i < count; i++)
		if (fnmatch(globs[i], name, 0) == 0)
			return true;
	return false;
}

bool check_list_select(
	struct check_list *list, const char *const *globs, size_t count, struct sm_error *error)
{
	size_t kept = 0;
	if (!check_globs(list, globs, count, error))
		return false;
	for (size_t i = 0; count > 0 && i < list->count; i++)
		if (matches_any(list->items[i].name, globs, count))
			list->items[kept++] = list->items[i];
	if (count > 0)
		list->count = kept;
	return true;
}

void check_list_take_fraction(struct check_list *list, uint32_t fraction, uint32_t start)
{
	size_t kept = 0;
	for (size_t i = start - 1; i < list->count; i += fraction)
		list->items[kept++] = list->items[i];
	list->count = kept;
}
