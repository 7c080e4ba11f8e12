/* SPDX-License-Identifier: MIT */
#include "heap.h"
#include <malloc.h>

void heap_keep(void)
{
#ifdef M_TRIM_THRESHOLD
	mallopt(M_TRIM_THRESHOLD, (int)HEAP_KEPT);
#endif
}
