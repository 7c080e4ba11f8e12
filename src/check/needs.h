/* SPDX-License-Identifier: MIT */
#ifndef CHECK_NEEDS_H
#define CHECK_NEEDS_H

#include <smoothie.h>

/** Whether pictures of a technique, with one of its choices of samples, depend on how a need is
 * met: indices of sm_technique_name(), sm_technique_samples() and sm_need_name(). */
bool check_uses(size_t technique, size_t samples, size_t need);

/** Whether the renderer's driver meets a need of the technique in no way. */
bool check_lacks(struct sm_renderer *renderer, size_t technique);

#endif
