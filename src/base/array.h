/* SPDX-License-Identifier: MIT */
#ifndef BASE_ARRAY_H
#define BASE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/** count * size bytes, uninitialised; NULL when that overflows or there is no memory. At least one
 *  byte is allocated, so that NULL always means failure. */
void *array_alloc(size_t count, size_t size);

/** array_alloc() filled with zero. */
void *array_zalloc(size_t count, size_t size);

/** A copy of count elements of size bytes, or NULL as array_alloc(). */
void *array_copy(const void *source, size_t count, size_t size);

/**
 * Makes room for at least `needed` elements of `size` bytes in *items, which holds *capacity of
 * them, growing by half at least; the new ones are uninitialised. On failure nothing changes.
 */
bool array_reserve(void **items, size_t *capacity, size_t needed, size_t size);

/** Gives back what is behind the first count elements of an array from array_alloc(). */
void *array_trim(void *items, size_t count, size_t size);

#endif
