/* SPDX-License-Identifier: MIT */
#include "allocations.h"
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

unsigned long allocations;
unsigned long allocations_left = ULONG_MAX;
size_t allocated_bytes;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
char *__real_strdup(const char *text);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
char *__wrap_strdup(const char *text);
void __wrap_free(void *memory);

/* What there is; memory of libraries, which may be freed here as well, is not. */
#define BLOCKS_MAX 4096
static struct {
	void *memory;
	size_t size;
} blocks[BLOCKS_MAX];
static size_t block_count;

static void *keep(void *memory, size_t size)
{
	/* An array of nothing is a byte. */
	if (memory == NULL || size == 1)
		return memory;
	if (block_count == BLOCKS_MAX)
		abort();
	blocks[block_count].memory = memory;
	blocks[block_count++].size = size;
	allocated_bytes += size;
	return memory;
}

static void drop(const void *memory)
{
	for (size_t i = block_count; memory != NULL && i-- > 0;) {
		if (blocks[i].memory != memory)
			continue;
		allocated_bytes -= blocks[i].size;
		blocks[i] = blocks[--block_count];
		return;
	}
}

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
	return allow() ? keep(__real_malloc(size), size) : NULL;
}

void *__wrap_calloc(size_t count, size_t size)
{
	return allow() ? keep(__real_calloc(count, size), count * size) : NULL;
}

void *__wrap_realloc(void *memory, size_t size)
{
	if (!allow())
		return NULL;
	void *moved = __real_realloc(memory, size);
	if (moved != NULL)
		drop(memory);
	return keep(moved, size);
}

char *__wrap_strdup(const char *text)
{
	return allow() ? keep(__real_strdup(text), strlen(text) + 1) : NULL;
}

void __wrap_free(void *memory)
{
	drop(memory);
	__real_free(memory);
}
