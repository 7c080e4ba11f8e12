/* SPDX-License-Identifier: MIT */
#include "base/array.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static bool bytes_of(size_t count, size_t size, size_t *bytes)
{
	if (size != 0 && count > (size_t)PTRDIFF_MAX / size)
		return false;
	*bytes = count * size > 0 ? count * size : 1;
	return true;
}

void *array_alloc(size_t count, size_t size)
{
	size_t bytes;
	return bytes_of(count, size, &bytes) ? malloc(bytes) : NULL;
}

void *array_zalloc(size_t count, size_t size)
{
	size_t bytes;
	return bytes_of(count, size, &bytes) ? calloc(1, bytes) : NULL;
}

void *array_copy(const void *source, size_t count, size_t size)
{
	void *copy = array_alloc(count, size);
	if (copy != NULL && count * size > 0)
		memcpy(copy, source, count * size);
	return copy;
}

bool array_reserve(void **items, size_t *capacity, size_t needed, size_t size)
{
	if (needed <= *capacity)
		return true;
	size_t grown = *capacity + *capacity / 2;
	size_t count = needed > grown ? needed : grown;
	size_t bytes;
	if (!bytes_of(count, size, &bytes))
		return false;
	void *moved = realloc(*items, bytes);
	if (moved == NULL)
		return false;
	*items = moved;
	*capacity = count;
	return true;
}

void *array_trim(void *items, size_t count, size_t size)
{
	size_t bytes;
	void *moved = bytes_of(count, size, &bytes) ? realloc(items, bytes) : NULL;
	return moved != NULL ? moved : items;
}
