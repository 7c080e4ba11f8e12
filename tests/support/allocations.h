/* SPDX-License-Identifier: MIT */
#ifndef SUPPORT_ALLOCATIONS_H
#define SUPPORT_ALLOCATIONS_H

#include <stddef.h>

/** Calls of malloc(), calloc(), realloc() and strdup() so far, by what is linked with --wrap of
 *  these and free(): the project's own objects, not the libraries that it uses. */
extern unsigned long allocations;

/** Bytes that they have asked for and not freed, but for arrays of nothing. */
extern size_t allocated_bytes;

/** How many of these calls succeed from now on, before one fails, and all that follow; it counts
 *  down. ULONG_MAX, the start, for all. */
extern unsigned long allocations_left;

#endif
