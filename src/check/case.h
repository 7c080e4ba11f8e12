/* SPDX-License-Identifier: MIT */
#ifndef CHECK_CASE_H
#define CHECK_CASE_H

#include "base/error.h"
#include "check/result.h"

struct check_case;
struct check_context; /* context.h */

/** Checks one thing: fills in result->status, message and difference. Its process is its own, its
 *  context current. */
typedef void (*check_function)(
	const struct check_case *item, struct check_context *context, struct check_result *result);

#define CHECK_CHOICES 5

/** A case; what it is of is for its function alone. */
struct check_case {
	char name[CHECK_NAME_SIZE]; /**< dotted, as check_result.name */
	check_function run;
	const void *subject;          /**< a row of a table; not owned, may be NULL */
	size_t choice[CHECK_CHOICES]; /**< indices into others */
};

/** Cases in the order in which they are run. Zero is empty. */
struct check_list {
	struct check_case *items; /**< owned */
	size_t count, capacity;
	bool failed; /**< memory ran out, once */
};

/** Appends a case without choices, named as the format says; NULL without memory, which is noted in
 *  `failed`. */
struct check_case *check_list_add(struct check_list *list, check_function run, const void *subject,
	const char *format, ...) PRINTF_LIKE(4, 5);
void check_list_finish(struct check_list *list);

bool check_list_has(const struct check_list *list, const char *name);

/** Keeps the cases whose names match any of the GLOBs, in which "*" and "?" stand for dots too;
 *  without a GLOB all. Fails (INPUT) on a GLOB that matches none. */
bool check_list_select(
	struct check_list *list, const char *const *globs, size_t count, struct sm_error *error);

/** Keeps every fraction-th case, from the start-th on, counted from 1. 1 <= start <= fraction. */
void check_list_take_fraction(struct check_list *list, uint32_t fraction, uint32_t start);

#endif
