/* SPDX-License-Identifier: MIT */
#include "allocations.h"
#include <limits.h>
#include <stdbool.h>
#include <stddef.h>

unsigned long allocations;
unsigned long allocations_left = ULONG_MAX;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
char *__real_strdup(const char *text);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
char *__wrap_strdup(const char *text);

/* Whether the next call succeeds. */
static bool allow(void)
{
	allocations++;
	if (allocations_left == 0)
		return false;
	allocations_left -= allocations_left < ULONG_MAX;
	return true;
}

void *__wrap_malloc(size_t size)
{
	return allow() ? __real_malloc(size) : NULL;
}

void *__wrap_calloc(size_t count, size_t size)
{
	return allow() ? __real_calloc(count, size) : NULL;
}

void *__wrap_realloc(void *memory, size_t size)
{
	return allow() ? __real_realloc(memory, size) : NULL;
}

char *__wrap_strdup(const char *text)
{
	return allow() ? __real_strdup(text) : NULL;
}
