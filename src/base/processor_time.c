/* SPDX-License-Identifier: MIT */
#include "base/processor_time.h"
#include <time.h>

double processor_ms(void)
{
	struct timespec now;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
	return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}
