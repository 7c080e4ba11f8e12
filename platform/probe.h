/* SPDX-License-Identifier: MIT */
#ifndef PLATFORM_PROBE_H
#define PLATFORM_PROBE_H

#include <smoothie.h>

/** Whether the current context really draws: clears one pixel and reads it back. Fails (MACHINE).
 */
bool probe_draws(struct sm_error *error);

#endif
