/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_HEAP_H
#define PLATFORM_HEAP_H

#include <stddef.h>

/** What a heap that is kept has at its end at most that nobody uses, in bytes. */
#define HEAP_KEPT ((size_t)64 << 20)

/** Has the C library keep what is freed at the heap's end, up to HEAP_KEPT, instead of giving it
 *  back to the system: for drivers that draw on the processor. They free what a frame took, some
 *  megabytes, and take it again in the next, of which each page would be mapped and cleared anew.
 *  Does nothing where the C library cannot be told. */
void heap_keep(void);

#endif
