/* SPDX-License-Identifier: MIT */
#ifndef BASE_PROCESSOR_TIME_H
#define BASE_PROCESSOR_TIME_H

/** Processor time of this thread so far, in milliseconds. */
double processor_ms(void);

#endif
